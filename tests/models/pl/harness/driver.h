#pragma once

#include <vp/clock_scheduler.h>

#include <cstdint>
#include <systemc>
#include <vector>

#include "word_monitor.h"

namespace harness {

/// What a PS would do, without bus and software: drives the control packet, and acknowledges each
/// feature word.
class Driver : public sc_core::sc_module {
 public:
  Driver(sc_core::sc_module_name name, vp::ClockScheduler& scheduler, WordMonitor& monitor,
         const vp::Signal<std::uint32_t>& feature);

  vp::Signal<std::uint32_t> gpio_io_o{"gpio_io_o"};
  vp::Signal<bool> peripheral_reset{"peripheral_reset"};

  /// The control packet, from now on; the two ready bits are kept.
  void control(std::uint32_t bits);
  std::uint32_t control() const { return bits_; }
  void toggle_ready();
  void system_reset(bool active);
  /// Pulses rst, raises ena for a while, and lets run() acknowledge words until the end word.
  void start_frame();

  std::vector<std::uint32_t> features;  ///< words read since start_frame(), the end word last
  std::uint64_t acknowledge_after_ps = 200'000;
  std::uint64_t hold_ps = 200'000;  ///< how long rst, the pause after it and ena last

 private:
  SC_HAS_PROCESS(Driver);
  void run();
  void receive();

  vp::ClockScheduler& scheduler_;
  WordMonitor& monitor_;
  const vp::Signal<std::uint32_t>& feature_;
  sc_core::sc_event start_;
  bool requested_ = false;
  std::uint32_t bits_ = 0, ready_ = 0;
};

}  // namespace harness
