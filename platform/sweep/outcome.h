#pragma once

#include <sweep/metrics.h>
#include <sweep/point_file.h>

namespace platform::sweep {

/// What sweeps tell of a computed point; its file has the rest.
struct Outcome {
  bool failed = false;
  Failure failure;  ///< if it failed
  Metrics metrics;  ///< empty if there is no result
  std::string row;  ///< of the point in report.html, see page/sweep_block.h
};

Outcome outcome_of(const PointRecord& record);

}  // namespace platform::sweep
