#include <page/sweep_block.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <page/json_file.h>
#include <vp/error.h>
#include <vp/text.h>

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

/// Adds "what: a, b" if there are any.
void add_reason(Json& reasons, const char* what, const std::vector<std::string>& names) {
  if (!names.empty()) reasons.push_back(what + vp::join(names, ", "));
}

/// What went wrong, and why the point cannot be built.
Json reasons_of(const Json& outcome) {
  Json reasons = Json::array();
  if (outcome.value("status", "") == "failed") {
    reasons.push_back("failed: " + outcome.value(Json::json_pointer("/failure/message"), ""));
  }
  std::vector<std::string> slow, unknown, large;
  for (const Json& module : part(outcome, "/result/timing/modules")) {
    if (module.value("met", true)) continue;
    (module.value("lower_bound", false) ? unknown : slow).push_back(module.value("name", ""));
  }
  for (const Json& kind : part(outcome, "/result/resources/over")) {
    large.push_back(kind.is_string() ? kind.get<std::string>() : kind.dump());
  }
  add_reason(reasons, "misses timing: ", slow);
  add_reason(reasons, "timing not proven: ", unknown);
  add_reason(reasons, "too large: ", large);
  return reasons;
}

Json point_json(const Json& planned, const Json& swept, const Json& record) {
  Json point;
  point["key"] = planned.at("key");
  point["swept"] = Json::array();
  for (const Json& path : swept) {
    point["swept"].push_back(planned.at("swept").value(path.get<std::string>(), Json()));
  }
  const Json& outcome = part(record, "/outcome");
  const Json& result = part(outcome, "/result");
  point["metrics"] = Json::array();
  for (const char* figure : figures) point["metrics"].push_back(number_at(result, figure));
  for (const char* error : errors) point["metrics"].push_back(mean_error(result, error));
  point["failed"] = outcome.value("status", "") == "failed";
  point["reasons"] = reasons_of(outcome);
  return point;
}

Json block_of_manifest(const Json& manifest, const fs::path& folder) {
  Json json;
  for (const char* key : {"name", "title", "text", "swept", "effects"}) {
    if (manifest.contains(key)) json[key] = manifest[key];
  }
  json["folder"] = folder.string();
  json["metrics"] = Json::array();
  for (const char* figure : figures) json["metrics"].push_back(std::string(figure).substr(1));
  for (const char* error : errors) json["metrics"].push_back(std::string("error/") + error);
  json["points"] = Json::array();
  std::size_t missing = 0;
  for (const Json& planned : manifest.at("points")) {
    const fs::path file = folder / "points" / (planned.at("key").get<std::string>() + ".json");
    std::error_code ignored;
    if (!fs::exists(file, ignored)) {
      ++missing;
      continue;
    }
    json["points"].push_back(
        point_json(planned, manifest.at("swept"), parse_json(read_file(file), file)));
  }
  json["missing"] = missing;
  return json;
}

}  // namespace

std::string sweep_json(const std::string& folder) {
  const fs::path path = fs::path(folder) / "manifest.json";
  const Json manifest = parse_json(read_file(path), path);
  try {
    return block_of_manifest(manifest, folder).dump(-1, ' ', false, Json::error_handler_t::replace);
  } catch (const Json::exception& error) {
    throw vp::InputError("'" + folder + "' is not the folder of a sweep: " + error.what());
  }
}

}  // namespace platform::page
