#pragma once

#include <xilinx/common/estimate.h>
#include <xilinx/proc_sys_reset/proc_sys_reset.h>

namespace xilinx {

/// Works after a reset only.
inline vp::IpEstimate estimate(const ProcSysReset&) {
  vp::IpEstimate e = axi_estimate(20, 40, 0);
  e.active_clocks = [] { return std::uint64_t{0}; };
  return e;
}

}  // namespace xilinx
