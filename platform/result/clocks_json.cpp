// The clocks of a design and whether its modules meet them, in result.json.
#include <result/result_json.h>

namespace platform::result {

namespace {

constexpr int clock_mhz_places = 6;
constexpr int clock_percent_places = 3;

}  // namespace

Json to_json(const facts::ClockReport& report) {
  const auto mhz = [](double value) { return rounded(value, clock_mhz_places); };
  Json json;
  json["device"] = report.device;
  json["mode"] = report.mode;
  json["legal"] = report.legal;
  json["list"] = Json::array();
  for (const facts::ClockReport::Clock& clock : report.clocks) {
    Json entry;
    entry["name"] = clock.name;
    entry["wish_mhz"] = mhz(clock.wish_mhz);
    entry["frequency_mhz"] = mhz(clock.frequency_mhz);
    entry["offset_percent"] =
        rounded(100 * (clock.made_mhz / clock.wish_mhz - 1), clock_percent_places);
    Json& made = entry["made"];
    if (!clock.external) {
      made["mhz"] = mhz(clock.made_mhz);
      made["pll"] = clock.pll;
      made["vco_mhz"] = mhz(clock.vco_mhz);
      made["feedback"] = clock.feedback;
      made["divisors"] = {clock.divisor0, clock.divisor1};
    }
    entry["below_mhz"] = clock.below_mhz > 0 ? Json(mhz(clock.below_mhz)) : Json();
    entry["above_mhz"] = clock.above_mhz > 0 ? Json(mhz(clock.above_mhz)) : Json();
    entry["limit_mhz"] = mhz(clock.limit_mhz);
    if (clock.legal_mhz > 0) entry["legal_mhz"] = mhz(clock.legal_mhz);
    entry["limit_confidence"] = clock.limit_confidence;
    entry["margin_percent"] = rounded(clock.margin_percent, clock_percent_places);
    entry["within"] = clock.within;
    entry["makeable"] = clock.makeable;
    entry["used"] = clock.used;
    json["list"].push_back(entry);
  }
  return json;
}

Json to_json(const facts::TimingReport& timing) {
  Json json;
  json["met"] = timing.met;
  json["modules"] = Json::array();
  for (const facts::TimingReport::Module& module : timing.modules) {
    Json entry;
    entry["name"] = module.name;
    entry["clock"] = module.clock;
    entry["frequency_mhz"] = rounded(module.frequency_mhz, clock_mhz_places);
    if (module.known) {
      entry["fmax_mhz"] = rounded(module.fmax_mhz, clock_mhz_places);
      entry["fmax_high_mhz"] = rounded(module.fmax_high_mhz, clock_mhz_places);
    }
    entry["origin"] = module.origin;
    if (module.reachable_mhz > 0)
      entry["reachable_mhz"] = rounded(module.reachable_mhz, clock_mhz_places);
    entry["met"] = module.met;
    if (module.known)
      entry["margin_percent"] = rounded(module.margin_percent, clock_percent_places);
    entry["source"] = module.source;
    json["modules"].push_back(entry);
  }
  return json;
}

}  // namespace platform::result
