#include <report/result_parts.h>

#include <report/design_json.h>

namespace platform::report {

void add_run(Json& json, const RunFacts& facts) {
  json["fidelity"] = facts.fidelity;
  json["system"] = facts.system;
  json["design"] = facts.design;
  json["profile"] = facts.profile;
}

void add_end(Json& json, const RunFacts& facts, const std::vector<std::string>& warnings) {
  if (!warnings.empty()) json["warnings"] = warnings;
  if (facts.incomplete) json["incomplete"] = *facts.incomplete;
  if (facts.end) json["program_end"] = to_json(*facts.end);
}

void add_figures(Json& json, const RunFacts& facts, const Summary& summary) {
  if (!summary.stages().empty()) json["stages"] = stages_json(summary);
  json["summary"] = to_json(summary);
  if (facts.power) {
    json["summary"]["power_w"] = power_summary_json(*facts.power);
    if (facts.power->per_frame) {
      json["summary"]["energy_per_frame_mj"] =
          rounded(facts.power->energy_per_frame_mj, energy_places);
    }
  }
  json["verdict"] = to_json(verdict_of(facts, summary));
  if (facts.power) json["power"] = to_json(*facts.power);
  if (facts.resources) json["resources"] = to_json(*facts.resources);
  if (facts.timing) json["timing"] = to_json(*facts.timing);
  if (facts.clocks) json["clocks"] = to_json(*facts.clocks);
}

}  // namespace platform::report
