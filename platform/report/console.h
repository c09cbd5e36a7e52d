#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <report/result.h>
#include <report/summary.h>

namespace platform::report {

/// Lines are at most this long, unless a name alone is longer.
constexpr std::size_t console_width = 100;

/// A few lines on one frame: marker, corners, pose, error where the truth is known, counts, time
/// per stage. `total` is the number of frames of the run, where known.
std::string frame_text(const FrameReport& frame, std::optional<std::uint64_t> total = std::nullopt);

/// What the run amounts to: frames, FPS, latency, mean errors, and a table of the stages. Of a
/// program that reported no frame: when it ended, and how.
std::string summary_text(const Summary& summary, const RunFacts& facts);

}  // namespace platform::report
