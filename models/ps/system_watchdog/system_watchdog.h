#pragma once

#include <cstdint>
#include <systemc>

#include <vp/clock.h>
#include <vp/register_bank.h>
#include <vp/signal.h>

namespace ps {

/// System watchdog on the CPU_1x clock. No process counts.
///
/// On the chip one that expires with RSTEN resets the system. Here it causes a warning and the
/// program continues.
class SystemWatchdog : public vp::Clocked {
 public:
  SystemWatchdog(sc_core::sc_module_name name, vp::Clock& cpu_1x_clk);
  const char* kind() const override { return "ps::SystemWatchdog"; }

  vp::RegisterBank registers;           ///< at 0xF800_5000
  vp::Signal<bool> irq{"irq"};          ///< interrupt 41: a pulse
  vp::Signal<bool> expired{"expired"};  ///< STATUS.WDZ

 private:
  void edge() override;
  void mode_written(std::uint32_t word);
  void control_written(std::uint32_t word);
  void restart();
  void expire();
  void plan();

  vp::Register& mode_;
  vp::Register& control_;
  vp::Register& status_;
  std::uint32_t accepted_mode_, accepted_control_;
  std::uint64_t zero_at_ = vp::Clock::never;  ///< cycle at which it expires
  std::uint64_t pulse_end_ = vp::Clock::never;
};

}  // namespace ps
