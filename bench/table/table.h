#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bench {

/// One thing measured once.
struct Sample {
  double cpu_ms = 0;                       ///< processor time of a frame, or of a process
  std::map<std::string, double> counters;  ///< other values that the program reported
  std::string label;                       ///< a hash of what it computed; may be empty
};

/// Samples of one round by name: "clocked/demo".
using Round = std::map<std::string, Sample>;

/// The samples in Google Benchmark's JSON. A program of one benchmark gives it the name `only`;
/// otherwise they are called as the program calls them. Throws std::runtime_error if the text is
/// none.
Round read_samples(const std::string& json, const std::string& only);

/// The middle one, or between the two in the middle; nothing of nothing.
std::optional<double> median(std::vector<double> values);

/// Names of a group ("thesis/demo", "lean/demo" …) whose labels differ in any round: they did not
/// compute the same. Those that were not measured do not count.
std::vector<std::string> disagreeing(const std::vector<Round>& rounds,
                                     const std::vector<std::string>& group);

/// One line of the table.
struct Figure {
  enum class Better { higher, lower };
  enum class Against { peer, clock };

  std::string title;
  std::optional<double> must, aim;  ///< on the first image; nothing: for comparison only
  std::string unit;                 ///< "×", "ms", "MB"
  Better better = Better::higher;
  /// Of one round and image; nothing if it was not measured.
  std::function<std::optional<double>(const Round&, const std::string& image)> value;
  /// What was measured in the same round, or the wall clock: that one judges the host, too.
  Against against = Against::peer;

  bool satisfies(double value, double bound) const {
    return better == Better::higher ? value >= bound : value <= bound;
  }
};

/// An IP whose RTL is measured in the platform and alone.
struct RtlIp {
  std::string name;
  std::vector<std::string> settings;  ///< of the platform around it, at the transaction level
};
const std::vector<RtlIp>& rtl_ips();

/// All of them, in the order of the table. `fidelity` of the whole system, for the titles.
std::vector<Figure> figures(const std::string& fidelity);

/// A figure's value on one image: the median over the rounds.
std::optional<double> reached(const Figure& figure, const std::vector<Round>& rounds,
                              const std::string& image);

/// The figures with their values, ready to print.
struct Table {
  struct Line {
    Figure figure;
    std::vector<std::optional<double>> values;  ///< by image; nothing: not measured
  };

  std::vector<std::string> images;
  std::vector<Line> lines;
};

/// Lines that were not measured on any image are left out.
Table make_table(const std::vector<Figure>& figures, const std::vector<Round>& rounds,
                 const std::vector<std::string>& images);

std::string plain_text(const Table& table);
std::string markdown(const Table& table);

/// One line for each figure of the first image that misses its `must`, loosened by `slack`: 1 is
/// the must itself, 2 half of it. Figures against the clock are left out: a busy host misses them.
std::vector<std::string> misses(const Table& table, double slack);

/// `document` with everything between its marker lines replaced by `text`. Throws
/// std::runtime_error if a marker is missing.
std::string replace_between_markers(const std::string& document, const std::string& text);

}  // namespace bench
