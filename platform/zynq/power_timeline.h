#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace platform {

/// Power over simulated time: from each point on, until the next, these watts flow.
///
/// A point stands where a clock changes, the processor falls asleep or wakes, the PL begins or ends
/// a frame, and where a frame's period begins or ends. Energy of events is spread evenly over the
/// period of the frame that they belong to, so the integral over a frame's period is its energy.
struct PowerTimeline {
  struct Point {
    std::uint64_t ps = 0;
    std::vector<double> watts;  ///< one a group
  };

  std::vector<std::string> groups;  ///< "ps", "feature_extraction", …, "static"
  std::vector<Point> points;        ///< in the order of time; the last one has 0 W
};

}  // namespace platform
