#pragma once

#include <pl/common/estimate.h>
#include <pl/feature_packaging/clocked.h>

namespace pl {

/// Two buffers, and what builds and chooses words.
inline vp::IpEstimate estimate(const FeaturePackagingClocked& ip) {
  vp::IpEstimate e = small_ip(150, 110, 100 * mhz);
  add_fifo(e, ip.buffer_depth, 32);
  add_fifo(e, ip.buffer_depth, 32);
  return e;
}

}  // namespace pl
