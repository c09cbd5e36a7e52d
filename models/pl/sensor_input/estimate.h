#pragma once

#include <pl/common/estimate.h>
#include <pl/sensor_input/sensor_input.h>

namespace pl {

/// Address and coordinate counters.
inline vp::IpEstimate estimate(const SensorInput&) {
  vp::IpEstimate e = small_ip(70, 65, 100 * mhz);
  e.fmax_source = vp::Source::assumed;
  e.fmax_documentation = "counters and a memory; the thesis clocks it with 50 MHz";
  return e;
}

}  // namespace pl
