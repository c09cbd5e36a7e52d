#pragma once

#include <pl/axi_image_store/clocked.h>
#include <pl/common/estimate.h>

namespace pl {

/// An address counter. Works while an image is uploaded, which is not part of a frame.
inline vp::IpEstimate estimate(const AxiImageStoreClocked&) {
  vp::IpEstimate e = small_ip(50, 60, 100 * mhz);
  e.active_clocks = [] { return std::uint64_t{0}; };
  return e;
}

}  // namespace pl
