#pragma once

#include <board/hosts.h>
#include <board/xadc.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/register_bank.h>
#include <vp/signal.h>
#include <xadc_wiz_registers.h>

#include <cstdint>
#include <deque>
#include <map>
#include <systemc>

namespace xilinx {

/// Build options; the defaults of its parameters.
struct XadcWizBuild {
  std::uint32_t sequence_channels = 1;  ///< conversions in a sequence
  std::uint32_t adcclk_divisor = 4;     ///< clocks of the registers in one of ADCCLK
  /// What the converter's registers from 0x40 on hold after configuration (INIT_40 …, UG480).
  std::map<unsigned, std::uint16_t> initial = {};
};

/// XADC wizard v3.3 (PG091). The XADC converts all the time, 26 clocks of ADCCLK each; results are
/// those of the inputs at the moment they are read. Ends of conversion and of sequence are computed
/// when SR is read: they interrupt only while they are enabled.
class XadcWiz : public vp::Clocked, public vp::Ip, public board::AnalogueHost {
 public:
  XadcWiz(sc_core::sc_module_name name, vp::Clock& s_axi_aclk, const XadcWizBuild& build = {});
  const char* kind() const override { return "xilinx::XadcWiz"; }

  vp::Parameter<std::uint32_t> sequence_channels;
  vp::Parameter<std::uint32_t> adcclk_divisor;

  vp::In<bool> s_axi_aresetn{"s_axi_aresetn"};  ///< may be left open
  vp::RegisterBank s_axi_lite;
  vp::Signal<bool> ip2intc_irpt{"ip2intc_irpt"};  ///< level, active high
  /// The converter's alarms, bits as Xadc::alarms(); the wizard has a pin for each, and one for any
  /// of 0 to 6.
  std::deque<vp::Signal<bool>> alarm;
  vp::Signal<bool> alarm_out{"alarm_out"};

  board::Xadc converter;
  void set_input(unsigned channel, double value) override;

 private:
  void edge() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void before_end_of_elaboration() override;
  void end_of_elaboration() override {}  // the reset may be left open
  vp::IpEstimate own_estimate() const override;
  void wire();
  void reset();
  void reset_converter();
  void show_alarms();
  std::uint64_t conversion_clocks() const;
  std::uint32_t ends() const;
  void update();

  std::map<unsigned, std::uint16_t> initial_;
  vp::Register &gie_, &isr_, &ier_;
  std::uint64_t origin_ = 0;  ///< cycle from which conversions count
  std::uint64_t seen_ = 0;    ///< cycle of the last read of SR
};

}  // namespace xilinx
