#pragma once

#include <vp/ip_estimate.h>
#include <xilinx/bram/block_ram.h>
#include <xilinx/bram/bram.h>

namespace xilinx {

/// Exact: blocks of 36 kbit with a 32-bit port and an 8-bit port, which leaves the parity bits
/// unused. The logic that chooses among the blocks is estimated.
inline vp::IpEstimate estimate(const Bram& ip) {
  vp::IpEstimate e;
  e.bram36 = block_ram_36(ip.depth_a, 32, false);
  e.lut = 20 + static_cast<std::uint32_t>(2 * e.bram36);
  e.ff = 20;
  e.source = "block memories computed from UG473's aspect ratios; logic between them assumed";
  e.uncertainty_percent = 0;
  e.fmax_hz = 100'000'000;
  e.fmax_source = vp::Source::derived;
  e.fmax_documentation = "port A works at the thesis' system clock (table 4.3)";
  return e;
}

}  // namespace xilinx
