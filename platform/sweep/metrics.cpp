#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include <sweep/metric_catalogue.h>
#include <sweep/metrics.h>
#include <sweep/pareto.h>
#include <vp/text.h>

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
using Figures = std::vector<std::pair<std::string, double>>;

/// Appends a name to a path for as long as it lives.
class Step {
 public:
  Step(std::string& path, std::string_view name) : path_(path), length_(path.size()) {
    if (!path.empty()) path += '.';
    path += name;
  }
  ~Step() { path_.resize(length_); }
  Step(const Step&) = delete;
  Step& operator=(const Step&) = delete;

 private:
  std::string& path_;
  std::size_t length_;
};

/// What an item of a list calls itself; null if it does not.
const std::string* name_of(const Json& item) {
  if (!item.is_object()) return nullptr;
  const auto name = item.find("name");
  return name == item.end() ? nullptr : name->get_ptr<const std::string*>();
}

/// Calls found(path, value) for each number below `json`. One that is not finite has no place in a
/// file either.
template <class Found>
void walk(const Json& json, std::string& path, const Found& found) {
  if (json.is_number()) {
    const double value = json.get<double>();
    if (std::isfinite(value)) found(path, value);
  } else if (json.is_boolean()) {
    found(path, json.get<bool>() ? 1.0 : 0.0);
  } else if (json.is_object()) {
    for (const auto& [name, value] : json.get_ref<const Json::object_t&>()) {
      const Step step(path, name);
      walk(value, path, found);
    }
  } else if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) {
      const std::string* name = name_of(json[i]);
      const Step step(path, name ? std::string_view(*name) : std::string_view(std::to_string(i)));
      walk(json[i], path, found);
    }
  }
}

void gather(const Json& json, std::string path, Gathering& into) {
  walk(json, path, [&](const std::string& name, double value) { into[name].add(value); });
}

template <class Found>
void find_in_frames(const Json& frames, const Found& found) {
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
      } else if (name == "time_us" && frame.contains("gave_up")) {
        continue;  // stages that were not reached
      } else if (name != "index" && name != "scene_marker") {
        gather(value, "frames." + name, all);
      }
    }
  }
  for (const auto& [name, gathered] : all) {
    found(name + ".mean", gathered.sum / gathered.count);
    found(name + ".max", gathered.max);
  }
}

/// A limit that is only known to be no lower says nothing about a clock above it.
template <class Found>
void find_in_timing(const Json& modules, const Found& found) {
  double failed = 0;
  double unknown = 0;
  for (const Json& module : modules) {
    if (module.value("met", true)) continue;
    (module.value("frequency_mhz", 0.0) <= module.value("fmax_high_mhz", 0.0) ? unknown : failed) +=
        1;
  }
  found("timing.failed", failed);
  found("timing.unknown", unknown);
}

/// What is no, unknown and yes becomes 0, 0.5 and 1.
template <class Found>
void find_in_verdict(const Json& verdict, const Found& found) {
  const auto add = [&](const std::string& path, const Json& holds) {
    const auto* text = holds.get_ptr<const std::string*>();
    if (text) found(path, *text == "yes" ? 1.0 : *text == "unknown" ? 0.5 : 0.0);
  };
  for (const auto& [name, part] : verdict.items()) {
    if (name == "feasible")
      add("verdict.feasible", part);
    else if (part.is_object() && part.contains("holds"))
      add("verdict." + name + ".holds", part["holds"]);
  }
}

/// Calls found(path, value) for each figure, in the order of the result.
template <class Found>
void find_figures(const Json& result, const Found& found) {
  for (const auto& [name, value] : result.items()) {
    if (name == "provenance" || name == "configuration" || name == "schema") continue;
    if (name == "frames") {
      find_in_frames(value, found);
    } else {
      std::string path = name;
      walk(value, path, found);
    }
    if (name == "timing" && value.contains("modules")) find_in_timing(value["modules"], found);
    if (name == "verdict") find_in_verdict(value, found);
  }
}

}  // namespace

Metrics::Metrics(Figures figures) {
  const auto by_name = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::stable_sort(figures.begin(), figures.end(), by_name);
  Names names;
  names.reserve(figures.size());
  values_.reserve(figures.size());
  for (auto& [name, value] : figures) {
    if (!names.empty() && names.back() == name) {
      values_.back() += value;
      continue;
    }
    names.push_back(std::move(name));
    values_.push_back(value);
  }
  names_ = std::make_shared<const Names>(std::move(names));
}

Metrics::Metrics(std::shared_ptr<const Names> names, std::vector<double> values)
    : names_(std::move(names)), values_(std::move(values)) {}

const double* Metrics::find(const std::string& name) const {
  const std::size_t place = place_of(name);
  return place == values_.size() ? nullptr : &values_[place];
}

std::size_t Metrics::place_of(const std::string& name) const {
  const auto found = std::lower_bound(names_->begin(), names_->end(), name);
  if (found == names_->end() || *found != name) return values_.size();
  return static_cast<std::size_t>(found - names_->begin());
}

void Metrics::share_names(const Metrics& other) {
  if (names_ != other.names_ && *names_ == *other.names_) names_ = other.names_;
}

const std::shared_ptr<const Metrics::Names>& Metrics::none() {
  static const auto names = std::make_shared<const Names>();
  return names;
}

Metrics metrics_of(const Json& result) {
  Figures figures;
  find_figures(result,
               [&](const std::string& path, double value) { figures.emplace_back(path, value); });
  return Metrics(std::move(figures));
}

Metrics MetricsReader::read(const Json& result) {
  std::vector<double> values(before_.values().size());  // fewer than paths if some share a name
  std::size_t count = 0;
  bool same = true;
  find_figures(result, [&](const std::string& path, double value) {
    same = same && count < paths_.size() && paths_[count] == path;
    if (same) values[order_[count++]] += value;
  });
  if (same && count == paths_.size() && count != 0)
    return Metrics(before_.shared_names(), std::move(values));
  paths_.clear();
  order_.clear();
  before_ = metrics_of(result);
  find_figures(result, [&](const std::string& path, double) { paths_.push_back(path); });
  for (const std::string& path : paths_) order_.push_back(before_.place_of(path));
  return before_;
}

std::vector<std::string> missing_figures(const Manifest& manifest, const Metrics::Names& known) {
  std::set<std::string> asked(manifest.metrics.begin(), manifest.metrics.end());
  const auto ask = [&](const vp::Expression& expression) {
    asked.insert(expression.names().begin(), expression.names().end());
  };
  for (const std::string& text : manifest.objectives) ask(Objective(text, manifest.name).figure());
  for (const std::string& text : manifest.constraints) ask(vp::Expression(text, manifest.name));
  if (!manifest.job.empty()) ask(vp::Expression(manifest.job, manifest.name));
  // They may use parameters, too.
  for (const Family& family : manifest.families) {
    for (const auto& [path, value] : family.configuration) asked.erase(path);
  }
  for (const char* special : {"system", "program", "inputs"}) asked.erase(special);
  std::vector<std::string> complaints;
  for (const std::string& name : asked) {
    if (std::binary_search(known.begin(), known.end(), name)) continue;
    const MetricKind* kind = kind_of_metric(name);
    const bool well_spelt = kind && std::string_view(kind->pattern).find('*') == std::string::npos;
    const std::string nearest = well_spelt ? "" : vp::nearest_match(name, known);
    complaints.push_back("no result has the metric '" + name + "'" +
                         (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
  }
  return complaints;
}

}  // namespace platform::sweep
