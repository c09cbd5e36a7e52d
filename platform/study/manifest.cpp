#include <study/manifest.h>

#include <host/document.h>
#include <result/figures.h>
#include <vp/error.h>
#include <vp/file.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace platform::study {

namespace {

constexpr int schema = 1;
constexpr const char* mark = "markervp_manifest";

Json input_json(const InputChoice& input) {
  Json json;
  json["settings"] = input.settings;
  json["frames"] = input.frames ? Json(*input.frames) : Json(nullptr);
  json["repeat"] = input.repeat;
  return json;
}

InputChoice input_from(const Json& json) {
  InputChoice input;
  input.settings = json.value("settings", input.settings);
  for (const char* setting : {"camera", "fit"}) {  // of earlier versions
    if (json.contains(setting) && json[setting].is_string())
      input.settings[setting] = json[setting].get<std::string>();
  }
  if (!json.at("frames").is_null()) input.frames = json.at("frames").get<std::uint64_t>();
  input.repeat = json.at("repeat").get<std::uint64_t>();
  return input;
}

Json assignment_json(const Assignment& values) {
  Json json = Json::object();
  for (const auto& [path, value] : values) json[path.text()] = value.text();
  return json;
}

Assignment assignment_from(const Json& json) {
  Assignment values;
  values.reserve(json.size());
  for (const auto& [path, value] : json.items())
    values.emplace_back(path, value.get_ref<const std::string&>());
  return values;
}

Json point_json(const Point& point) {
  Json json;
  json["key"] = point.key;
  json["family"] = point.family;
  json["inputs"] = point.input_set;
  json["changes"] = assignment_json(point.changes);
  json["swept"] = assignment_json(point.swept);
  return json;
}

Point point_from(const Json& json) {
  Point point;
  point.key = json.at("key").get<std::string>();
  point.family = json.at("family").get<std::size_t>();
  point.input_set = json.at("inputs").get<std::size_t>();
  point.changes = assignment_from(json.at("changes"));
  point.swept = assignment_from(json.at("swept"));
  return point;
}

void check_indices(const Manifest& manifest) {
  for (const Point& point : manifest.points) {
    if (point.family >= manifest.families.size() || point.input_set >= manifest.input_sets.size()) {
      throw Json::other_error::create(599, "a point refers to nothing", nullptr);
    }
  }
}

}  // namespace

std::vector<std::vector<std::string>> Manifest::dimensions() const {
  std::vector<std::vector<std::string>> found = zipped;
  const auto is_zipped = [&](const std::string& path) {
    return std::any_of(zipped.begin(), zipped.end(), [&](const auto& group) {
      return std::find(group.begin(), group.end(), path) != group.end();
    });
  };
  for (const std::string& path : swept) {
    if (!is_zipped(path)) found.push_back({path});
  }
  return found;
}

namespace {

/// All but the points.
Json facts_json(const Manifest& manifest) {
  Json json;
  json[mark] = schema;
  json["name"] = manifest.name;
  json["title"] = manifest.title;
  json["text"] = manifest.text;
  json["source"] = manifest.source;
  json["program"] = manifest.program;
  json["tables"] = manifest.tables;
  json["input"] = input_json(manifest.input);
  json["sampling"] = manifest.sampling;
  json["swept"] = manifest.swept;
  if (!manifest.zipped.empty()) json["zipped"] = manifest.zipped;
  if (!manifest.job.empty()) json["job"] = manifest.job;
  if (!manifest.figures.empty()) json["figures"] = manifest.figures;
  json["metrics"] = manifest.metrics;
  json["objectives"] = manifest.objectives;
  json["constraints"] = manifest.constraints;
  json["families"] = Json::array();
  for (const Family& family : manifest.families) {
    json["families"].push_back({{"program", family.program},
                                {"contents", family.contents},
                                {"configuration", family.configuration},
                                {"defaults", family.defaults}});
  }
  json["input_sets"] = Json::array();
  for (const InputSet& set : manifest.input_sets)
    json["input_sets"].push_back({{"inputs", set.inputs},
                                  {"contents", set.contents},
                                  {"need", {set.need.kind, set.need.bytes, set.need.shape}}});
  json["effects"] = Json::array();
  for (const KeyedEffect& effect : manifest.effects)
    json["effects"].push_back({effect.from, effect.to, effect.path, effect.delta});
  return json;
}

/// Takes the points out of the document while it is read: their trees would fill the memory.
class PointTaker {
 public:
  explicit PointTaker(std::vector<Point>& points) : points_(points) {}

