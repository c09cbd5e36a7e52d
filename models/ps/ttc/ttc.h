#pragma once

#include <cstdint>
#include <deque>
#include <systemc>

#include <vp/clock.h>
#include <vp/register_bank.h>
#include <vp/signal.h>

namespace ps {

/// One of the three counters of a TTC. No process counts: value and events are computed from the
/// cycles of the clock.
class TtcCounter {
 public:
  /// `number`: 0 to 2. Its signals become members of the module under construction.
  TtcCounter(vp::RegisterBank& bank, unsigned number, const vp::Clock& clock);

  vp::Signal<bool> irq;   ///< active high
  vp::Signal<bool> wave;  ///< the waveform, to the EMIO

  /// Takes what happened up to now.
  void advance();
  /// The cycle of the next event that is to be seen at once; vp::Clock::never if none is.
  std::uint64_t next_event() const;
  void clk_ctrl_written();
  void cnt_ctrl_written();
  void status_read();
  void update_irq();
  std::uint32_t value() const;
  /// As after reset.
  void reset();

  vp::Register &clk_ctrl, &cnt_ctrl, &cnt_val, &interval, &match_1, &match_2, &match_3, &status,
      &enable;

 private:
  static constexpr std::uint64_t never = ~std::uint64_t{0};

  bool running() const;
  std::uint64_t cycles_per_count() const;
  std::uint32_t top() const;
  std::uint64_t counts_to(std::uint32_t target) const;
  std::uint32_t after(std::uint64_t counts) const;
  std::uint32_t events_within(std::uint64_t counts) const;
  void show_wave(std::uint64_t counts);

  const vp::Clock& clock_;
  std::uint32_t running_clk_ctrl_ = 0, running_cnt_ctrl_ = 0;  ///< in effect since origin_
  std::uint32_t base_ = 0;                                     ///< value at origin_
  std::uint64_t origin_ = 0;                                   ///< cycle
};

/// Triple timer counter on the CPU_1x clock. External clocks and event timers are not modelled.
class Ttc : public vp::Clocked {
 public:
  Ttc(sc_core::sc_module_name name, vp::Clock& cpu_1x_clk);
  const char* kind() const override { return "ps::Ttc"; }

  vp::RegisterBank registers;

  TtcCounter& counter(unsigned number) { return counters_.at(number); }

 private:
  void edge() override;
  void wire(TtcCounter& counter);
  void refuse_what_is_missing(const TtcCounter& counter);
  void update();

  std::deque<TtcCounter> counters_;
};

}  // namespace ps
