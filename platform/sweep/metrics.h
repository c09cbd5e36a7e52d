#pragma once

#include <map>
#include <string>

#include <sweep/manifest.h>

namespace platform::sweep {

/// Figures by name: a path into result.json.
using Metrics = std::map<std::string, double>;

/// Every number and truth of a result (without provenance and configuration) by its path:
/// "summary.fps.mean", "timing.met". Members of a list are named by their `name`, others by their
/// position. Of the frames, mean and largest value over all of them:
/// "frames.counts.corners.mean", "frames.time_us.receive.max", "frames.error.corner_px.mean" (of
/// the markers whose truth is known). Of the timing also "timing.failed" and "timing.unknown": how
/// many modules are clocked above a known limit, and above one of which only a lower bound is
/// known.
Metrics metrics_of(const Json& result);

}  // namespace platform::sweep
