#pragma once

#include <axi_gpio_registers.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/register_bank.h>
#include <vp/signal.h>
#include <cstdint>
#include <deque>
#include <string>
#include <systemc>

namespace xilinx {

/// Which way the pins of a GPIO channel go.
enum class GpioDirection { mixed, all_outputs, all_inputs };

/// Build options of one channel, as Vivado asks for them.
struct GpioChannelBuild {
  GpioDirection direction = GpioDirection::mixed;
  std::uint32_t width = 32;
  std::uint32_t dout_default = 0;
  std::uint32_t tri_default = 0xFFFFFFFF;
};

/// The pins of one channel, with the synchroniser of the inputs.
///
/// No process runs per clock: the synchroniser's output is computed from the last few changes of
/// the pins. All bits of a value are taken to pass it together (the hardware gives no such
/// guarantee: use a strobe).
class AxiGpioChannel {
 public:
  /// `prefix` is "gpio" or "gpio2"; parameters and pins become members of `owner`.
  AxiGpioChannel(const std::string& prefix, const GpioChannelBuild& build, vp::Clocked& owner);

  vp::Parameter<GpioDirection> direction;
  vp::Parameter<std::uint32_t> width;
  vp::Parameter<std::uint32_t> dout_default;
  vp::Parameter<std::uint32_t> tri_default;

  vp::In<std::uint32_t> io_i;      ///< pins; 0 if left open
  vp::Signal<std::uint32_t> io_o;  ///< the output register; 0 for a channel of inputs
  vp::Signal<std::uint32_t> io_t;  ///< 1: the pin is an input

  std::uint32_t mask() const { return width == 32 ? 0xFFFFFFFF : (1u << width) - 1; }

  /// Shows the registers at the pins.
  void drive(std::uint32_t data, std::uint32_t tri);

  /// The pins' level before the first edge.
  void start();
  /// The pins changed after edge `cycle`, as the input has it now. `track`: take_changes() is to
  /// tell of it.
  void record(std::uint64_t cycle, bool track);
  /// The pins behind `latency` flip-flops after edge `cycle`.
  std::uint32_t delayed(std::uint64_t cycle, std::uint64_t latency) const;
  /// The first edge after `cycle` on which delayed() may change; vp::Clock::never if the pins have
  /// not changed since.
  std::uint64_t next_delayed(std::uint64_t cycle, std::uint64_t latency) const;

  /// Edge on which the next change of the inputs is `latency` edges old; vp::Clock::never if none
  /// is under way.
  std::uint64_t next_change(std::uint64_t latency) const;
  /// Takes the changes that are `latency` edges old at `cycle`. True if an input bit changed.
  bool take_changes(std::uint64_t cycle, std::uint64_t latency);

 private:
  struct Sample {
    std::uint64_t cycle;
    std::uint32_t value;
  };
  /// Longest time for which delayed() looks back, in edges.
  static constexpr std::uint64_t memory = 16;

  std::deque<Sample> history_;  ///< oldest first, never empty once started
  std::deque<Sample> under_way_;
  std::uint32_t last_taken_ = 0;
};

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
