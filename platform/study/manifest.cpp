#include <study/manifest.h>

#include <host/digest.h>
#include <host/document.h>
#include <host/process.h>
#include <study/point.h>
#include <vp/error.h>
#include <vp/file.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace platform::study {

namespace {

constexpr int schema = 1;
constexpr const char* mark = "markervp_manifest";

/// Appends it as a JSON text.
void append_text(std::string& json, const std::string& text) {
  const bool plain = std::all_of(text.begin(), text.end(), [](char c) {
    return c >= ' ' && c <= '~' && c != '"' && c != '\\';
  });
  if (!plain) {
    json += Json(text).dump();
    return;
  }
  json += '"';
  json += text;
  json += '"';
}

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

Json point_json(const PlannedPoint& point) {
  Json json;
  json["key"] = point.key;
  json["family"] = point.family;
  json["inputs"] = point.input_set;
  json["changes"] = assignment_json(point.changes);
  json["swept"] = assignment_json(point.swept);
  return json;
}

PlannedPoint point_from(const Json& json) {
  PlannedPoint point;
  point.key = json.at("key").get<std::string>();
  point.family = json.at("family").get<std::size_t>();
  point.input_set = json.at("inputs").get<std::size_t>();
  point.changes = assignment_from(json.at("changes"));
  point.swept = assignment_from(json.at("swept"));
  return point;
}

void check_indices(const Manifest& manifest) {
  for (const PlannedPoint& point : manifest.points) {
    if (point.family >= manifest.families.size() || point.input_set >= manifest.input_sets.size()) {
      throw Json::other_error::create(599, "a point refers to nothing", nullptr);
    }
  }
}

}  // namespace

const char* to_string(Sampling::Method method) {
  switch (method) {
    case Sampling::Method::grid:
      return "grid";
    case Sampling::Method::random:
      return "random";
    case Sampling::Method::sobol:
      return "sobol";
    case Sampling::Method::morris:
      return "morris";
    case Sampling::Method::one_at_a_time:
      return "one-at-a-time";
  }
  return "";
}

std::map<std::string, std::string> Manifest::settings(const PlannedPoint& point) const {
  const std::map<std::string, std::string>& defaults = families[point.family].defaults;
  std::map<std::string, std::string> set;
  auto standard = defaults.begin();
  visit_configuration(point, [&](const std::string& path, const std::string& value) {
    while (standard != defaults.end() && standard->first < path) ++standard;
    const bool same =
        standard != defaults.end() && standard->first == path && standard->second == value;
    if (!same) set.emplace_hint(set.end(), path, value);
  });
  return set;
}

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

std::string Manifest::identity(const PlannedPoint& point) const {
  return Identities(*this).of(point);
}

namespace {

void add_line(std::string& json, const std::string& path, const std::string& value) {
  append_text(json, path);
  json += ':';
  append_text(json, value);
  json += ',';
}

}  // namespace

const Identities::Shared& Identities::shared_by(std::size_t family, std::size_t input_set) {
  constexpr std::size_t most_kept = 1000;  // 20 MB
  if (shared_.size() == most_kept) shared_.clear();
  const auto [known, is_new] = shared_.try_emplace({family, input_set});
  Shared& shared = known->second;
  if (!is_new) return shared;
  const Family& of_point = manifest_.families[family];
  const InputChoice& input = manifest_.input;
  shared.text = "{\"markervp\":" + manifest_.program.dump();
  shared.text += ",\"tables\":" + manifest_.tables.dump();
  shared.text += ",\"contents\":" + of_point.contents.dump();
  shared.text += ",\"inputs\":" + manifest_.input_sets[input_set].contents.dump();
  shared.text += ",\"frames\":" + (input.frames ? std::to_string(*input.frames) : "null");
  shared.text += ",\"repeat\":" + std::to_string(input.repeat);
  shared.text += ",\"configuration\":{";
  for (const auto& [path, value] : of_point.configuration) {
    const std::size_t begin = shared.text.size();
    add_line(shared.text, path, value);
    shared.lines.push_back({path, begin, shared.text.size()});
  }
  return shared;
}

