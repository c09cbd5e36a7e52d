#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include <cli/commands.h>
#include <cli/options.h>
#include <trace/statistics.h>

namespace platform::cli {

/// The trace that the options name, opened. Throws vp::InputError.
trace::TraceFile opened(const TraceCommandOptions& options);
/// How they say that a trace is read. Throws vp::InputError.
vp::WaveOptions reading(const TraceCommandOptions& options);
/// Says what is odd about a file that was read.
void warn_of(const trace::TraceFile& file, std::ostream& err);
/// --window; everything without it.
TimeWindow window(const TraceCommandOptions& options);
/// --clock: "55MHz", "top.clk falling" or "m_axis=top.clk". Throws vp::InputError.
trace::StatisticsOptions clocks_of(const TraceCommandOptions& options);

/// Rows that are printed as they are found, since a trace may give more than memory holds: as text,
/// CSV (--csv) or an array of JSON (--json).
class Lines {
 public:
  /// Prints the columns, or the bracket of the array.
  Lines(const TraceCommandOptions& options, std::ostream& out, std::vector<std::string> columns);
  /// Prints the end of the array.
  ~Lines();
  Lines(const Lines&) = delete;
  Lines& operator=(const Lines&) = delete;

  /// False: these are enough (--most).
  bool add(const std::vector<std::string>& cells);

 private:
  void add_words(const std::vector<std::string>& words, const char* separator);

  const TraceCommandOptions& options_;
  std::ostream& out_;
  std::vector<std::string> columns_;
  std::uint64_t count_ = 0;
};

}  // namespace platform::cli
