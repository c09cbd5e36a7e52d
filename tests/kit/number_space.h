#pragma once

#include <string>
#include <utility>
#include <vector>

#include <result/verdict.h>
#include <study/plan.h>
#include <study/results.h>

namespace space_test {

namespace result = platform::result;
namespace study = platform::study;

/// Parameters a and b, numbers from 0 to 1000, and a word.
inline study::Platform numbers() {
  study::Platform platform;
  platform.elaborate = [](const study::Setup& build, const std::string&) {
    study::Elaborated built;
    for (const char* path : {"a", "b", "word"}) {
      const std::string usual = path == std::string("word") ? "plain" : "0";
      const auto set = build.settings.find(path);
      built.parameters.push_back(
          {path, set == build.settings.end() ? usual : set->second, usual, "", {}, ""});
    }
    return built;
  };
  platform.program_file = [](const std::string&, const std::string&) { return ""; };
  platform.version = "1";
  platform.revision = "r";
  return platform;
}

inline double number(const study::Point& point, const std::string& path) {
  for (const auto& [name, value] : point.swept) {
    if (name == path) return std::stod(value);
  }
  return 0;
}

/// Fast is what costs: frames a second grow with a, power with a², and both get worse off b = 500.
inline study::Outcome outcome_of(const study::Point& point) {
  const double a = number(point, "a") / 1000, b = number(point, "b") / 1000 - 0.5;
  std::vector<std::pair<std::string, double>> figures{{"summary.fps.mean", 100 * a - 50 * b * b},
                                                      {"power.total_w.nominal", a * a + b * b}};
  for (const char* part : result::verdict_parts)
    figures.emplace_back("verdict." + std::string(part) + ".holds", 1);
  study::Outcome outcome;
  outcome.metrics = result::Metrics(std::move(figures));
  return outcome;
}

}  // namespace space_test
