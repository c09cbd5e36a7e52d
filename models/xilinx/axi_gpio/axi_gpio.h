#pragma once

#include <cstdint>
#include <systemc>

#include <axi_gpio_registers.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/register_bank.h>
#include <vp/signal.h>
#include <xilinx/axi_gpio/axi_gpio_channel.h>

namespace xilinx {

/// Build options of an AXI GPIO, as Vivado asks for them; the defaults of its parameters.
struct AxiGpioBuild {
  GpioChannelBuild gpio;
  bool is_dual = false;
  GpioChannelBuild gpio2;
  bool interrupt_present = false;
};

/// AXI GPIO v2.0 (PG144), register-accurate in every build.
///
/// A write reaches the pins at the time of the access: modules on the clock see it on the next
/// edge. A read sees the pins as they were `input_latency` clocks ago.
class AxiGpio : public vp::Clocked, public vp::Ip {
 public:
  AxiGpio(sc_core::sc_module_name name, vp::Clock& s_axi_aclk, const AxiGpioBuild& build = {});
  const char* kind() const override { return "xilinx::AxiGpio"; }

  vp::Parameter<bool> is_dual;
  vp::Parameter<bool> interrupt_present;
  vp::Parameter<std::uint32_t> input_latency;
  vp::Parameter<std::uint32_t> interrupt_latency;

  vp::In<bool> s_axi_aresetn{"s_axi_aresetn"};  ///< may be left open
  vp::RegisterBank s_axi;

  /// Pins gpio_io_i, gpio_io_o, gpio_io_t.
  AxiGpioChannel gpio;
  /// Pins gpio2_io_i, gpio2_io_o, gpio2_io_t. Single-channel build: no effect, 0.
  AxiGpioChannel gpio2;
  vp::Signal<bool> ip2intc_irpt{"ip2intc_irpt"};

  vp::Register& gpio_data;
  vp::Register& gpio_tri;
  vp::Register& gpio2_data;
  vp::Register& gpio2_tri;
  vp::Register& gier;
  vp::Register& ip_isr;
  vp::Register& ip_ier;

 private:
  void edge() override;
  vp::IpEstimate own_estimate() const override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void before_end_of_elaboration() override;
  void end_of_elaboration() override {}  // pins may be left open
  void start_of_simulation() override;

  void build_channel(AxiGpioChannel& channel, vp::Register& data, vp::Register& tri);
  void build_without_channel_2();
  void build_interrupt();
  std::uint32_t read_data(const AxiGpioChannel& channel, const vp::Register& data,
                          const vp::Register& tri) const;
  void reset();
  void update_interrupt();
  void plan_interrupt();
};

}  // namespace xilinx
