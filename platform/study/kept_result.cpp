#include <study/kept_result.h>

#include <filesystem>
#include <utility>

#include <host/digest.h>
#include <host/document.h>
#include <vp/file.h>

namespace platform::study {

namespace {

constexpr int kept_schema = 1;
constexpr const char* kept_mark = "markervp_point";
constexpr const char* compute_again = "remove it, and the sweep computes it again";

/// Throws HalfPoint for what is no JSON.
Json whole_json(const std::string& path) {
  const std::string text = vp::read_text(path, "point", host::largest_result);
  try {
    return host::parse_json<Json>(text, "");
  } catch (const vp::InputError&) {
    throw HalfPoint("'" + path + "' is damaged, or no file of a sweep's point: " + compute_again);
  }
}

Json run_json(const Setup& setup) {
  Json json;
  json["program"] = setup.program;
  json["inputs"] = setup.inputs;
  json["settings"] = setup.settings;
  if (!setup.input.settings.empty()) json["input"] = setup.input.settings;
  return json;
}

Json outcome_json(const KeptResult& kept) {
  const Outcome& outcome = kept.outcome;
  Json json;
  json["status"] = outcome.failed ? "failed" : "done";
  if (outcome.failed) {
    json["failure"] = {{"exit_code", outcome.failure.exit_code},
                       {"signal", outcome.failure.signal},
                       {"message", outcome.failure.message}};
  }
  if (!kept.result.is_object()) return json;
  json["result"] = kept.result;
  for (const char* elsewhere : {"provenance", "configuration"}) json["result"].erase(elsewhere);
  return json;
}

/// Earlier versions had a member for each setting of the inputs.
Setup setup_from(const Json& run, const Json& identity) {
  Setup setup{run.at("program").get<std::string>(),
              run.at("settings").get<std::map<std::string, std::string>>(),
              run.at("inputs").get<std::vector<std::string>>(),
              {}};
  InputChoice& input = setup.input;
  input.settings = run.value("input", input.settings);
  for (const Json* from : {&run, &identity}) {
    for (const char* setting : {"camera", "fit"}) {
      if (from->contains(setting) && from->at(setting).is_string())
        input.settings.emplace(setting, from->at(setting).get<std::string>());
    }
  }
  if (!identity.at("frames").is_null()) input.frames = identity.at("frames").get<std::uint64_t>();
  input.repeat = identity.at("repeat").get<std::uint64_t>();
  return setup;
}

Outcome outcome_from(const Json& json) {
  Outcome outcome;
  outcome.failed = json.at("status") == "failed";
  if (outcome.failed) {
    const Json& failure = json.at("failure");
    outcome.failure = {failure.value("exit_code", -1), failure.value("signal", 0),
                       failure.value("message", "")};
  }
  if (json.contains("result")) {
    outcome.metrics = result::metrics_of(json.at("result"));
    outcome.complaints = complaints_of(json.at("result"));
  }
  return outcome;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> complaints_of(const Json& result) {
  std::vector<std::pair<std::string, std::string>> complaints;
  if (!result.is_object() || !result.contains("verdict")) return complaints;
  for (const auto& [part, judged] : result.at("verdict").items()) {
    if (judged.is_object() && judged.contains("why"))
      complaints.emplace_back(part, judged["why"].get<std::string>());
  }
  return complaints;
}

// A member a line. The outcome is most of it, and is put into words once, for the digest and the
// file.
std::string kept_text(const KeptResult& kept) {
  const std::string outcome = json_text(outcome_json(kept));
  std::string text;
  text.reserve(outcome.size() + kept.identity.size() + 4096);
  text += "{\"" + std::string(kept_mark) + "\":" + std::to_string(kept_schema);
  text += ",\n\"key\":" + json_text(kept.key);
  text += ",\n\"identity\":" + kept.identity;
  text += ",\n\"run\":" + json_text(run_json(kept.setup));
  text += ",\n\"digest\":" + json_text(host::content_hash(outcome));
  text += ",\n\"outcome\":" + outcome + "}\n";
  return text;
}

KeptResult read_kept(const std::string& path) {
  Json json = whole_json(path);
  const std::string start = "'" + path + "' ";
  if (!json.is_object() || !json.contains(kept_mark))
    throw vp::InputError(start + "is no point of a sweep: move it elsewhere");
  if (json[kept_mark] != kept_schema) {
    throw vp::InputError(start + "has version " + json[kept_mark].dump() +
                         " of the format, this program reads version " +
                         std::to_string(kept_schema) + ": " + compute_again);
  }
  try {
    const Json& identity = json.at("identity");
    Json& outcome = json.at("outcome");
    KeptResult kept{json.at("key").get<std::string>(),
                    json_text(identity),
                    setup_from(json.at("run"), identity),
                    outcome_from(outcome),
                    {}};
    const bool whole = key_of(kept.identity) == kept.key &&
                       host::content_hash(json_text(outcome)) == json.at("digest") &&
                       (kept.outcome.failed || outcome.contains("result"));
    if (whole) {
      const std::string name = std::filesystem::path(path).stem().string();
      if (is_key(name) && name != kept.key)
        throw vp::InputError(start + "is the point " + kept.key +
                             " under another name: " + compute_again);
      if (outcome.contains("result")) kept.result = std::move(outcome["result"]);
      return kept;
    }
  } catch (const Json::exception&) {
  }
  throw vp::InputError(start + "was changed or is damaged: " + compute_again);
}

}  // namespace platform::study
