#pragma once

#include <vp/clock.h>
#include <vp/register_bank.h>
#include <vp/signal.h>
#include <cstdint>
#include <systemc>

namespace ps {

/// A counter of the Cortex-A9 that counts down to 0, raises an event there, and starts again or
/// stops. No process counts: it is computed from the cycles of the clock.
///
/// From `n` to 0 it takes n counts, and one more from 0 to the start value: a period is load + 1.
class DownCounter {
 public:
  struct Offsets {
    std::uint32_t load, counter, control;
  };

  DownCounter(vp::RegisterBank& bank, const Offsets& offsets, const vp::Clock& clock);

  vp::Register& load;
  vp::Register& counter;
  vp::Register& control;

  /// The counter now.
  std::uint32_t value() const;
  /// Software set the counter.
  void set(std::uint32_t value);
  /// Software wrote the control register.
  void control_written();
  /// Takes the event that is due; to be called on the cycle of next_event(). True if there was one.
  bool take_event();
  /// The cycle of the next event; vp::Clock::never if none comes.
  std::uint64_t next_event() const;

 private:
  bool running() const;
  std::uint64_t cycles_per_count() const;
  void rebase(std::uint32_t value);

  const vp::Clock& clock_;
  std::uint32_t running_control_ = 0;  ///< control as the counter runs with since origin_
  std::uint32_t base_ = 0;             ///< counter at origin_
  std::uint64_t origin_ = 0;           ///< cycle
  bool expired_ = true;                ///< stopped at 0, which has been reported
};

/// Private timer and watchdog of a Cortex-A9. No process counts.
///
/// On the chip, a watchdog that expires resets the CPU. Here it causes a warning, `watchdog_reset`
/// is high until software clears WDT_RESET_STATUS, and the program continues.
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
