#pragma once

#include <systemc>

namespace kit {

/// A fresh SystemC context for one test case: derive the fixture from it, first.
class Simulation {
 public:
  Simulation() : context_(new sc_core::sc_simcontext) {
    sc_core::sc_curr_simcontext = sc_core::sc_default_global_context = context_;
    sc_core::sc_report_handler::set_actions(sc_core::SC_ERROR, sc_core::SC_THROW);
  }
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

 private:
  sc_core::sc_simcontext* context_;  // lives on: SystemC 2.3.4 cannot destroy a context safely
};

/// A simulation time in picoseconds, for exact comparison.
inline std::uint64_t now_ps() { return sc_core::sc_time_stamp().value(); }

}  // namespace kit
