#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <facts/result.h>
#include <facts/summary.h>

/// What the console says of a run.

namespace platform::result {

/// "1 point", "2 points".
std::string counted(std::uint64_t count, const std::string& noun);

/// "36 words   2 retries", and what the application adds. What was lost has a warning.
std::string counts_text(const facts::UnitReport& frame);

/// Lines are at most this long, unless a name alone is longer.
constexpr std::size_t console_width = 100;

/// A few lines on one unit of work: what came of it, counts, figures, time per stage. `total` is
/// the number of units of the run, where known.
std::string frame_text(const facts::UnitReport& frame,
                       std::optional<std::uint64_t> total = std::nullopt);

/// What the run amounts to: units, their rate, latency, mean figures, `own` lines of the
/// application, the verdict, and a table of the stages. Of a program that reported no unit: when it
/// ended, and how.
std::string summary_text(const facts::Summary& summary, const facts::RunFacts& facts,
                         const std::vector<std::string>& own = {});

/// One line a clock beyond the speed grade.
std::vector<std::string> clock_warnings(const facts::ClockReport& clocks);
/// One line a clock that is not what was asked for, or that no chip makes.
std::string clock_text(const facts::ClockReport& clocks);

/// One line a module that misses timing: "pl.filter misses timing: …".
std::vector<std::string> timing_warnings(const facts::TimingReport& timing);
/// One line for each kind of primitive that is short.
std::vector<std::string> resource_warnings(const facts::ResourceReport& resources);
/// A junction above what the device is specified for.
std::vector<std::string> power_warnings(const facts::PowerReport& power);

/// "power", "timing" and "fits" for the console, a line each.
std::string design_text(const std::optional<facts::PowerReport>& power,
                        const facts::ResourceReport& resources, const facts::TimingReport& timing);

}  // namespace platform::result
