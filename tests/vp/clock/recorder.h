#pragma once

#include <cstdint>
#include <vector>

#include <vp/clock.h>
#include <vp/clock_scheduler.h>

/// Notes the times of its edges.
struct Recorder : vp::Clocked {
  Recorder(sc_core::sc_module_name name, vp::Clock& clock) : Clocked(name, clock) {}
  using Clocked::sleep;

  void edge() override {
    times.push_back(clock().scheduler().now_ps());
    cycles.push_back(clock().cycle());
    if (sleep_after != 0 && --sleep_after == 0) sleep();
  }

  std::vector<std::uint64_t> times;
  std::vector<std::uint64_t> cycles;
  unsigned sleep_after = 0;  ///< edges until it goes to sleep; 0: never
};

/// Copies its input to its output: a register.
struct Register : vp::Clocked {
  Register(sc_core::sc_module_name name, vp::Clock& clock) : Clocked(name, clock) {}

  void edge() override { q = d.read(); }

  vp::In<std::uint32_t> d{"d", this};
  vp::Signal<std::uint32_t> q{"q"};
};

/// Counts its edges on its output.
struct CountingModule : vp::Clocked {
  CountingModule(sc_core::sc_module_name name, vp::Clock& clock) : Clocked(name, clock) {}

  void edge() override { count = count + 1; }

  vp::Signal<std::uint32_t> count{"count"};
};

/// Runs everything up to and including the time `ps` (sc_start leaves out what happens at its very
/// end).
inline void run_to(std::uint64_t ps) {
  sc_core::sc_start(vp::from_ps(ps + 1) - sc_core::sc_time_stamp());
}
