#include <sweep/manifest.h>

#include <algorithm>
#include <utility>

#include <sweep/identity.h>
#include <vp/error.h>

namespace platform::sweep {

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

Json optional_text(const std::optional<std::string>& text) {
  return text ? Json(*text) : Json(nullptr);
}

std::optional<std::string> text_or_none(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return json.get<std::string>();
}

Json input_json(const InputChoice& input) {
  Json json;
  json["camera"] = optional_text(input.camera);
  json["fit"] = optional_text(input.fit);
  json["frames"] = input.frames ? Json(*input.frames) : Json(nullptr);
  json["repeat"] = input.repeat;
  return json;
}

InputChoice input_from(const Json& json) {
  InputChoice input;
  input.camera = text_or_none(json.at("camera"));
  input.fit = text_or_none(json.at("fit"));
  if (!json.at("frames").is_null()) input.frames = json.at("frames").get<std::uint64_t>();
  input.repeat = json.at("repeat").get<std::uint64_t>();
  return input;
}

Json point_json(const PlannedPoint& point) {
  Json json;
  json["key"] = point.key;
  json["family"] = point.family;
  json["inputs"] = point.input_set;
  json["changes"] = point.changes;
  json["swept"] = Json::object();
  for (const auto& [path, value] : point.swept) json["swept"][path] = value;
  return json;
}

PlannedPoint point_from(const Json& json) {
  PlannedPoint point;
  point.key = json.at("key").get<std::string>();
  point.family = json.at("family").get<std::size_t>();
  point.input_set = json.at("inputs").get<std::size_t>();
  point.changes = json.at("changes").get<std::map<std::string, std::string>>();
  for (const auto& [path, value] : json.at("swept").items())
    point.swept.emplace_back(path, value.get<std::string>());
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

// The configuration is most of it, and goes into words without a tree of values.
std::string Manifest::identity(const PlannedPoint& point) const {
  std::string text = "{\"markervp\":" + program.dump();
  text += ",\"tables\":" + tables.dump();
  text += ",\"contents\":" + families[point.family].contents.dump();
  text += ",\"inputs\":" + input_sets[point.input_set].contents.dump();
  text += ",\"fit\":" + optional_text(input.fit).dump();
  text += ",\"frames\":" + (input.frames ? std::to_string(*input.frames) : "null");
  text += ",\"repeat\":" + std::to_string(input.repeat);
  text += ",\"configuration\":";
  char before = '{';
  visit_configuration(point, [&](const std::string& path, const std::string& value) {
    text += std::exchange(before, ',');
    append_text(text, path);
    text += ':';
    append_text(text, value);
  });
  text += before == '{' ? "{}}" : "}}";
  return text;
}

std::string key_of(std::string_view identity) {
  return content_hash(identity).substr(0, key_digits);
}

Json to_json(const Manifest& manifest) {
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
                                  {"size", {set.size.width, set.size.height}}});
  json["points"] = Json::array();
  for (const PlannedPoint& point : manifest.points) json["points"].push_back(point_json(point));
  json["effects"] = Json::array();
  for (const KeyedEffect& effect : manifest.effects)
    json["effects"].push_back({effect.from, effect.to, effect.path, effect.delta});
  return json;
}

Manifest manifest_from(const Json& json, const std::string& origin) {
  try {
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
      const Json size = set.value("size", Json{0, 0});  // not in files of earlier versions
      manifest.input_sets.push_back({set.at("inputs").get<std::vector<std::string>>(),
                                     set.at("contents"),
                                     {size.at(0).get<int>(), size.at(1).get<int>()}});
    }
    for (const Json& point : json.at("points")) manifest.points.push_back(point_from(point));
    for (const Json& effect : json.at("effects")) {
      manifest.effects.push_back({effect.at(0).get<std::string>(), effect.at(1).get<std::string>(),
                                  effect.at(2).get<std::string>(), effect.at(3).get<double>()});
    }
    check_indices(manifest);
    return manifest;
  } catch (const Json::exception&) {
    throw vp::InputError("'" + origin + "' is no manifest of a sweep, or is damaged");
  }
}

}  // namespace platform::sweep
