#pragma once

#include <vp/clock.h>
#include <vp/parameter.h>
#include <vp/register_bank.h>
#include <vp/signal.h>
#include <cstdint>
#include <systemc>

namespace ps {

/// The global timer of the Cortex-A9 MPCore. No process counts: the counter is computed from the
/// CPU clock when it is read, and one alarm is set for the comparator's next match.
class GlobalTimer : public vp::Clocked {
 public:
  /// `cpu_clock`: one tick of the timer is two of its cycles.
  GlobalTimer(sc_core::sc_module_name name, vp::Clock& cpu_clock);
  const char* kind() const override { return "ps::GlobalTimer"; }

  vp::RegisterBank registers;  ///< at 0xF8F0_0200

  vp::Parameter<bool> enabled_by_boot;

  vp::Signal<bool> irq{"irq"};  ///< interrupt 27, active high

  /// The counter now.
  std::uint64_t counter() const;

 private:
  void edge() override;

  std::uint64_t cycles_per_count() const;
  void rebase(std::uint64_t counter);
  void write_counter(std::uint64_t mask, std::uint64_t value);
  void write_control(std::uint32_t word);
  void write_comparator(std::uint64_t mask, std::uint64_t value);
  void update();
  void plan_match();

  vp::Register& control_;
  vp::Register& status_;
  vp::Register& auto_increment_;
  std::uint32_t running_control_ =
      0;                    ///< CONTROL as the counter has run with since `origin_cycle_`
  std::uint64_t base_ = 0;  ///< counter at `origin_cycle_`
  std::uint64_t origin_cycle_ = 0;
  std::uint64_t comparator_ = 0;
  bool armed_ = false;  ///< the comparator has not matched since it was set or enabled
};

}  // namespace ps
