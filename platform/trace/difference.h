#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <trace/trace_file.h>
#include <vp/trace_filter.h>

namespace platform::trace {

struct DifferenceOptions {
  bool by_frame = false;               ///< else by time
  std::string frame = "ps.cpu.frame";  ///< its changes begin frames
  vp::TraceFilter filter;              ///< which signals
  unsigned neighbourhood = 8;          ///< changes shown before and after, of each trace
};

struct Difference {
  /// A change near the divergence.
  struct Event {
    std::uint64_t ps;
    std::string path, value;
  };
  struct Value {
    std::string path, in_a, in_b;
  };
  bool differ = false;
  std::uint64_t a_ps = 0, b_ps = 0;  ///< where it begins
  std::uint64_t frame = 0, in_frame_ps = 0;
  std::vector<Value> values;  ///< what differs there
  std::vector<Event> a_before, a_after, b_before, b_after;
  std::vector<std::string> only_in_a, only_in_b;  ///< signals
  std::uint64_t compared = 0;                     ///< signals in both
};

/// The first instant at which a signal of both traces differs. Throws vp::InputError if they have
/// no signal in common, or lack the frame signal.
Difference difference(TraceFile& a, TraceFile& b, const DifferenceOptions& options = {});

}  // namespace platform::trace
