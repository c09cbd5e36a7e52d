#pragma once

#include <vp/register_bank.h>
#include <cstdint>
#include <systemc>

namespace vp {
class Clock;
class ClockScheduler;
}  // namespace vp

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

namespace ps {

/// One clock to the PL, FCLK_CLKn: two dividers behind a PLL, and the throttle that gives a number
/// of clocks and then stops.
///
/// A clock that nothing changed runs with the frequency it started with, even if the dividers give
/// it only nearly.
class Fclk : public sc_core::sc_module {
 public:
  /// `offset` of FPGAn_CLK_CTRL in the bank.
  Fclk(sc_core::sc_module_name name, vp::RegisterBank& bank, std::uint32_t offset);
  const char* kind() const override { return "ps::Fclk"; }

  /// The clock of the simulation that follows. May stay away: the registers work alone.
  void drive(vp::Clock& clock, double source_hz);
  /// The simulation has this clock.
  bool driven() const { return clock_ != nullptr; }
  /// Software wrote FPGAn_CLK_CTRL.
  void divide(double source_hz);
  /// A PLL may have changed. 0: stopped.
  void follow(double source_hz);
  /// Value of SRCSEL.
  std::uint32_t source() const;
  /// What the dividers give.
  std::uint64_t programmed_hz(double source_hz) const;

  /// Software wrote FPGAn_THR_CTRL or FPGAn_THR_CNT.
  void throttle_written();

 private:
  bool throttled() const;
  std::uint32_t status() const;
  void start_pulses();
  void end_of_pulses();
  void apply();

  vp::Register& clk_ctrl_;
  vp::Register& thr_ctrl_;
  vp::Register& thr_cnt_;
  vp::Clock* clock_ = nullptr;
  double source_hz_ = 0.0;
  std::uint64_t hertz_ = 0;  ///< when not throttled
  bool started_ = false;     ///< CPU_START as it was
  bool throttled_ = false;   ///< the count as it was: not 0
  bool pulsing_ = false;
  std::uint64_t first_cycle_ = 0;  ///< cycles before the throttle or the pulses began
  sc_core::sc_event last_pulse_;
};

}  // namespace ps
