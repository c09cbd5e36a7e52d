#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <systemc>
#include <vector>

#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/signal.h>
#include <xilinx/fabric_clock/clock_settings.h>

namespace xilinx {

/// Build options of a clock manager of the fabric, as the Clocking Wizard writes them (PG065).
struct FabricClockBuild {
  bool pll = false;                   ///< PLLE2 instead of MMCME2
  std::string input_divider = "1";    ///< DIVCLK_DIVIDE
  std::string multiplier = "10.000";  ///< CLKFBOUT_MULT_F
  /// Names and dividers of the outputs that are used; that of the first in steps of 1/8.
  std::vector<std::pair<std::string, std::string>> outputs = {{"clk_out1", "10.000"}};
};

/// An MMCM or PLL of the fabric (UG472): clocks made from another one by a multiplier and dividers,
/// exactly. They follow their input. It is locked from time 0: the chip was configured then.
///
/// Rules: the oscillator runs within the limits of the speed grade (DS187), the phase detector at
/// 10 MHz at least. Throws vp::InputError with the setting that breaks one.
class FabricClock : public sc_core::sc_module, public vp::Ip, private vp::ClockListener {
 public:
  /// `grade`: the speed grade, 1 to 3.
  FabricClock(sc_core::sc_module_name name, vp::Clock& clk_in1, unsigned grade,
              const FabricClockBuild& build);
  const char* kind() const override { return "xilinx::FabricClock"; }

  vp::Parameter<std::string> divclk_divide;
  vp::Parameter<std::string> clkfbout_mult;

  /// The clock at an output; null if it has none of that name.
  vp::Clock* output(const std::string& name);
  /// Frequency of the oscillator now, Hz.
  double vco_hz() const;
  vp::Signal<bool> locked{"locked", 1, true};

 private:
  /// An output: the module that gives its clock a name.
  struct Output : sc_core::sc_module {
    Output(sc_core::sc_module_name name, vp::ClockScheduler& scheduler, const std::string& usual,
           bool fractional);
    const char* kind() const override { return "xilinx::FabricClockOutput"; }

    vp::Parameter<std::string> divide;
    std::uint64_t divider;  ///< in eighths
    vp::Clock clk;
  };

  vp::IpEstimate own_estimate() const override;
  void before_change(vp::Clock&) override {}
  void after_change(vp::Clock&) override { follow(); }
  void follow();
  void check_oscillator(unsigned grade, bool pll) const;

  vp::Clock& input_;
  std::uint64_t input_eighths_, multiplier_eighths_;
  std::deque<Output> outputs_;
};

}  // namespace xilinx
