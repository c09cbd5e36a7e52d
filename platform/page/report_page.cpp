#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <host/document.h>
#include <page/page_file.h>
#include <page/report_page.h>
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

namespace {

namespace fs = std::filesystem;
using report::Json;
constexpr auto replace = Json::error_handler_t::replace;

/// Of a longer run the page shows the first frames; the others stand in result.json.
constexpr std::size_t most_frames = 2000;
/// A result.json up to this size is put into the page as it is.
constexpr std::size_t small_file = 4'000'000;  // bytes

/// The JSON of a file with no more than the first `count` objects of its top-level list `list`, in
/// memory that does not grow with the others. Throws vp::InputError if it is not whole.
Json parse_first(const fs::path& path, const std::string& list, std::size_t count) {
  using Event = Json::parse_event_t;
  std::ifstream file(path, std::ios::binary);
  std::string key;
  std::size_t seen = 0;
  const auto refuse = [&](const std::string& problem) {
    throw vp::InputError("result '" + path.string() + "': " + problem + ": run it again");
  };
  const auto keep = [&](int depth, Event event, const Json& value) {
    if (depth > static_cast<int>(host::deepest_json)) refuse("its values are nested too deeply");
    if (depth == 1 && event == Event::key) key = value.get<std::string>();
    if (depth != 2 || key != list) return true;
    if (event == Event::object_start) return seen < count;
    if (event == Event::object_end) ++seen;
    return true;
  };
  try {
    return Json::parse(file, keep);
  } catch (const Json::parse_error& error) {
    refuse("from byte " + std::to_string(error.byte) + " on it is not JSON, or not whole");
  } catch (const Json::out_of_range&) {
    refuse("a number in it is too large");
  }
  return {};
}

/// Without the frames for which the page has no room.
std::string result_of(const fs::path& path) {
  std::error_code ignored;
  if (fs::file_size(path, ignored) > small_file && !ignored) {
    return parse_first(path, "frames", most_frames).dump();
  }
  return vp::read_text(path, "result");
}

std::string extras_of_page(const fs::path& folder) {
  const fs::path page = folder / report_name;
  std::error_code ignored;
  return fs::exists(page, ignored)
             ? block_of(vp::read_text(page, "report", host::largest_result), "extras")
             : "";
}

/// The blocks of a run; their names end in `suffix`. A file that others wrote is checked.
void add_run(std::vector<Block>& blocks, const fs::path& folder, const std::string& suffix,
             std::string extras) {
  const fs::path path = folder / "result.json";
  std::error_code ignored;
  if (!fs::exists(path, ignored)) {
    throw vp::InputError("'" + folder.string() +
                         "' has no result.json: name a folder that `markervp run` wrote");
  }
  std::string result = result_of(path);
  if (extras.empty()) {
    host::parse_json<Json>(result, "result '" + path.string() + "'");
    extras = extras_of_page(folder);
  }
  blocks.push_back({"result" + suffix, std::move(result)});
  if (!extras.empty()) blocks.push_back({"extras" + suffix, std::move(extras)});
}

}  // namespace

bool write_report(const std::string& folder, const std::string& extras) {
  const fs::path root(folder);
  std::error_code ignored;
  std::vector<Block> blocks;
  if (fs::exists(root / "validation.json", ignored)) {
    const fs::path path = root / "validation.json";
    blocks.push_back(
        {"validation", host::read_json<Json>(path, "validation", host::largest_result).dump()});
    const fs::path frames = root / "frames.csv";
    if (fs::exists(frames, ignored)) {
      blocks.push_back({"frames", Json(vp::read_text(frames, "table", host::largest_result))
                                      .dump(-1, ' ', false, replace)});
    }
  } else if (fs::is_directory(root / "points", ignored)) {
    return write_sweep_report(folder, {});
  } else if (fs::exists(root / "result.json", ignored)) {
    add_run(blocks, root, "", extras);
  } else {
    throw vp::InputError("'" + folder +
                         "' has neither result.json (a run), points/ (a sweep) nor "
                         "validation.json: name a folder that markervp wrote");
  }
  return write_page((root / report_name).string(), blocks);
}

bool write_sweep_report(const std::string& folder, const PointRows& known) {
  return write_page((fs::path(folder) / report_name).string(),
                    {{"sweep", sweep_json(folder, known)}});
}

bool write_comparison(const std::string& first, const std::string& second,
                      const std::string& output) {
  std::vector<Block> blocks;
  add_run(blocks, first, "", "");
  add_run(blocks, second, "-b", "");
  Json names = Json::array({first, second});
  blocks.push_back({"comparison", names.dump(-1, ' ', false, Json::error_handler_t::replace)});
  return write_page(output, blocks);
}

}  // namespace platform::page
