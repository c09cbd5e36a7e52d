#include <sweep/metrics.h>

#include <algorithm>

namespace platform::sweep {

namespace {

/// Mean and largest of the values added.
struct Gathered {
  double sum = 0;
  double max = 0;
  double count = 0;

  void add(double value) {
    max = count == 0 ? value : std::max(max, value);
    sum += value;
    ++count;
  }
};

using Gathering = std::map<std::string, Gathered>;

std::string joined(const std::string& prefix, const std::string& name) {
  return prefix.empty() ? name : prefix + "." + name;
}

std::string item_name(const Json& item, std::size_t position) {
  if (item.is_object() && item.contains("name") && item["name"].is_string())
    return item["name"].get<std::string>();
  return std::to_string(position);
}

template <class Found>
void walk(const Json& json, const std::string& path, const Found& found) {
  if (json.is_number()) found(path, json.get<double>());
  if (json.is_boolean()) found(path, json.get<bool>() ? 1.0 : 0.0);
  if (json.is_object()) {
    for (const auto& [name, value] : json.items()) walk(value, joined(path, name), found);
  }
  if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i)
      walk(json[i], joined(path, item_name(json[i], i)), found);
  }
}

void gather(const Json& json, const std::string& path, Gathering& into) {
  walk(json, path, [&](const std::string& name, double value) { into[name].add(value); });
}

void add_frames(const Json& frames, Metrics& metrics) {
  Gathering all;
  for (const Json& frame : frames) {
    for (const auto& [name, value] : frame.items()) {
      if (name == "markers") {
        all["frames.markers"].add(static_cast<double>(value.size()));
        for (const Json& marker : value) {
          if (marker.contains("error")) gather(marker["error"], "frames.error", all);
          for (const char* figure : {"reprojection_px", "iterations"}) {
            if (marker.contains(figure))
              gather(marker[figure], std::string("frames.") + figure, all);
          }
        }
      } else if (name != "index") {
        gather(value, "frames." + name, all);
      }
    }
  }
  for (const auto& [name, gathered] : all) {
    metrics[name + ".mean"] = gathered.sum / gathered.count;
    metrics[name + ".max"] = gathered.max;
  }
}

/// A limit that is only known to be no lower says nothing about a clock above it.
void add_timing(const Json& modules, Metrics& metrics) {
  double failed = 0;
  double unknown = 0;
  for (const Json& module : modules) {
    if (module.value("met", true)) continue;
    (module.value("lower_bound", false) ? unknown : failed) += 1;
  }
  metrics["timing.failed"] = failed;
  metrics["timing.unknown"] = unknown;
}

}  // namespace

Metrics metrics_of(const Json& result) {
  Metrics metrics;
  for (const auto& [name, value] : result.items()) {
    if (name == "provenance" || name == "configuration" || name == "schema") continue;
    if (name == "frames") {
      add_frames(value, metrics);
    } else {
      walk(value, name, [&](const std::string& path, double number) { metrics[path] = number; });
    }
    if (name == "timing" && value.contains("modules")) add_timing(value["modules"], metrics);
  }
  return metrics;
}

}  // namespace platform::sweep