// Between the changes, which are sorted as the lines are, it is what the points share.
std::string Identities::of(const PlannedPoint& point) {
  const Shared& shared = shared_by(point.family, point.input_set);
  std::string text;
  text.reserve(shared.text.size() + shared.text.size() / 8);
  std::size_t copied = 0;
  auto line = shared.lines.begin();
  for (const auto& [path, value] : point.changes) {
    line = std::lower_bound(line, shared.lines.end(), path.text(),
                            [](const Shared::Line& a, const std::string& b) { return a.path < b; });
    const bool is_there = line != shared.lines.end() && line->path == path.text();
    const std::size_t place = line == shared.lines.end() ? shared.text.size() : line->begin;
    text.append(shared.text, copied, place - copied);
    add_line(text, path, value);
    copied = is_there ? line->end : place;
  }
  text.append(shared.text, copied);
  if (text.back() == ',') text.pop_back();
  return text += "}}";
}

std::string key_of(std::string_view identity) {
  return host::content_hash(identity).substr(0, key_digits);
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
  explicit PointTaker(std::vector<PlannedPoint>& points) : points_(points) {}

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
  std::vector<PlannedPoint>& points_;
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
  for (const PlannedPoint& point : manifest.points) {
    file.write(before + json_text(point_json(point)));
    before = ",\n  ";
  }
  file.write("\n ]\n}\n");
  file.commit_durably();
}

Manifest read_manifest(const std::string& file) {
  try {
    const std::string text = vp::read_text(file, "manifest", host::largest_result);
    std::vector<PlannedPoint> points;
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

namespace {

namespace fs = std::filesystem;

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// Parts of an installation that are no data tables.
bool is_table(const fs::path& relative) {
  const std::string first = relative.begin()->string();
  return first != "programs" && first != "studies" && relative.has_parent_path() &&
         relative.extension() != ".so";
}

/// The tables that a scaled cost profile refers to stand beside it.
void add_named_tables(const fs::path& file, Json& contents) {
  if (file.extension() != ".json") return;
  const Json root = host::read_json<Json>(file, "profile");
  if (!root.is_object() || !root.contains("tables") || !root["tables"].is_object()) return;
  for (const auto& [unused, name] : root["tables"].items()) {
    if (!name.is_string()) continue;
    const fs::path table = file.parent_path() / (name.get<std::string>() + ".json");
    std::error_code ignored;
    if (fs::is_regular_file(table, ignored))
      contents[table.filename().string()] = host::file_hash(table.string());
  }
}

}  // namespace

Json program_identity(const std::string& version, const std::string& revision) {
  Json json;
  json["version"] = version;
  json["revision"] = revision;
  if (revision.empty() || ends_with(revision, "-dirty"))
    json["executable"] = host::file_hash("/proc/self/exe");
  return json;
}

Json table_contents() {
  Json json = Json::object();
  std::error_code ignored;
  for (const std::string& folder : host::library_folders()) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder, ignored)) {
      const fs::path relative = entry.path().lexically_relative(folder);
      if (entry.is_regular_file(ignored) && is_table(relative)) files.push_back(relative);
    }
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files)
      json[file.generic_string()] = host::file_hash((fs::path(folder) / file).string());
    if (!files.empty()) break;
  }
  return json;
}

Json file_contents(const std::string& program_file,
                   const std::map<std::string, std::string>& configuration) {
  Json json;
  json["program"] = fs::path(program_file).stem().string();
  json["program_file"] = program_file.empty() ? "" : host::file_hash(program_file);
  json["files"] = Json::object();
  for (const auto& [path, value] : configuration) {
    std::error_code ignored;
    if (fs::path(value).extension().empty() || !fs::is_regular_file(value, ignored)) continue;
    json["files"][path] = host::file_hash(value);
    add_named_tables(value, json["files"]);
  }
  return json;
}

}  // namespace platform::study
