#include "driver.h"

#include <marker_logic.h>

namespace harness {

namespace control_packet = pl::control_packet;

Driver::Driver(sc_core::sc_module_name name, vp::ClockScheduler& scheduler, WordMonitor& monitor,
               const vp::Signal<std::uint32_t>& feature)
    : sc_module(name), scheduler_(scheduler), monitor_(monitor), feature_(feature) {
  SC_THREAD(run);
}

void Driver::control(std::uint32_t bits) {
  scheduler_.synchronise();
  bits_ = bits;
  gpio_io_o = bits | ready_ << control_packet::ready_shift;
}

void Driver::toggle_ready() {
  ready_ ^= 1;
  control(bits_);
}

void Driver::system_reset(bool active) {
  scheduler_.synchronise();
  peripheral_reset = active;
}

void Driver::start_frame() {
  requested_ = true;
  start_.notify(sc_core::SC_ZERO_TIME);
}

void Driver::run() {
  for (;;) {
    while (!requested_) wait(start_);
    requested_ = false;
    features.clear();
    control(control_packet::rst);
    wait(vp::from_ps(hold_ps));
    control(0);
    wait(vp::from_ps(hold_ps));
    monitor_.start();
    control(control_packet::ena);
    wait(vp::from_ps(hold_ps));
    control(0);
    receive();
    sc_core::sc_pause();
  }
}

void Driver::receive() {
  std::uint32_t last = 0;
  while (last != marker_logic::WordFormat::end_of_frame) {
    while (feature_.get() == last) wait(feature_.value_changed_event());
    last = feature_.get();
    features.push_back(last);
    wait(vp::from_ps(acknowledge_after_ps));
    toggle_ready();
  }
}

}  // namespace harness
