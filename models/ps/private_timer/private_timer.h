#pragma once

#include <ps/private_timer/down_counter.h>
#include <vp/clock.h>
#include <vp/register_bank.h>
#include <vp/signal.h>
#include <cstdint>
#include <systemc>

namespace ps {

/// Private timer and watchdog of a Cortex-A9. No process counts.
///
/// A watchdog that expires resets the CPU on the chip. Here it is warned of, `watchdog_reset` rises
/// until software clears WDT_RESET_STATUS, and the program goes on.
class PrivateTimer : public vp::Clocked {
 public:
  /// `cpu_clock`: a count is two of its cycles.
  PrivateTimer(sc_core::sc_module_name name, vp::Clock& cpu_clock);
  const char* kind() const override { return "ps::PrivateTimer"; }

  vp::RegisterBank registers;  ///< at 0xF8F0_0600

  vp::Signal<bool> irq{"irq"};                        ///< interrupt 29, active high
  vp::Signal<bool> watchdog_irq{"watchdog_irq"};      ///< interrupt 30, active high
  vp::Signal<bool> watchdog_reset{"watchdog_reset"};  ///< the watchdog expired

 private:
  void edge() override;

  void wire(DownCounter& counter);
  void watchdog_counter_written(std::uint32_t word);
  void watchdog_control_written();
  void disable_written(std::uint32_t word);
  void update();

  DownCounter timer_;
  DownCounter watchdog_;
  vp::Register& status_;
  vp::Register& watchdog_status_;
  vp::Register& reset_status_;
  bool watchdog_mode_ = false;
  std::uint32_t last_disable_key_ = 0;
};

}  // namespace ps
