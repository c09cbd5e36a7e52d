#pragma once

#include <algorithm>
#include <cstdint>
#include <systemc>
#include <vector>

#include <vp/clock_scheduler.h>

namespace kit {

/// A fresh SystemC context for one test case: derive the fixture from it, first.
class Simulation {
 public:
  Simulation() {
    // They live on: SystemC 2.3.4 cannot destroy a context safely. Kept, they are no leaks either.
    static auto& contexts = *new std::vector<sc_core::sc_simcontext*>;
    contexts.push_back(new sc_core::sc_simcontext);
    sc_core::sc_curr_simcontext = sc_core::sc_default_global_context = contexts.back();
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
