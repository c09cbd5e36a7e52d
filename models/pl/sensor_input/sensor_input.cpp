#include <pl/sensor_input/sensor_input.h>

#include <pl/common/estimate.h>

namespace pl {

// Address and coordinate counters.
vp::IpEstimate SensorInput::own_estimate() const {
  vp::IpEstimate e = small_ip("sensor_input", 70, 65, 100 * mhz);
  e.fmax_source = vp::Source::assumed;
  e.fmax_documentation = "counters and a memory; the thesis clocks it with 50 MHz";
  return e;
}

}  // namespace pl
