#pragma once

#include <xilinx/common/estimate.h>

namespace xilinx {

/// From one AXI3 master (GP0) to `slaves` AXI4-Lite slaves, with the protocol converter.
inline vp::IpEstimate register_interconnect_estimate(std::uint32_t slaves) {
  return axi_estimate(200 + 45 * slaves, 260 + 55 * slaves, 0);
}

/// From `masters` AXI4 masters of 32 bit to a port of 64 bit (HP0), with the width converter.
inline vp::IpEstimate memory_interconnect_estimate(std::uint32_t masters) {
  return axi_estimate(400 + 250 * masters, 500 + 300 * masters, 0);
}

}  // namespace xilinx
