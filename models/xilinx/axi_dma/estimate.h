#pragma once

#include <xilinx/axi_dma/axi_dma.h>
#include <xilinx/common/estimate.h>

namespace xilinx {

/// Direct register mode, 32 bit: the DataMover's FIFO for a burst is block memory (PG021).
inline vp::IpEstimate estimate(const AxiDma& ip) {
  const std::uint32_t channels = (ip.include_mm2s ? 1u : 0u) + (ip.include_s2mm ? 1u : 0u);
  return axi_estimate(250 + 900 * channels, 300 + 1300 * channels, 1.0 * channels);
}

}  // namespace xilinx
