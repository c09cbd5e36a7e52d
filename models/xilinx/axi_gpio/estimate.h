#pragma once

#include <xilinx/axi_gpio/axi_gpio.h>
#include <xilinx/common/estimate.h>

namespace xilinx {

/// One channel. Inputs pass a synchroniser of four registers (PG144).
inline vp::IpEstimate estimate(const AxiGpio& ip) {
  const bool inputs = ip.gpio.direction == GpioDirection::all_inputs;
  vp::IpEstimate e = axi_estimate(inputs ? 90 : 70, inputs ? 260 : 110, 0);
  e.active_clocks = [&ip] { return clocks_per_access * accesses(ip.s_axi); };
  return e;
}

}  // namespace xilinx
