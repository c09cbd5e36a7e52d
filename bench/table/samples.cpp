#include "samples.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include <nlohmann/json.hpp>

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

namespace {

using Value = std::function<std::optional<double>(const Round&, const std::string&)>;

std::optional<Sample> find(const Round& round, const std::string& name) {
  const auto sample = round.find(name);
  if (sample == round.end()) return std::nullopt;
  return sample->second;
}

/// How many times faster `ours` is than `theirs`.
Value faster(const std::string& ours, const std::string& theirs) {
  return [=](const Round& round, const std::string& image) -> std::optional<double> {
    const auto fast = find(round, ours + "/" + image), slow = find(round, theirs + "/" + image);
    if (!fast || !slow) return std::nullopt;
    return slow->cpu_ms / fast->cpu_ms;
  };
}

/// How many times faster than the modelled hardware.
Value faster_than_hardware(const std::string& name) {
  return [=](const Round& round, const std::string& image) -> std::optional<double> {
    const auto sample = find(round, name + "/" + image);
    if (!sample) return std::nullopt;
    return sample->counters.at("simulated_ms") / sample->cpu_ms;
  };
}

Value read_per_second(const std::string& name) {
  return [=](const Round& round, const std::string& image) -> std::optional<double> {
    const auto sample = find(round, name + "/" + image);
    if (!sample) return std::nullopt;
    constexpr double ms_per_s = 1000;
    return sample->counters.at("read_mb") / sample->cpu_ms * ms_per_s;
  };
}

Value processor_time(const std::string& name) {
  return [=](const Round& round, const std::string& image) -> std::optional<double> {
    const auto sample = find(round, name + "/" + image);
    if (!sample) return std::nullopt;
    return sample->cpu_ms;
  };
}

Value memory(const std::string& name) {
  return [=](const Round& round, const std::string& image) -> std::optional<double> {
    const auto sample = find(round, name + "/" + image);
    if (!sample) return std::nullopt;
    return sample->counters.at("memory_mb");
  };
}

/// Of the memory, from a short run to a long one.
std::optional<double> growth(const Round& round, const std::string& image) {
  const auto before = memory("memory_short")(round, image);
  const auto after = memory("memory_long")(round, image);
  if (!before || !after) return std::nullopt;
  return std::max(0.0, *after - *before);
}

}  // namespace

std::vector<Figure> figures(const std::string& fidelity) {
  const auto higher = Figure::Better::higher, lower = Figure::Better::lower;
  constexpr auto none = std::nullopt;
  const std::string system = fidelity + ", whole system";
  return {
      {"clocked, ports observable, against Verilator, thesis structure", 5, 8, "×", higher,
       faster("clocked", "thesis")},
      {"clocked, ports observable, against Verilator, lean structure", 2.5, 4, "×", higher,
       faster("clocked", "lean")},
      {"clocked, all registers that the detectors show live, against Verilator, thesis structure",
       3, 5, "×", higher, faster("registers", "thesis")},
      {"clocked, VCD of 18 ports, against untraced Verilator, thesis structure", 2, 3.5, "×",
       higher, faster("vcd", "thesis")},
      {"the same against untraced Verilator, lean structure", none, none, "×", higher,
       faster("vcd", "lean")},
      {"own VCD writer against sc_trace, 130 signals (few change; half change)", 4, 7, "×", higher,
       faster("own", "sc_trace")},
      {"VCD read by `markervp trace`, 130 signals (few change; half change)", 100, none, "MB/s",
       higher, read_per_second("reading")},
      {system + ", image preloaded, against the plain function in plain C++", 0.5, 0.8, "×", higher,
       faster("preloaded", "scalar")},
      {system + ", image preloaded, against the plain function with our SIMD", 0.5, 0.8, "×",
       higher, faster("preloaded", "function")},
      {system + ", image preloaded, against the same pixel by pixel", none, none, "×", higher,
       faster("preloaded", "naive")},
      {system + ", image uploaded, against the plain function in plain C++", none, none, "×",
       higher, faster("uploaded", "scalar")},
      {system + ", image uploaded, against the plain function with our SIMD", none, none, "×",
       higher, faster("uploaded", "function")},
      {system + ", image uploaded, against the hardware's real time", 8, 15, "×", higher,
       faster_than_hardware("uploaded")},
      {system + ", image preloaded, against the hardware's real time", none, none, "×", higher,
       faster_than_hardware("preloaded")},
      {fidelity + " against clocked, whole system", none, none, "×", higher,
       faster("uploaded", "uploaded_clocked")},
      {"plain function with our SIMD against the same in plain C++", none, none, "×", higher,
       faster("function", "scalar")},
      {"plain function with our SIMD against the same pixel by pixel", none, none, "×", higher,
       faster("function", "naive")},
      {"corners of a frame against OpenCV's FAST", none, none, "×", higher,
       faster("corner_frame", "opencv_fast")},
      {"`markervp run` of one frame, start to exit", 300, 100, "ms", lower, processor_time("run")},
      {"rendering a scene", 30, none, "ms", lower, processor_time("render_scene")},
      {"memory of a long `markervp run`, without the page", 150, none, "MB", lower,
       memory("memory_long")},
      {"what it grew since frame 100", 1, none, "MB", lower, growth},
  };
}

std::optional<double> reached(const Figure& figure, const std::vector<Round>& rounds,
                              const std::string& image) {
  std::vector<double> values;
  for (const Round& round : rounds) {
    if (const auto value = figure.value(round, image)) values.push_back(*value);
  }
  return median(std::move(values));
}

}  // namespace bench
