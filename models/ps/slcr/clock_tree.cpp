#include <slcr_registers.h>

#include <ps/slcr/clock_tree.h>
#include <algorithm>

namespace ps::clock_tree {

namespace {

constexpr std::uint32_t largest_divisor = 63;

/// UG585 table 25-6, by the largest feedback divider of a row.
struct LoopFilter {
  std::uint32_t to, charge_pump, resistor, lock_count;
};
constexpr std::uint32_t largest_feedback = 66;
constexpr LoopFilter loop_filters[] = {
    {13, 2, 6, 750},  {14, 2, 6, 700},  {15, 2, 6, 650},  {16, 2, 10, 625},
    {17, 2, 10, 575}, {18, 2, 10, 550}, {19, 2, 10, 525}, {20, 2, 12, 500},
    {21, 2, 12, 475}, {22, 2, 12, 450}, {23, 2, 12, 425}, {25, 2, 12, 400},
    {26, 2, 12, 375}, {28, 2, 12, 350}, {30, 2, 12, 325}, {33, 2, 2, 300},
    {36, 2, 2, 275},  {40, 2, 2, 250},  {47, 3, 12, 250}, {largest_feedback, 2, 4, 250}};

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
std::uint32_t pll_ctrl_of(std::uint32_t feedback) {
  return feedback << slcr::pll_ctrl::PLL_FDIV_shift | slcr::pll_ctrl::PLL_BYPASS_QUAL;
}
std::uint32_t pll_cfg_of(std::uint32_t feedback) {
  constexpr std::uint32_t res_shift = 4, cp_shift = 8;
  for (const LoopFilter& row : loop_filters) {
    if (feedback > row.to) continue;
    return row.lock_count << slcr::pll_cfg::LOCK_CNT_shift | row.charge_pump << cp_shift |
           row.resistor << res_shift;
  }
  return pll_cfg_of(largest_feedback);
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
