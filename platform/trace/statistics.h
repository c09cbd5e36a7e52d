#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <trace/replay.h>
#include <trace/vocabulary.h>

namespace platform::trace {

/// Numbers with names: what an analysis found, for people, scripts and spreadsheets.
struct Table {
  using Cell = std::variant<std::string, std::uint64_t, double>;

  std::string name;  ///< a key: "links"
  std::string title;
  std::vector<std::string> columns;  ///< keys with their unit: "longest_stall_us"
  std::vector<std::vector<Cell>> rows;
  bool detail = false;  ///< long: left out of the text
};

/// Columns lined up, a title above each table; empty tables and details are left out.
std::string tables_as_text(const std::vector<Table>& tables);
/// {"links": [{"link": "pl.samples", "beats": 76800}]}
std::string tables_as_json(const std::vector<Table>& tables);
/// Blocks separated by an empty line: the table's name, the columns, the rows.
std::string tables_as_csv(const std::vector<Table>& tables);

/// A cell of a CSV in quotes, and a text of JSON.
std::string quoted_cell(const std::string& text);
std::string json_text(const std::string& text);

constexpr double ps_per_us = 1e6;
constexpr double ps_per_s = 1e12;

/// What the statistics must know of the hardware.
struct StatisticsOptions {
  /// Of the links, for a trace without the wire ps.fclk_clk0.clk (see --trace-clocks).
  std::uint64_t system_hz = 100'000'000;
  std::optional<ClockEdge> clock{};                                ///< of all links
  std::vector<std::pair<std::string, ClockEdge>> clock_of_link{};  ///< of some, by name
};

/// One kind of statistics. It follows the signals it finds in the trace.
class Statistic {
 public:
  virtual ~Statistic() = default;
  /// False if the trace has nothing of this kind.
  virtual bool found() const = 0;
  virtual void instant(std::uint64_t ps) = 0;
  /// The trace is over at `ps`.
  virtual void finish(std::uint64_t ps) = 0;
  virtual void report(std::vector<Table>& tables) const = 0;
};

/// AXI-Streams and other links with `…valid` and `…ready`: beats, packets, stalls (the master
/// waits), starved edges (the slave waits), waits from VALID to the beat, bursts.
std::unique_ptr<Statistic> link_statistic(Replay& replay, TraceFile& file,
                                          const StatisticsOptions& options);
/// Buffers: time-weighted occupancy, high-water mark, time full and empty; overflow counters.
std::unique_ptr<Statistic> buffer_statistic(Replay& replay, const Vocabulary& words);
/// Interrupts: from the line's rise to the acknowledgement.
std::unique_ptr<Statistic> interrupt_statistic(Replay& replay, const Vocabulary& words);
/// The stages of our programs in each frame, as in result.json.
std::unique_ptr<Statistic> stage_statistic(Replay& replay, const Vocabulary& words);
/// Frames: latency, FPS, feature words and overflows; and the functions' time in each.
std::unique_ptr<Statistic> frame_statistic(Replay& replay, const Vocabulary& words);

/// All of them, of the design whose words are given. Throws vp::InputError for a trace that has
/// nothing of ours, or whose links do not run on the clock.
std::vector<Table> statistics(TraceFile& file, const Vocabulary& words,
                              const StatisticsOptions& options = {});

}  // namespace platform::trace
