#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <trace/replay.h>

namespace platform::trace {

/// What a timing diagram shows.
struct WaveDromOptions {
  std::vector<std::string> signals;  ///< as users write them, in this order
  ClockEdge every;                   ///< a column for each edge, with the values before it
  std::uint64_t from_ps = 0;
  std::uint64_t to_ps = 0;  ///< after from_ps
};

/// A window as WaveJSON, for WaveDrom. Edges on which nothing changes are drawn as a gap if there
/// are more than three. Throws vp::InputError for an unknown signal, a window without an edge, and
/// one that needs more than 100 columns.
std::string wavedrom_json(TraceFile& file, const WaveDromOptions& options);

}  // namespace platform::trace
