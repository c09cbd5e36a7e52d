#pragma once

#include <cstdint>

namespace drivers {

struct SlcrConfig {
  std::uint64_t ps_clk_millihertz = 33'333'333'333;  ///< the crystal (ZedBoard)
};

/// The clocks and resets that the PS gives to the PL, through the SLCR (UG585 chapter 25). Every
/// function unlocks the registers as long as it needs and leaves the lock as it was.
class Slcr {
 public:
  static constexpr unsigned pl_clock_count = 4;

  void initialise(const SlcrConfig& config);

  /// Gives FCLK_CLK`number` the frequency from the IO PLL that comes nearest to `hertz` and returns
  /// it. 0, and nothing changed, if there is no such clock or the IO PLL is off. The change is not
  /// free of glitches: hold the PL in reset around it.
  std::uint32_t set_pl_clock(unsigned number, std::uint32_t hertz) const;
  /// What the registers give FCLK_CLK`number`, Hz; 0 if its PLL is off, or no such clock.
  std::uint32_t pl_clock(unsigned number) const;
  /// What the registers give the processors (CPU_6x4x), Hz; 0 if its PLL is off.
  std::uint32_t cpu_clock() const;
  /// Stops FCLK_CLK`number`, or lets it run.
  void gate_pl_clock(unsigned number, bool stop) const;

  /// Pulls FCLK_RESET`number`_N low (true) or releases it.
  void reset_pl(unsigned number, bool reset) const;
  /// Level shifters between PS and PL on (true) or off. While they are off nothing in the PL
  /// answers.
  void enable_level_shifters(bool on) const;

  /// True if the PLLs of ARM, DDR and I/O have locked, or do within `polls` reads.
  bool wait_for_plls(unsigned polls) const;

 private:
  std::uint64_t pll_millihertz(std::uint32_t pll_ctrl) const;
  std::uint64_t source_millihertz(std::uint32_t clk_ctrl) const;

  std::uint64_t ps_clk_millihertz_;
};

}  // namespace drivers
