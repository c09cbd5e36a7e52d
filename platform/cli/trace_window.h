#pragma once

#include <cstdint>
#include <string>

namespace platform::cli {

/// A span of simulated time, ps.
struct TimeWindow {
  std::uint64_t from_ps = 0;
  std::uint64_t to_ps = UINT64_MAX;
};

/// Reads "6ms:7ms", "6 ms : 7.5 ms", ":100us" (from the start) or "2ms:" (to the end).
/// Throws vp::InputError, naming `option`, if it is malformed or ends before it begins.
TimeWindow parse_trace_window(const std::string& text,
                              const std::string& option = "--trace-window");

}  // namespace platform::cli
