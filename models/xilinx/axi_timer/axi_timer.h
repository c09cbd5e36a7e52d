#pragma once

#include <axi_timer_registers.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/register_bank.h>
#include <vp/signal.h>

#include <array>
#include <cstdint>
#include <deque>
#include <systemc>

namespace xilinx {

/// Build options, as Vivado asks for them; the defaults of its parameters.
struct AxiTimerBuild {
  std::uint32_t count_width = 32;  ///< 8, 16, 32
  bool one_timer_only = false;
};

/// AXI timer v2.0 (PG079). No process counts: value and events are computed from the cycles.
///
/// As measured on the vendor's RTL, a reloading timer has a period of TLR + 2 clocks (down) or
/// 2³² − TLR + 1 (up), and a timer that does not reload holds one count past its end.
class AxiTimer : public vp::Clocked, public vp::Ip {
 public:
  AxiTimer(sc_core::sc_module_name name, vp::Clock& s_axi_aclk, const AxiTimerBuild& build = {});
  const char* kind() const override { return "xilinx::AxiTimer"; }

  vp::Parameter<std::uint32_t> count_width;
  vp::Parameter<bool> one_timer_only;

  vp::In<bool> s_axi_aresetn{"s_axi_aresetn"};  ///< may be left open
  vp::RegisterBank s_axi;

  vp::In<bool> capturetrig0{"capturetrig0"}, capturetrig1{"capturetrig1"};  ///< may be left open
  vp::Signal<bool> generateout0{"generateout0"},
      generateout1{"generateout1"};  ///< pulses of a clock
  vp::Signal<bool> pwm0{"pwm0"};
  vp::Signal<bool> interrupt{"interrupt"};  ///< level, active high

 private:
  struct Timer {
    vp::Register &tcsr, &tlr, &tcr;
    std::uint64_t base = 0;    ///< counter at origin
    std::uint64_t origin = 0;  ///< cycle
    bool running = false;
    bool held = false;  ///< past its end, without reload
  };
  /// Clocks from a load, by ARHT or ENT, to the event: the counter passes its end and one state.
  static constexpr std::uint64_t clocks_past_end = 2;
  /// From the write that sets ENT to the first count.
  static constexpr std::uint64_t clocks_to_start = 2;

  void edge() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void before_end_of_elaboration() override;
  void end_of_elaboration() override {}  // pins may be left open
  vp::IpEstimate own_estimate() const override;

  void wire(unsigned number);
  void control_written(unsigned number, std::uint32_t word);
  std::uint32_t mask() const;
  bool cascaded() const;
  bool modulates() const;
  std::uint64_t last_count(const Timer& timer) const;
  std::uint64_t load_value(unsigned number) const;
  std::uint64_t counts_left(const Timer& timer) const;
  std::uint64_t value(unsigned number) const;
  std::uint64_t event_cycle(unsigned number) const;
  void start(unsigned number);
  void stop(unsigned number);
  void expire(unsigned number);
  void capture(unsigned number);
  void update();

  std::deque<Timer> timers_;
  std::array<std::uint64_t, 2> pulse_end_{vp::Clock::never, vp::Clock::never};
};

}  // namespace xilinx
