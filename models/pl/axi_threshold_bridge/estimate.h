#pragma once

#include <pl/axi_threshold_bridge/clocked.h>
#include <pl/common/estimate.h>

namespace pl {

inline vp::IpEstimate estimate(const AxiThresholdBridgeClocked& ip) {
  vp::IpEstimate e = small_ip(60, 80, 100 * mhz);
  add_fifo(e, ip.fifo_depth, 32);
  return e;
}

}  // namespace pl
