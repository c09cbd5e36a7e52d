#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

/// What an MMCM or PLL of the fabric can be set to. No SystemC.
namespace xilinx {

/// The limits of a clock manager in Hz (DS187, tables of MMCM and PLL switching characteristics).
struct ManagerLimits {
  double vco_min, vco_max;  ///< of the oscillator
  double detector_min;      ///< of the phase detector: input over its divider
  unsigned divclk_max;      ///< largest divider of the input
  bool fractional;          ///< multiplier and first divider in steps of 1/8
};

/// `grade`: the speed grade, 1 to 3.
ManagerLimits manager_limits(bool pll, unsigned grade);

/// Dividers and multipliers count eighths.
constexpr std::uint64_t eighths = 8;

/// A way to make a clock with the first output.
struct ManagerSetting {
  unsigned divclk = 1;            ///< divider of the input
  std::uint64_t multiplier = 80;  ///< in eighths
  std::uint64_t divider = 80;     ///< of the output, in eighths
  double vco_hz = 0;
  double hz = 0;
};

/// The settings nearest to `wish_hz`, each frequency once with the fastest oscillator, which has
/// the least jitter; `count` at most. Empty if the input is too slow or too fast for any.
std::vector<ManagerSetting> settings_near(double input_hz, double wish_hz,
                                          const ManagerLimits& limits, std::size_t count);

}  // namespace xilinx
