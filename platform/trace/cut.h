#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include <trace/trace_file.h>
#include <vp/trace_filter.h>

namespace platform::trace {

struct CutOptions {
  std::uint64_t from_ps = 0;
  std::uint64_t to_ps = std::numeric_limits<std::uint64_t>::max();
  vp::TraceFilter filter;
};

/// Writes a part of a trace, under our names, as the format that the name `to` tells. Throws
/// vp::InputError; also if the window lies behind the trace or the filter selects nothing.
void cut(TraceFile& file, const std::string& to, const CutOptions& options = {});

}  // namespace platform::trace
