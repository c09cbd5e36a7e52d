#include <page/sweep_block.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <host/document.h>
#include <vp/error.h>

namespace platform::page {

namespace {

namespace fs = std::filesystem;
using report::Json;

/// Figures of every point, as paths into its result.
constexpr std::array figures{"/summary/fps/mean",      "/summary/latency_us/mean",
                             "/summary/power_w/total", "/summary/energy_per_frame_mj",
                             "/power/junction_c",      "/summary/detected",
                             "/summary/frames",        "/resources/total/lut",
                             "/resources/total/ff",    "/resources/total/bram36",
                             "/resources/total/dsp"};
/// Mean over the markers whose truth is known.
constexpr std::array errors{"corner_px", "translation_mm", "rotation_deg"};

/// A part of a point's result, which is not copied; null if it has none.
const Json& part(const Json& json, const char* path) {
  static const Json none;
  const Json::json_pointer pointer(path);
  return json.contains(pointer) ? json.at(pointer) : none;
}

Json number_at(const Json& json, const char* path) {
  const Json& number = part(json, path);
  return number.is_number() ? number : Json();
}

Json mean_error(const Json& result, const char* name) {
  double sum = 0;
  std::size_t count = 0;
  for (const Json& frame : part(result, "/frames")) {
    for (const Json& marker : part(frame, "/markers")) {
      const Json value = number_at(marker, (std::string("/error/") + name).c_str());
      if (value.is_null()) continue;
      sum += value.get<double>();
      ++count;
    }
  }
  return count == 0 ? Json() : Json(sum / static_cast<double>(count));
}

/// Why the point failed, or is not feasible; none if it is.
Json reasons_of(const Json& outcome) {
  Json reasons = Json::array();
  if (outcome.value("status", "") == "failed") {
    reasons.push_back("failed: " + outcome.value(Json::json_pointer("/failure/message"), ""));
  }
  const Json& verdict = part(outcome, "/result/verdict");
  for (const Json& each : verdict) {
    if (each.is_object() && each.contains("why")) reasons.push_back(each["why"]);
  }
  if (verdict.is_null() && reasons.empty()) reasons.push_back("without a verdict");
  return reasons;
}

/// File names may hold any bytes; JSON holds UTF-8 only.
std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// The object `json`, which is not empty, with the members of another behind its own.
std::string joined(std::string json, const std::string& other) {
  json.back() = ',';
  return json.append(other, 1);
}

std::string point_json(const Json& planned, const Json& swept, const std::string& row) {
  Json point;
  point["key"] = planned.at("key");
  point["swept"] = Json::array();
  for (const Json& path : swept) {
    point["swept"].push_back(planned.at("swept").value(path.get<std::string>(), Json()));
  }
  return joined(dump(point), row);
}

/// Empty for a point that is missing.
std::string row_of(const std::string& key, const fs::path& folder, const PointRows& known) {
  const auto found = known.find(key);
  if (found != known.end()) return found->second;
  const fs::path file = folder / "points" / (key + ".json");
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return "";
  return point_row(part(host::read_json<Json>(file, "point", host::largest_result), "/outcome"));
}

std::string block_of_manifest(const Json& manifest, const fs::path& folder,
                              const PointRows& known) {
  Json json;
  for (const char* key : {"name", "title", "text", "swept", "effects"}) {
    if (manifest.contains(key)) json[key] = manifest[key];
  }
  json["folder"] = folder.string();
  json["metrics"] = Json::array();
  for (const char* figure : figures) json["metrics"].push_back(std::string(figure).substr(1));
  for (const char* error : errors) json["metrics"].push_back(std::string("error/") + error);
  std::string points;
  std::size_t missing = 0;
  for (const Json& planned : manifest.at("points")) {
    const std::string row = row_of(planned.at("key").get<std::string>(), folder, known);
    if (row.empty()) {
      ++missing;
      continue;
    }
    points += (points.empty() ? "" : ",") + point_json(planned, manifest.at("swept"), row);
  }
  return joined(dump(json),
                "{\"points\":[" + points + "],\"missing\":" + std::to_string(missing) + "}");
}

}  // namespace

std::string point_row(const Json& outcome) {
  const Json& result = part(outcome, "/result");
  Json row;
  row["metrics"] = Json::array();
  for (const char* figure : figures) row["metrics"].push_back(number_at(result, figure));
  for (const char* error : errors) row["metrics"].push_back(mean_error(result, error));
  row["failed"] = outcome.value("status", "") == "failed";
  row["reasons"] = reasons_of(outcome);
  return dump(row);
}

std::string sweep_json(const std::string& folder, const PointRows& known) {
  const fs::path path = fs::path(folder) / "manifest.json";
  const Json manifest = host::read_json<Json>(path, "manifest", host::largest_result);
  try {
    return block_of_manifest(manifest, folder, known);
  } catch (const Json::exception&) {
    throw vp::InputError("'" + folder +
                         "' is not the folder of a sweep, or its files were changed: run the sweep "
                         "again");
  }
}

}  // namespace platform::page
