#include "design_schema.h"

namespace integration {

namespace {

using Json = nlohmann::ordered_json;

class Checker {
 public:
  std::vector<std::string> take() { return std::move(problems_); }

  void result(const Json& json) {
    for (const Json& frame : json.value("frames", Json::array())) {
      numbers(frame, "energy_mj",
              {"total", "ps", "feature_extraction", "data_bridge", "image_memory", "static"});
      if (frame.contains("response")) response(frame["response"]);
    }
    if (json.contains("summary")) {
      numbers(json["summary"], "power_w", {"total", "ps", "pl", "static"});
      number(json["summary"], "energy_per_frame_mj");
    }
    if (object(json, "power")) power(json["power"]);
    if (object(json, "resources")) resources(json["resources"]);
    if (object(json, "timing")) timing(json["timing"]);
    if (object(json, "clocks")) clocks(json["clocks"]);
    if (object(json, "verdict"))
      verdict(json["verdict"], json.contains("resources") &&
                                   json["resources"].contains("modules") &&
                                   !json["resources"]["modules"].empty());
  }

 private:
  void expect(bool good, const std::string& problem) {
    if (!good) problems_.push_back(problem);
  }
  bool object(const Json& json, const std::string& key) {
    const bool good = json.contains(key) && json[key].is_object();
    expect(good, key + " is missing or no object");
    return good;
  }
  bool array(const Json& json, const std::string& key) {
    const bool good = json.contains(key) && json[key].is_array();
    expect(good, key + " is missing or no list");
    return good;
  }
  void number(const Json& json, const std::string& key) {
    expect(json.contains(key) && json[key].is_number() && json[key] >= 0,
           key + " is missing or no number from 0 on");
  }
  void signed_number(const Json& json, const std::string& key) {
    expect(json.contains(key) && json[key].is_number(), key + " is missing or no number");
  }
  void text(const Json& json, const std::string& key) {
    expect(json.contains(key) && json[key].is_string() && json[key] != "",
           key + " is missing or no text");
  }
  void truth(const Json& json, const std::string& key) {
    expect(json.contains(key) && json[key].is_boolean(), key + " is missing or not true or false");
  }
  void numbers(const Json& json, const std::string& key, const std::vector<std::string>& names) {
    if (!object(json, key)) return;
    for (const std::string& name : names) number(json[key], name);
  }
  void one_of(const Json& json, const std::string& key, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      if (json.contains(key) && json[key] == name) return;
    }
    problems_.push_back(key + " is missing or unknown");
  }

  /// Of frames whose levels are not known to be light.
  void response(const Json& json) {
    one_of(json, "origin", {"given", "found", "unknown"});
    if (json.value("origin", "") == "found") number(json, "exponent");
  }

  void power(const Json& json) {
    one_of(json, "mode", {"vivado-default", "activity"});
    text(json, "table");
    for (const char* key : {"ambient_c", "junction_c"}) {
      expect(json.contains(key) && json[key].is_number(), std::string(key) + " is missing");
    }
    numbers(json, "total_w", {"low", "nominal", "high"});
    numbers(json, "rails",
            {"Vccaux and others", "Vccbram", "Vccint", "Vcco_ddr", "Vcco_mio", "Vccpaux", "Vccpint",
             "Vccpll"});
    if (json.contains("activity")) {
      for (const Json& activity : json["activity"]) {
        text(activity, "name");
        number(activity, "toggle_rate");
        number(activity, "signal_bits");
      }
    }
    if (!array(json, "modules")) return;
    expect(!json["modules"].empty(), "power.modules is empty");
    for (const Json& module : json["modules"]) {
      text(module, "name");
      text(module, "rail");
      one_of(module, "kind", {"static", "clock", "state", "event"});
      number(module, "w");
      number(module, "mj");
      text(module, "source");
    }
  }

  void amount(const Json& json) {
    for (const char* key : {"lut", "ff", "bram36", "dsp"}) number(json, key);
  }

  void resources(const Json& json) {
    text(json, "device");
    for (const char* key : {"total", "available"}) {
      if (object(json, key)) amount(json[key]);
    }
    truth(json, "fits");
    array(json, "over");
    if (!array(json, "modules")) return;
    for (const Json& module : json["modules"]) {
      text(module, "name");
      amount(module);
      number(module, "uncertainty_percent");
      text(module, "source");
    }
  }

  void timing(const Json& json) {
    truth(json, "met");
    if (!array(json, "modules")) return;
    for (const Json& module : json["modules"]) {
      text(module, "name");
      text(module, "clock");
      number(module, "frequency_mhz");
      number(module, "fmax_mhz");
      number(module, "reachable_mhz");
      number(module, "fmax_high_mhz");
      text(module, "origin");
      truth(module, "met");
      expect(module.contains("margin_percent") && module["margin_percent"].is_number(),
             "margin_percent is missing");
      text(module, "source");
    }
  }

  /// Without PL nothing must fit or be fast enough: there is no margin.
  void verdict(const Json& json, bool has_pl) {
    const std::vector<std::string> holds{"no", "unknown", "yes"};
    one_of(json, "feasible", holds);
    std::string worst = "yes";
    for (const std::string name : {"ran", "job", "fits", "clocks", "timing"}) {
      if (!object(json, name)) continue;
      const Json& part = json[name];
      one_of(part, "holds", holds);
      const std::string how = part.contains("holds") && part["holds"].is_string()
                                  ? part["holds"].get<std::string>()
                                  : "";
      if (how == "no" || worst == "yes") worst = how;
      if (how != "yes") text(part, "why");
      const bool limited = name == "clocks" || (has_pl && (name == "fits" || name == "timing"));
      if (limited) text(part, "by");
      if (limited || name == "job") signed_number(part, "margin_percent");
    }
    expect(json.contains("feasible") && json["feasible"] == worst,
           "the worst part does not decide");
  }

  void clocks(const Json& json) {
    text(json, "device");
    one_of(json, "mode", {"made", "exact"});
    truth(json, "legal");
    if (!array(json, "list")) return;
    expect(json["list"].size() >= 4, "clocks.list lacks CPU, FCLK 0 and 1, or DDR");
    for (const Json& clock : json["list"]) {
      text(clock, "name");
      for (const char* key : {"wish_mhz", "frequency_mhz", "limit_mhz"}) number(clock, key);
      for (const char* key : {"below_mhz", "above_mhz"}) {
        if (!clock.contains(key) || !clock[key].is_null()) number(clock, key);
      }
      const bool external = clock.contains("made") && clock["made"].is_null();
      if (!external && object(clock, "made")) {
        const Json& made = clock["made"];
        for (const char* key : {"mhz", "vco_mhz", "feedback"}) number(made, key);
        one_of(made, "pll", {"ARM", "DDR", "I/O"});
        if (array(made, "divisors")) {
          expect(made["divisors"].size() == 2, "divisors are not two");
          for (const Json& divisor : made["divisors"]) {
            expect(divisor.is_number_unsigned() && divisor >= 1, "a divisor is no count");
          }
        }
      }
      one_of(clock, "limit_confidence", {"published", "derived", "assumed"});
      for (const char* key : {"margin_percent", "offset_percent"}) signed_number(clock, key);
      truth(clock, "within");
      truth(clock, "makeable");
      truth(clock, "used");
    }
  }

  std::vector<std::string> problems_;
};

}  // namespace

std::vector<std::string> design_problems(const Json& result) {
  Checker checker;
  checker.result(result);
  return checker.take();
}

}  // namespace integration
