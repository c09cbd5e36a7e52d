#include "table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include "table.h"

#include <algorithm>
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

/// What the time of `with` is above that of `without`, in times of `alone`.
Value added(const std::string& with, const std::string& without, const std::string& alone) {
  return [=](const Round& round, const std::string& image) -> std::optional<double> {
    const auto more = find(round, with + "/" + image), less = find(round, without + "/" + image),
               unit = find(round, alone + "/" + image);
    if (!more || !less || !unit) return std::nullopt;
    return std::max(0.0, more->cpu_ms - less->cpu_ms) / unit->cpu_ms;
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

// RTL takes and gives an image pixel by pixel. Neighbours that do so beside its model, too, are
// clocked with both.
const std::vector<RtlIp>& rtl_ips() {
  static const std::string improved = "design=improved",
                           sensor = "pl.fidelity.sensor_input=clocked",
                           camera = "pl.fidelity.camera=clocked";
  static const std::vector<RtlIp> ips{
      {"corner_detection", {sensor}},
      {"global_threshold", {sensor, "pl.fidelity.blob_detection=clocked"}},
      {"blob_detection", {sensor}},
      {"clock_crossing", {}},
      {"feature_packaging", {}},
      {"axi_threshold_bridge", {}},
      {"otsu_threshold", {improved, camera, "pl.fidelity.blob_labelling=clocked"}},
      {"local_threshold",
       {improved, camera, "pl.fidelity.blob_labelling=clocked", "pl.threshold_rule=local"}},
      {"blob_labelling", {improved, camera}},
      {"pixel_stream", {improved, camera}},
      {"blob_stream", {improved}}};
  return ips;
}

std::vector<Figure> figures(const std::string& fidelity) {
  const auto higher = Figure::Better::higher, lower = Figure::Better::lower;
  const auto clock = Figure::Against::clock;
  constexpr auto none = std::nullopt;
  const std::string system = fidelity + ", whole system";
  std::vector<Figure> all{
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
       higher, read_per_second("reading"), clock},
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
       faster_than_hardware("uploaded"), clock},
      {system + ", image preloaded, against the hardware's real time", none, none, "×", higher,
       faster_than_hardware("preloaded"), clock},
      {fidelity + ", design `improved`, against the hardware's real time", 5, none, "×", higher,
       faster_than_hardware("improved"), clock},
      {fidelity + " against clocked, whole system", none, none, "×", higher,
       faster("uploaded", "uploaded_clocked")},
      {"plain function with our SIMD against the same in plain C++", none, none, "×", higher,
       faster("function", "scalar")},
      {"plain function with our SIMD against the same pixel by pixel", none, none, "×", higher,
       faster("function", "naive")},
      {"corners of a frame against OpenCV's FAST", none, none, "×", higher,
       faster("corner_frame", "opencv_fast")},
      {"`markervp run` of one frame, start to exit", 300, 100, "ms", lower, processor_time("run"),
       clock},
      {"rendering a scene", 30, none, "ms", lower, processor_time("render_scene"), clock},
      {"memory of a long `markervp run`, without the page", 150, none, "MB", lower,
       memory("memory_long")},
      {"what it grew since frame 100", 1, none, "MB", lower, growth},
  };
  for (const auto& [ip, settings] : rtl_ips()) {
    all.push_back(
        {"what `" + ip + "` in RTL adds to the platform, against that RTL alone in Verilator", 1.2,
         none, "×", lower, added("mixed_" + ip, "modelled_" + ip, "alone_" + ip)});
  }
  for (const auto& [ip, settings] : rtl_ips()) {
    all.push_back({"the whole platform with `" + ip + "` in RTL, against that RTL alone", none,
                   none, "×", lower, faster("alone_" + ip, "mixed_" + ip)});
  }
  return all;
}

std::optional<double> reached(const Figure& figure, const std::vector<Round>& rounds,
                              const std::string& image) {
  std::vector<double> values;
  for (const Round& round : rounds) {
    if (const auto value = figure.value(round, image)) values.push_back(*value);
  }
  return median(std::move(values));
}

