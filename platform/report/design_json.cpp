#include <report/design_json.h>

namespace platform::report {

namespace {

constexpr int celsius_places = 6;
constexpr int mhz_places = 6;
constexpr int percent_places = 3;
constexpr int block_places = 1;

double watts(double value) {
  return rounded(value, energy_places);
}

Json amount_json(const ResourceReport::Amount& amount) {
  Json json;
  json["lut"] = static_cast<std::uint64_t>(amount.lut);
  json["ff"] = static_cast<std::uint64_t>(amount.ff);
  json["bram36"] = rounded(amount.bram36, block_places);
  json["dsp"] = static_cast<std::uint64_t>(amount.dsp);
  return json;
}

}  // namespace

Json energy_json(const std::vector<GroupEnergy>& energy) {
  Json json;
  double total = 0;
  for (const GroupEnergy& part : energy) total += part.mj;
  json["total"] = rounded(total, energy_places);
  for (const GroupEnergy& part : energy) json[part.group] = rounded(part.mj, energy_places);
  return json;
}

Json power_summary_json(const PowerReport& power) {
  Json json;
  json["total"] = watts(power.total_w);
  json["ps"] = watts(power.ps_w);
  json["pl"] = watts(power.pl_w);
  json["static"] = watts(power.static_w);
  return json;
}

Json to_json(const PowerReport& power) {
  Json json;
  json["mode"] = power.mode;
  json["table"] = power.table;
  json["ambient_c"] = rounded(power.ambient_c, celsius_places);
  json["junction_c"] = rounded(power.junction_c, celsius_places);
  json["total_w"]["low"] = watts(power.low_w);
  json["total_w"]["nominal"] = watts(power.total_w);
  json["total_w"]["high"] = watts(power.high_w);
  for (const auto& [rail, value] : power.rails) json["rails"][rail] = watts(value);
  json["modules"] = Json::array();
  for (const PowerReport::Module& module : power.modules) {
    Json entry;
    entry["name"] = module.name;
    entry["rail"] = module.rail;
    entry["kind"] = module.kind;
    entry["w"] = watts(module.w);
    if (power.per_frame) entry["mj"] = rounded(module.mj, energy_places);
    entry["source"] = module.source;
    json["modules"].push_back(entry);
  }
  return json;
}

Json to_json(const ResourceReport& resources) {
  Json json;
  json["device"] = resources.device;
  json["modules"] = Json::array();
  for (const ResourceReport::Module& module : resources.modules) {
    Json entry;
    entry["name"] = module.name;
    entry.update(amount_json(module.amount));
    entry["uncertainty_percent"] = module.uncertainty_percent;
    entry["source"] = module.source;
    json["modules"].push_back(entry);
  }
  json["total"] = amount_json(resources.total);
  json["available"] = amount_json(resources.available);
  json["fits"] = resources.over.empty();
  json["over"] = resources.over;
  return json;
}

Json to_json(const ClockReport& report) {
  const auto mhz = [](double value) { return rounded(value, mhz_places); };
  Json json;
  json["device"] = report.device;
  json["mode"] = report.mode;
  json["legal"] = report.legal;
  json["list"] = Json::array();
  for (const ClockReport::Clock& clock : report.clocks) {
    Json entry;
    entry["name"] = clock.name;
    entry["wish_mhz"] = mhz(clock.wish_mhz);
    entry["frequency_mhz"] = mhz(clock.frequency_mhz);
    entry["offset_percent"] = rounded(100 * (clock.made_mhz / clock.wish_mhz - 1), percent_places);
    Json& made = entry["made"];
    made["mhz"] = mhz(clock.made_mhz);
    made["pll"] = clock.pll;
    made["vco_mhz"] = mhz(clock.vco_mhz);
    made["feedback"] = clock.feedback;
    made["divisors"] = {clock.divisor0, clock.divisor1};
    entry["below_mhz"] = clock.below_mhz > 0 ? Json(mhz(clock.below_mhz)) : Json();
    entry["above_mhz"] = clock.above_mhz > 0 ? Json(mhz(clock.above_mhz)) : Json();
    entry["limit_mhz"] = mhz(clock.limit_mhz);
    entry["limit_confidence"] = clock.limit_confidence;
    entry["margin_percent"] = rounded(clock.margin_percent, percent_places);
    entry["within"] = clock.within;
    entry["makeable"] = clock.makeable;
    json["list"].push_back(entry);
  }
  return json;
}

Json to_json(const TimingReport& timing) {
  Json json;
  json["met"] = timing.met;
  json["modules"] = Json::array();
  for (const TimingReport::Module& module : timing.modules) {
    Json entry;
    entry["name"] = module.name;
    entry["clock"] = module.clock;
    entry["frequency_mhz"] = rounded(module.frequency_mhz, mhz_places);
    entry["fmax_mhz"] = rounded(module.fmax_mhz, mhz_places);
    entry["lower_bound"] = module.lower_bound;
    if (module.reachable_mhz > 0)
      entry["reachable_mhz"] = rounded(module.reachable_mhz, mhz_places);
    entry["met"] = module.met;
    entry["margin_percent"] = rounded(module.margin_percent, percent_places);
    entry["source"] = module.source;
    json["modules"].push_back(entry);
  }
  return json;
}

Json to_json(const Verdict& verdict) {
  Json json;
  json["feasible"] = to_string(verdict.feasible());
  for (const Verdict::Part& part : verdict.parts) {
    Json& entry = json[part.name];
    entry["holds"] = to_string(part.holds);
    if (part.margin_percent)
      entry["margin_percent"] = rounded(*part.margin_percent, percent_places);
    if (!part.by.empty()) entry["by"] = part.by;
    if (part.holds != Holds::yes) entry["why"] = part.why;
  }
  return json;
}

}  // namespace platform::report
