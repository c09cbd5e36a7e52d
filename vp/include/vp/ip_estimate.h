#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <vp/configuration.h>

namespace vp {

/// What an IP says of its hardware: how much of the device it takes, how fast it can be clocked,
/// and when its logic toggles. Declared beside the model, from the model's own parameters.
struct IpEstimate {
  // Primitives of a Xilinx 7 series device. A block memory of 18 kbit is half of one of 36.
  std::uint32_t lut = 0;
  std::uint32_t ff = 0;
  double bram36 = 0;
  std::uint32_t dsp = 0;
  unsigned uncertainty_percent = 0;
  std::string source;  ///< of the four numbers

  /// Highest clock. With `lower_bound`: the highest at which it is known to work.
  std::uint64_t fmax_hz = 0;
  bool lower_bound = true;
  Source fmax_source = Source::assumed;
  std::string fmax_documentation;

  /// Clocks since the start in which the logic worked. Empty: as long as a frame runs.
  std::function<std::uint64_t()> active_clocks;
};

}  // namespace vp
