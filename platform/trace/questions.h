#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <trace/window.h>
#include <vp/expression.h>

namespace platform::trace {

/// Where and how a condition is looked for.
struct FindOptions : Window {
  std::string condition;
  std::optional<ClockEdge> every;  ///< looked at on these edges only, with the values before them
};

/// A stretch of time in which a condition holds.
struct Occurrence {
  std::uint64_t from_ps = 0;
  std::uint64_t until_ps = 0;  ///< the first instant in which it does not; of an event `from_ps`
  std::uint64_t clocks = 0;    ///< edges in it, with `every`
  bool open = false;           ///< holds to the end of the trace
};

/// What was found.
struct FindSummary {
  std::uint64_t times = 0, clocks = 0, held_ps = 0, longest_ps = 0, longest_at_ps = 0;
  bool evaluated = false;  ///< the condition was known at some time
};

/// Hands over every occurrence as soon as it is over. `take` returns false: enough. Throws
/// vp::InputError.
FindSummary find(TraceFile& file, const FindOptions& options,
                 const std::function<bool(const Occurrence&)>& take);

/// Which values are asked for.
struct ValuesOptions : Window {
  std::vector<std::string> signals;
  std::vector<std::uint64_t> at_ps;  ///< these times, or
  std::string when;                  ///< each time that this comes true, or
  std::optional<ClockEdge> every;    ///< each edge; with `when` those at which it holds
};

/// A time and the values of all signals at it, as people write them.
struct ValueRow {
  std::uint64_t ps = 0;
  std::vector<std::string> values;
};

/// The signals' full names.
std::vector<std::string> value_columns(const TraceFile& file, const ValuesOptions& options);

/// Hands over a row for each moment that is asked for. `take` returns false: enough. Throws
/// vp::InputError, also for a moment behind the trace's end.
void values(TraceFile& file, const ValuesOptions& options,
            const std::function<bool(const ValueRow&)>& take);

}  // namespace platform::trace
