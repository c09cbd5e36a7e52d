#pragma once

#include <pl/clock_crossing/clock_crossing.h>
#include <pl/common/estimate.h>

namespace pl {

/// A register and a toggle for corners, blobs (two words) and binary words, and the way back.
inline vp::IpEstimate estimate(const ClockCrossing&) {
  return small_ip(40, 280, 100 * mhz);
}

}  // namespace pl
