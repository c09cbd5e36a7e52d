#include <slcr_registers.h>

#include <ps/slcr/clock_tree.h>
#include <algorithm>

namespace ps::clock_tree {

namespace {

constexpr std::uint32_t largest_divisor = 63;

std::uint64_t distance(std::uint64_t a, std::uint64_t b) {
  return a > b ? a - b : b - a;
}

}  // namespace

std::uint32_t pll_feedback(std::uint32_t pll_ctrl) {
  return (pll_ctrl & slcr::pll_ctrl::PLL_FDIV) >> slcr::pll_ctrl::PLL_FDIV_shift;
}
std::uint32_t pll_lock_cycles(std::uint32_t pll_cfg) {
  return (pll_cfg & slcr::pll_cfg::LOCK_CNT) >> slcr::pll_cfg::LOCK_CNT_shift;
}
std::uint32_t source(std::uint32_t clk_ctrl) {
  return (clk_ctrl & slcr::clk_ctrl::SRCSEL) >> slcr::clk_ctrl::SRCSEL_shift;
}
std::uint32_t divisor0(std::uint32_t clk_ctrl) {
  return (clk_ctrl & slcr::clk_ctrl::DIVISOR0) >> slcr::clk_ctrl::DIVISOR0_shift;
}
std::uint32_t divisor1(std::uint32_t clk_ctrl) {
  return (clk_ctrl & slcr::clk_ctrl::DIVISOR1) >> slcr::clk_ctrl::DIVISOR1_shift;
}

std::uint64_t divided_hz(double source_hz, std::uint32_t divisor0, std::uint32_t divisor1) {
  const std::uint32_t divisor =
      std::max<std::uint32_t>(divisor0, 1) * std::max<std::uint32_t>(divisor1, 1);
  return static_cast<std::uint64_t>(source_hz / divisor + 0.5);
}

std::uint32_t Dividers::clk_ctrl() const {
  return source << slcr::clk_ctrl::SRCSEL_shift | divisor0 << slcr::clk_ctrl::DIVISOR0_shift |
         divisor1 << slcr::clk_ctrl::DIVISOR1_shift;
}

Dividers nearest_dividers(std::uint64_t hertz, const PllOutputs& plls) {
  const struct {
    std::uint32_t select;
    double hertz;
  } sources[] = {{slcr::peripheral_source::io_pll, plls.io},
                 {slcr::peripheral_source::arm_pll, plls.arm},
                 {slcr::peripheral_source::ddr_pll, plls.ddr}};
  Dividers best{slcr::peripheral_source::io_pll, 1, 1, divided_hz(plls.io, 1)};
  for (const auto& source : sources) {
    // By growing difference of the divisors, so that the first of equals is the one wanted.
    for (std::uint32_t difference = 0; difference < largest_divisor; ++difference) {
      for (std::uint32_t small = 1; small + difference <= largest_divisor; ++small) {
        const std::uint64_t given = divided_hz(source.hertz, small + difference, small);
        if (distance(given, hertz) < distance(best.hertz, hertz)) {
          best = {source.select, small + difference, small, given};
        }
      }
    }
  }
  return best;
}

std::uint32_t nearest_cpu_divisor(std::uint64_t hertz, double source_hz) {
  std::uint32_t best = 2;
  for (std::uint32_t divisor = 4; divisor <= largest_divisor; ++divisor) {
    if (distance(divided_hz(source_hz, divisor), hertz) <
        distance(divided_hz(source_hz, best), hertz)) {
      best = divisor;
    }
  }
  return best;
}

}  // namespace ps::clock_tree
