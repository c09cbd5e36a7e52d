#pragma once

#include <trace/clock_choice.h>
#include <trace/transactions/interfaces.h>

#include <optional>
#include <string>
#include <vector>

namespace platform::trace {

/// A bus with what the first reading of a trace tells about it.
struct SurveyedInterface {
  BusInterface bus;
  std::optional<std::uint32_t> clock;   ///< variable; none: assumed, or a bus without a clock
  bool falling = false;                 ///< sampled on its falling edges
  std::string clock_text;               ///< for people; empty: a bus without a clock
  std::uint64_t clock_ps = 0;           ///< its period, on average; 0: unknown
  std::uint64_t bit_ps = 0;             ///< of a UART
  std::optional<bool> data_after_high;  ///< of SPI: data change behind the clock's rising edges
};

/// True for a bus whose values count on the edges of a clock wire; the others are looked at on
/// every change.
bool is_clocked(BusKind kind);

/// True for a bus whose transactions are counted in clocks. Those that a simulation wrote are not.
bool counts_clocks(const SurveyedInterface& surveyed);

/// What transactions are found in.
struct Survey {
  std::vector<SurveyedInterface> interfaces;
  std::vector<LeftOut> left_out;
  std::uint64_t last_ps = 0;  ///< of the trace
};

/// Reads the trace once: chooses each bus' clock, as `trace stats` does, joins the names of one
/// bus at several levels (equal in all values throughout; the name nearest the top stays), and
/// measures what serial lines do not say. A bus that follows no clock is left out, unless the user
/// named its clock. What is behind `to_ps` does not count. Throws vp::InputError.
Survey survey(TraceFile& file, FoundInterfaces found, const StatisticsOptions& clocks,
              std::uint64_t to_ps);

}  // namespace platform::trace