namespace {

const std::string begin_marker = "<!-- generated by scripts/bench --write -->\n";
const std::string end_marker = "<!-- end of the generated table -->\n";
constexpr const char* absent = "–";

/// Three digits: more would only show what disturbed.
std::string number(double value, const std::string& unit) {
  const int decimals = value < 9.995 ? 2 : value < 99.95 ? 1 : 0;
  return fmt::format("{:.{}f} {}", value, decimals, unit);
}

std::string number(const std::optional<double>& value, const std::string& unit) {
  return value ? number(*value, unit) : absent;
}

std::string bound(const std::optional<double>& value, const std::string& unit) {
  return value ? fmt::format("{:g} {}", *value, unit) : "";
}

/// Characters of a UTF-8 text.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char byte) { return (byte & 0xC0) != 0x80; }));
}

std::string verdict(const Table::Line& line) {
  const Figure& figure = line.figure;
  const std::optional<double>& value = line.values.front();
  if (!figure.must || !value) return "";
  if (!figure.satisfies(*value, *figure.must)) return "missed";
  if (figure.aim && figure.satisfies(*value, *figure.aim)) return "aim";
  return "must";
}

using Cells = std::vector<std::string>;

std::vector<Cells> cells(const Table& table) {
  Cells head{"", "must", "aim"};
  head.insert(head.end(), table.images.begin(), table.images.end());
  head.push_back("reached");
  std::vector<Cells> rows{head};
  for (const Table::Line& line : table.lines) {
    const Figure& figure = line.figure;
    Cells row{figure.title, bound(figure.must, figure.unit), bound(figure.aim, figure.unit)};
    for (const auto& value : line.values) row.push_back(number(value, figure.unit));
    row.push_back(verdict(line));
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

Table make_table(const std::vector<Figure>& figures, const std::vector<Round>& rounds,
                 const std::vector<std::string>& images) {
  Table table{images, {}};
  for (const Figure& figure : figures) {
    Table::Line line{figure, {}};
    for (const std::string& image : images) line.values.push_back(reached(figure, rounds, image));
    const bool measured = std::any_of(line.values.begin(), line.values.end(),
                                      [](const auto& value) { return value.has_value(); });
    if (measured) table.lines.push_back(line);
  }
  return table;
}

std::string plain_text(const Table& table) {
  std::vector<std::size_t> widths;
  const std::vector<Cells> rows = cells(table);
  for (const Cells& row : rows) {
    widths.resize(row.size());
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], width(row[i]));
    }
  }
  std::string text;
  for (const Cells& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string blanks(widths[i] - width(row[i]), ' ');
      text += i == 0 ? row[i] + blanks : "  " + blanks + row[i];
    }
    text += '\n';
  }
  return text;
}

std::string markdown(const Table& table) {
  std::string text;
  bool head = true;
  for (const Cells& row : cells(table)) {
    for (const std::string& cell : row) text += "| " + cell + " ";
    text += "|\n";
    if (!head) continue;
    text += "|---";
    for (std::size_t i = 1; i < row.size(); ++i) text += "|---:";
    text += "|\n";
    head = false;
  }
  return text;
}

std::vector<std::string> misses(const Table& table, double slack) {
  std::vector<std::string> lines;
  for (const Table::Line& line : table.lines) {
    const Figure& figure = line.figure;
    if (figure.against == Figure::Against::clock) continue;
    if (!figure.must || !line.values.front()) continue;
    const double limit =
        figure.better == Figure::Better::higher ? *figure.must / slack : *figure.must * slack;
    if (figure.satisfies(*line.values.front(), limit)) continue;
    lines.push_back(fmt::format("{}: {}, the bound is {}", figure.title,
                                number(*line.values.front(), figure.unit),
                                number(limit, figure.unit)));
  }
  return lines;
}

std::string replace_between_markers(const std::string& document, const std::string& text) {
  const auto begin = document.find(begin_marker);
  const auto end = document.find(end_marker);
  if (begin == std::string::npos || end == std::string::npos || end < begin) {
    throw std::runtime_error("the lines '" + begin_marker.substr(0, begin_marker.size() - 1) +
                             "' and '" + end_marker.substr(0, end_marker.size() - 1) +
                             "' must stand in the document, in this order");
  }
  return document.substr(0, begin + begin_marker.size()) + "\n" + text + "\n" +
         document.substr(end);
}

}  // namespace bench
