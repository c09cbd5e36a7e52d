#include <pl/common/estimate.h>
#include <pl/global_threshold/global_threshold.h>

namespace pl {

// The histogram is cleared in one clock, so its 256 counters are registers, each as wide as the
// number of pixels, read through a multiplexer.
vp::IpEstimate GlobalThreshold::own_estimate() const {
  constexpr std::uint32_t levels = 256;
  std::uint32_t bits = 1;
  while ((std::uint64_t{1} << bits) <= geometry_.pixels()) ++bits;

  vp::IpEstimate e;
  e.kind = "global_threshold";
  e.lut = 150 + levels * 3 / 2 + levels * bits / 3;  // clock enables, multiplexer
  e.ff = 150 + levels * bits;
  e.uncertainty_percent = 40;
  e.source = "derived from the structure of thesis 4.3.5: 256 counters in registers";
  e.fmax_hz = 100 * mhz;
  e.fmax_source = vp::Source::published;
  e.fmax_documentation = "runs comfortably at it (thesis 4.6.1)";
  return e;
}

}  // namespace pl
