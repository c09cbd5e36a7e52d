#pragma once

#include <algorithm>
#include <cstdint>
#include <systemc>

#include <vp/clock_scheduler.h>
#include <vp/ip.h>

namespace kit {

/// A fresh SystemC context for one test case: derive the fixture from it, first.
class Simulation {
 public:
  Simulation() {
    vp::begin_fresh_context();
    sc_core::sc_report_handler::set_actions(sc_core::SC_ERROR, sc_core::SC_THROW);
  }
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;
};

/// The simulation time in picoseconds, for exact comparison: that of a clock scheduler that runs
/// ahead of SystemC's.
inline std::uint64_t now_ps() {
  std::uint64_t now = sc_core::sc_time_stamp().value();
  for (sc_core::sc_object* object : sc_core::sc_get_top_level_objects()) {
    if (const auto* scheduler = dynamic_cast<vp::ClockScheduler*>(object)) {
      now = std::max(now, scheduler->now_ps());
    }
  }
  return now;
}

}  // namespace kit
