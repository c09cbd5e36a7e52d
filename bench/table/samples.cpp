#include "samples.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

namespace bench {

namespace {

double in_ms(double time, const std::string& unit) {
  if (unit == "ns") return time / 1e6;
  if (unit == "us") return time / 1e3;
  if (unit == "ms") return time;
  if (unit == "s") return time * 1e3;
  throw std::runtime_error("time in '" + unit + "'");
}

/// Members of an entry that are not counters.
bool is_standard(const std::string& member) {
  static const std::set<std::string> standard{"family_index", "per_family_instance_index",
                                              "repetitions",  "repetition_index",
                                              "threads",      "iterations",
                                              "real_time",    "cpu_time"};
  return standard.count(member) != 0;
}

Sample sample_of(const nlohmann::json& entry) {
  Sample sample;
  sample.cpu_ms = in_ms(entry.at("cpu_time"), entry.at("time_unit"));
  sample.label = entry.value("label", "");
  for (const auto& [name, value] : entry.items()) {
    if (value.is_number() && !is_standard(name)) sample.counters[name] = value;
  }
  return sample;
}

}  // namespace

Round read_samples(const std::string& json, const std::string& only) try {
  const nlohmann::json entries = nlohmann::json::parse(json).at("benchmarks");
  Round samples;
  for (const auto& entry : entries) {
    const std::string name = entries.size() == 1 ? only : entry.at("name").get<std::string>();
    samples[name] = sample_of(entry);
  }
  if (samples.empty()) throw std::runtime_error("it has no benchmark");
  return samples;
} catch (const nlohmann::json::exception& error) {
  throw std::runtime_error(std::string("not a result of Google Benchmark: ") + error.what());
}

std::optional<double> median(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  if (values.size() % 2 == 1) return values[middle];
  return (values[middle - 1] + values[middle]) / 2;
}

std::vector<std::string> disagreeing(const std::vector<Round>& rounds,
                                     const std::vector<std::string>& group) {
  std::vector<std::string> measured;
  std::set<std::string> labels;
  for (const std::string& name : group) {
    bool here = false;
    for (const Round& round : rounds) {
      const auto sample = round.find(name);
      if (sample == round.end()) continue;
      labels.insert(sample->second.label);
      here = true;
    }
    if (here) measured.push_back(name);
  }
  return labels.size() > 1 ? measured : std::vector<std::string>{};
}

}  // namespace bench