  bool operator()(int depth, Json::parse_event_t event, Json& value) {
    constexpr int member = 1, item = 2;
    if (event == Json::parse_event_t::key && depth == member) in_points_ = value == "points";
    if (event != Json::parse_event_t::object_end || depth != item || !in_points_) return true;
    try {
      points_.push_back(point_from(value));
    } catch (const Json::exception&) {
      throw Json::other_error::create(599, "no point", nullptr);  // not the parser's own
    }
    return false;
  }

 private:
  std::vector<Point>& points_;
  bool in_points_ = false;
};

Manifest facts_from(const Json& json, const std::string& origin) {
  Manifest manifest;
  if (json.at(mark) != schema) {
    throw vp::InputError("'" + origin + "' has version " + json.at(mark).dump() +
                         ", this program reads version " + std::to_string(schema) +
                         ": run the sweep again");
  }
  manifest.name = json.at("name").get<std::string>();
  manifest.title = json.at("title").get<std::string>();
  manifest.text = json.at("text").get<std::string>();
  manifest.source = json.at("source").get<std::string>();
  manifest.program = json.at("program");
  manifest.tables = json.at("tables");
  manifest.input = input_from(json.at("input"));
  manifest.sampling = json.at("sampling").get<std::string>();
  manifest.swept = json.at("swept").get<std::vector<std::string>>();
  manifest.zipped = json.value("zipped", std::vector<std::vector<std::string>>());
  manifest.job = json.value("job", "");
  manifest.figures = json.value("figures", Json::array());
  result::declare(manifest.figures);
  manifest.metrics = json.at("metrics").get<std::vector<std::string>>();
  manifest.objectives = json.at("objectives").get<std::vector<std::string>>();
  manifest.constraints = json.value("constraints", std::vector<std::string>());
  for (const Json& family : json.at("families")) {
    manifest.families.push_back(
        {family.at("program").get<std::string>(),
         family.at("configuration").get<std::map<std::string, std::string>>(),
         family.at("defaults").get<std::map<std::string, std::string>>(), family.at("contents")});
  }
  for (const Json& set : json.at("input_sets")) {
    const Json need = set.value("need", Json{"none", 0, ""});  // not in files of earlier versions
    manifest.input_sets.push_back({set.at("inputs").get<std::vector<std::string>>(),
                                   set.at("contents"),
                                   {need.at(0).get<std::string>(), need.at(1).get<std::size_t>(),
                                    need.at(2).get<std::string>()}});
  }
  for (const Json& effect : json.at("effects")) {
    manifest.effects.push_back({effect.at(0).get<std::string>(), effect.at(1).get<std::string>(),
                                effect.at(2).get<std::string>(), effect.at(3).get<double>()});
  }
  return manifest;
}

}  // namespace

void write_manifest(const std::string& path, const Manifest& manifest) {
  vp::OutputFile file(path);
  std::string facts = facts_json(manifest).dump(1);
  facts.erase(facts.rfind("\n}"));
  file.write(facts + ",\n \"points\": [");
  const char* before = "\n  ";
  for (const Point& point : manifest.points) {
    file.write(before + json_text(point_json(point)));
    before = ",\n  ";
  }
  file.write("\n ]\n}\n");
  file.commit_durably();
}

Manifest read_manifest(const std::string& file) {
  try {
    const std::string text = vp::read_text(file, "manifest", host::largest_result);
    std::vector<Point> points;
    const Json facts = host::parse_json<Json>(text, "manifest '" + file + "'", PointTaker(points));
    Manifest manifest = facts_from(facts, file);
    if (!facts.at("points").empty()) throw Json::other_error::create(599, "no point", nullptr);
    manifest.points = std::move(points);
    check_indices(manifest);
    return manifest;
  } catch (const Json::exception&) {
    throw vp::InputError("'" + file + "' is no manifest of a sweep, or is damaged");
  }
}

}  // namespace platform::study
