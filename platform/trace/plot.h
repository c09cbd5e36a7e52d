#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <trace/trace_file.h>

namespace platform::trace {

struct PlotOptions {
  std::vector<std::string> signals;  ///< as users write them, in this order
  std::uint64_t from_ps = 0;
  std::uint64_t to_ps = 0;                 ///< after from_ps
  std::optional<std::uint64_t> marker_ps;  ///< a line there
  unsigned width = 1100;                   ///< of the picture in px
};

/// The picture of a window as SVG: bits as lines, vectors and texts as boxes with their values,
/// reals as curves. What changes more often than there are pixels is drawn as a block. Throws
/// vp::InputError for an unknown signal.
std::string plot_as_svg(TraceFile& file, const PlotOptions& options);

}  // namespace platform::trace
