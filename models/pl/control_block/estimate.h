#pragma once

#include <pl/common/estimate.h>

namespace pl {

/// Control block and frame status: a few gates and flags.
inline vp::IpEstimate control_estimate() {
  return small_ip(25, 10, 100 * mhz);
}

}  // namespace pl
