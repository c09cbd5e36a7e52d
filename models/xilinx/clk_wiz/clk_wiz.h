#pragma once

#include <clk_wiz_registers.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/register_bank.h>
#include <vp/signal.h>
#include <xilinx/fabric_clock/clock_settings.h>

#include <cstdint>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

namespace xilinx {

/// Build options; the defaults of its parameters. Factors in thousandths: 9.125 is 9125.
struct ClkWizBuild {
  std::uint32_t divclk = 1;                      ///< 1 to 106
  std::uint32_t multiply = 10'000;               ///< 2 to 64
  std::vector<std::uint32_t> divide = {10'000};  ///< of each output, 1 to 128; seven at most
  bool pll = false;                              ///< PLLE2 instead of MMCME2
  unsigned grade = 1;                            ///< the speed grade, 1 to 3
};

/// Clocking wizard v6.0 (PG065) with registers: an MMCM with up to seven outputs. Software changes
/// its factors; the outputs stop until it has locked again. Phases and duty cycles are stored only.
class ClkWiz : public vp::Clocked, public vp::Ip, private vp::ClockListener {
 public:
  /// `clk_in1` is its input; `s_axi_aclk` the clock of its registers, null: the same one. Throws
  /// vp::InputError for factors that put the VCO outside its limits, or too many outputs.
  ClkWiz(sc_core::sc_module_name name, vp::Clock& clk_in1, const ClkWizBuild& build = {},
         vp::Clock* s_axi_aclk = nullptr);
  const char* kind() const override { return "xilinx::ClkWiz"; }

  vp::Parameter<std::uint32_t> lock_us;

  vp::RegisterBank s_axi_lite;
  vp::Signal<bool> locked{"locked", 1, true};

  /// Output `number`, from 0; std::out_of_range beyond those that are built.
  vp::Clock& clk_out(unsigned number) { return *outputs_.at(number); }

 private:
  void edge() override;
  vp::IpEstimate own_estimate() const override;
  void before_change(vp::Clock&) override {}
  void after_change(vp::Clock&) override;
  double vco_hz() const;
  bool is_legal() const;
  std::string legal_range() const;
  std::uint64_t output_hz(unsigned number) const;
  void show(const ClkWizBuild& build);
  void load();
  void drive();

  vp::Clock& clk_in1_;
  const ManagerLimits limits_;
  std::vector<std::unique_ptr<vp::Clock>> outputs_;
  ClkWizBuild build_;
  std::uint64_t locked_at_ = vp::Clock::never;
};

}  // namespace xilinx
