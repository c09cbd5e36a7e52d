#pragma once

#include <iosfwd>

#include <cli/options.h>

namespace platform::cli {

/// What `markervp run --point FILE` runs: the inputs, program and configuration of a
/// sweep's point; --set and --config change it. With --trace the fidelity is left to the trace.
/// Says on `err` if the point was computed by another version. Without --point `options` as they
/// are. Throws vp::InputError for a damaged file, or options that the point decides.
RunOptions with_point(const RunOptions& options, std::ostream& err);

}  // namespace platform::cli
