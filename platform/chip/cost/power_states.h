#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include <chip/system/zynq.h>
#include <vp/clock.h>
#include <vp/power_meter.h>
#include <vp/signal.h>

namespace platform {

/// The states on which power depends, with their history: frequencies of the clocks, whether the
/// processor is awake, and whether the PL plays a frame. All of them are the same at every
/// fidelity.
class PowerStates : private vp::ClockListener, private vp::SignalListener {
 public:
  /// Told after each change.
  class Observer {
   public:
    virtual ~Observer() = default;
    virtual void states_changed(std::uint64_t ps) = 0;
  };
  /// A clock of the PL.
  struct PlClock {
    const vp::Clock* clock;
    vp::PiecewiseConstant hz;
    vp::PiecewiseConstant frame_hz;  ///< 0 while no frame is played
    std::uint64_t fastest_hz;        ///< that it had
    bool external = false;           ///< comes in at a pin, for the design
  };

  explicit PowerStates(Zynq& zynq);
  ~PowerStates() override;
  PowerStates(const PowerStates&) = delete;
  PowerStates& operator=(const PowerStates&) = delete;

  vp::PiecewiseConstant always{1};
  vp::PiecewiseConstant cpu_hz;
  vp::PiecewiseConstant cpu_awake_hz;  ///< times the number of cores that are awake

  /// The highest frequency that the clock of the cores, or one of the PL, had.
  std::uint64_t fastest_hz(const vp::Clock& clock) const;
  /// Throws std::logic_error for one that neither the PS makes nor the design has.
  const PlClock& pl_clock(const vp::Clock& clock) const;
  bool is_external(const vp::Clock& clock) const { return pl_clock(clock).external; }
  const std::deque<PlClock>& pl_clocks() const { return pl_clocks_; }
  /// Of the processor, those that do not wait for an interrupt or an event.
  unsigned awake_cores() const;
  bool frame_runs() const { return !busy_ || *busy_; }
  /// At most one.
  void set_observer(Observer* observer) { observer_ = observer; }

  /// Times after `from_ps`, before `to_ps`, at which something changed; in order.
  std::vector<std::uint64_t> changes(std::uint64_t from_ps, std::uint64_t to_ps);
  void forget_before(std::uint64_t ps);

 private:
  void before_change(vp::Clock&) override {}
  void after_change(vp::Clock&) override { update(); }
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void update();
  void add_pl_clock(const vp::Clock& clock, bool external);
  bool knows(const vp::Clock& clock) const;
  template <class Visit>
  void for_each_history(Visit visit);

  Zynq& zynq_;
  vp::Signal<bool>* busy_;  ///< null: the logic always works
  std::uint64_t fastest_cpu_hz_;
  std::deque<PlClock> pl_clocks_;
  Observer* observer_ = nullptr;
};

}  // namespace platform
