#pragma once

#include <cstdint>

/// Arithmetic of the clock generators (UG585 chapter 25).
namespace ps::clock_tree {

/// `source_hz` behind two dividers, rounded to the nearest Hz. A divisor of 0 divides by 1.
std::uint64_t divided_hz(double source_hz, std::uint32_t divisor0, std::uint32_t divisor1 = 1);

// Fields of register values.
std::uint32_t pll_feedback(std::uint32_t pll_ctrl);
std::uint32_t pll_lock_cycles(std::uint32_t pll_cfg);
std::uint32_t source(std::uint32_t clk_ctrl);
std::uint32_t divisor0(std::uint32_t clk_ctrl);
std::uint32_t divisor1(std::uint32_t clk_ctrl);

/// Values of PLL_CTRL (running) and PLL_CFG for a feedback divider of 13 to 66 (UG585 table 25-6).
std::uint32_t pll_ctrl_of(std::uint32_t feedback);
std::uint32_t pll_cfg_of(std::uint32_t feedback);

/// Outputs of the three PLLs in Hz.
struct PllOutputs {
  double arm, ddr, io;
};

/// A clock to the PL as FPGAn_CLK_CTRL describes it.
struct Dividers {
  std::uint32_t source;  ///< a value of slcr::peripheral_source
  std::uint32_t divisor0, divisor1;
  std::uint64_t hertz;  ///< what they give

  std::uint32_t clk_ctrl() const;
};

/// The dividers that come nearest to `hertz`. Of equally near ones: IO before ARM before DDR PLL,
/// then the two divisors that are most alike, the larger first (as Vivado chooses them).
Dividers nearest_dividers(std::uint64_t hertz, const PllOutputs& plls);

/// The CPU divisor that comes nearest to `hertz`: 2 or 4 … 63 (1 and 3 are not allowed).
std::uint32_t nearest_cpu_divisor(std::uint64_t hertz, double source_hz);

}  // namespace ps::clock_tree
