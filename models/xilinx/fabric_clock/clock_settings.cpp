#include <xilinx/fabric_clock/clock_settings.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace xilinx {

namespace {

constexpr double mhz = 1e6;
constexpr std::uint64_t multiplier_min = 2, multiplier_max = 64, divider_max = 128;  // UG472

/// Two frequencies nearer than that are one: a millihertz.
constexpr double resolution_hz = 1e-3;

}  // namespace

ManagerLimits manager_limits(bool pll, unsigned grade) {
  const std::size_t of_grade = std::clamp(grade, 1u, 3u) - 1;
  constexpr std::array<double, 3> mmcm_max{1200 * mhz, 1440 * mhz, 1600 * mhz};
  constexpr std::array<double, 3> pll_max{1600 * mhz, 1866 * mhz, 2133 * mhz};
  if (pll) return {800 * mhz, pll_max[of_grade], 19 * mhz, 56, false};
  return {600 * mhz, mmcm_max[of_grade], 10 * mhz, 106, true};
}

std::vector<ManagerSetting> settings_near(double input_hz, double wish_hz,
                                          const ManagerLimits& limits, std::size_t count) {
  const std::uint64_t step = limits.fractional ? 1 : eighths;
  std::map<std::int64_t, ManagerSetting> found;  // by frequency
  for (unsigned divclk = 1; divclk <= limits.divclk_max; ++divclk) {
    const double detector_hz = input_hz / divclk;
    if (detector_hz < limits.detector_min) break;
    for (std::uint64_t m = multiplier_min * eighths; m <= multiplier_max * eighths; m += step) {
      const double vco_hz = detector_hz * static_cast<double>(m) / eighths;
      if (vco_hz < limits.vco_min || vco_hz > limits.vco_max) continue;
      const double ideal = vco_hz / wish_hz * eighths / static_cast<double>(step);
      for (const double rounded : {std::floor(ideal), std::ceil(ideal)}) {
        const auto divider = static_cast<std::uint64_t>(std::clamp(
            rounded * static_cast<double>(step), 1.0 * eighths, 1.0 * divider_max * eighths));
        const double hz = vco_hz * eighths / static_cast<double>(divider);
        const ManagerSetting setting{divclk, m, divider, vco_hz, hz};
        const auto [place, is_new] = found.try_emplace(std::llround(hz / resolution_hz), setting);
        if (!is_new && place->second.vco_hz < vco_hz) place->second = setting;
      }
    }
  }
  std::vector<ManagerSetting> list;
  list.reserve(found.size());
  for (const auto& [frequency, setting] : found) list.push_back(setting);
  std::stable_sort(list.begin(), list.end(), [&](const ManagerSetting& a, const ManagerSetting& b) {
    return std::abs(a.hz - wish_hz) < std::abs(b.hz - wish_hz);
  });
  if (list.size() > count) list.resize(count);
  return list;
}

}  // namespace xilinx
