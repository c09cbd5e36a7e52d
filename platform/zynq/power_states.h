#pragma once

#include <cstdint>

#include <vp/clock.h>
#include <vp/piecewise.h>
#include <vp/signal.h>
#include <zynq/zynq.h>

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

  explicit PowerStates(Zynq& zynq);
  ~PowerStates() override;
  PowerStates(const PowerStates&) = delete;
  PowerStates& operator=(const PowerStates&) = delete;

  vp::PiecewiseConstant always{1};
  vp::PiecewiseConstant cpu_hz;
  vp::PiecewiseConstant cpu_awake_hz;     ///< 0 while core 0 waits for an interrupt
  vp::PiecewiseConstant system_hz;        ///< fclk_clk0
  vp::PiecewiseConstant system_frame_hz;  ///< 0 while no frame is played
  vp::PiecewiseConstant pixel_hz;         ///< fclk_clk1
  vp::PiecewiseConstant pixel_frame_hz;

  bool awake() const { return !zynq_.ps.cpu.asleep; }
  bool frame_runs() const { return zynq_.pl.sensor_input.frame_ena; }
  /// The highest frequency that one of these clocks had.
  std::uint64_t fastest_hz(const vp::Clock& clock) const;
  /// At most one.
  void set_observer(Observer* observer) { observer_ = observer; }

  /// Times after `from_ps`, before `to_ps`, at which something changed; in order.
  std::vector<std::uint64_t> changes(std::uint64_t from_ps, std::uint64_t to_ps) const;
  void forget_before(std::uint64_t ps);

 private:
  void before_change(vp::Clock&) override {}
  void after_change(vp::Clock&) override { update(); }
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void update();

  Zynq& zynq_;
  Observer* observer_ = nullptr;
  std::uint64_t fastest_system_hz_;
  std::uint64_t fastest_pixel_hz_;
};

}  // namespace platform
