#include <utility>

#include <host/digest.h>
#include <host/document.h>
#include <study/manifest.h>
#include <study/point.h>
#include <study/worker.h>
#include <vp/error.h>

namespace platform::study {

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  if (end == std::string::npos) return "";
  const std::size_t start = text.rfind('\n', end);
  std::string line = text.substr(start == std::string::npos ? 0 : start + 1,
                                 end - (start == std::string::npos ? 0 : start + 1) + 1);
  const std::string name = "markervp: ";
  return line.rfind(name, 0) == 0 ? line.substr(name.size()) : line;
}

namespace {

constexpr int point_schema = 1;
constexpr const char* point_mark = "markervp_point";

PointRecord new_record(const Manifest& manifest, const PlannedPoint& point) {
  PointRecord record;
  record.key = point.key;
  record.identity = manifest.identity(point);
  record.run["program"] = manifest.families[point.family].program;
  record.run["inputs"] = manifest.input_sets[point.input_set].inputs;
  record.run["settings"] = manifest.settings(point);
  if (!manifest.input.settings.empty()) record.run["input"] = manifest.input.settings;
  return record;
}

void erase_what_stands_elsewhere(Json& result) {
  for (const char* elsewhere : {"provenance", "configuration"}) result.erase(elsewhere);
}

/// Throws HalfPoint for what is no JSON.
Json whole_json(const std::string& path) {
  const std::string text = vp::read_text(path, "point", host::largest_result);
  try {
    return host::parse_json<Json>(text, "");
  } catch (const vp::InputError&) {
    throw HalfPoint(
        "'" + path +
        "' is damaged, or no file of a sweep's point: remove it, and the sweep computes "
        "it again");
  }
}

}  // namespace

std::string json_text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

PointRecord done_record(const Manifest& manifest, const PlannedPoint& point, Json result) {
  PointRecord record = new_record(manifest, point);
  erase_what_stands_elsewhere(result);
  record.outcome["status"] = "done";
  record.outcome["result"] = std::move(result);
  return record;
}

PointRecord failed_record(const Manifest& manifest, const PlannedPoint& point,
                          const Failure& failure, Json result) {
  PointRecord record = new_record(manifest, point);
  record.outcome["status"] = "failed";
  record.outcome["failure"] = {
      {"exit_code", failure.exit_code}, {"signal", failure.signal}, {"message", failure.message}};
  if (result.is_object()) {
    erase_what_stands_elsewhere(result);
    record.outcome["result"] = std::move(result);
  }
  return record;
}

// A member a line. The outcome is most of it, and is put into words once, for the digest and the
// file.
std::string point_text(const PointRecord& record) {
  const std::string outcome = json_text(record.outcome);
  std::string text;
  text.reserve(outcome.size() + record.identity.size() + 4096);
  text += "{\"" + std::string(point_mark) + "\":" + std::to_string(point_schema);
  text += ",\n\"key\":" + json_text(record.key);
  text += ",\n\"identity\":" + record.identity;
  text += ",\n\"run\":" + json_text(record.run);
  text += ",\n\"digest\":" + json_text(host::content_hash(outcome));
  text += ",\n\"outcome\":" + outcome + "}\n";
  return text;
}

std::string identity_start(const Json& program) {
  return "\"identity\":{\"markervp\":" + program.dump() + ",";
}

PointRecord read_point(const std::string& path, bool verify) {
  Json json = whole_json(path);
  const std::string start = "'" + path + "' ";
  if (!json.is_object() || !json.contains(point_mark))
    throw vp::InputError(start + "is no point of a sweep: move it elsewhere");
  if (json[point_mark] != point_schema) {
    throw vp::InputError(start + "has version " + json[point_mark].dump() +
                         " of the format, this program reads version " +
                         std::to_string(point_schema) +
                         ": remove it, and the sweep computes it again");
  }
  try {
    PointRecord record{json.at("key").get<std::string>(), json_text(json.at("identity")),
                       std::move(json.at("run")), std::move(json.at("outcome"))};
    const bool whole =
        !verify || (key_of(record.identity) == record.key &&
                    host::content_hash(json_text(record.outcome)) == json.at("digest"));
    if (whole && (record.failed() || record.outcome.contains("result"))) return record;
  } catch (const Json::exception&) {
  }
  throw vp::InputError(start +
                       "was changed or is damaged: remove it, and the sweep computes it "
                       "again");
}

}  // namespace platform::study
