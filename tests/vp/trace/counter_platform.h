#pragma once

#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/probe.h>
#include <vp/signal.h>
#include <vp/trace.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "simulation.h"
#include "temporary_files.h"
#include "vcd_check.h"

/// Counts the edges of its clock, up to a limit; then it sleeps.
class Counter : public vp::Clocked {
 public:
  Counter(sc_core::sc_module_name name, vp::Clock& clock, unsigned limit)
      : Clocked(name, clock), limit_(limit) {}

  vp::Signal<std::uint8_t> count{"count", 4};
  vp::Signal<bool> odd{"odd"};

 private:
  enum class State : std::uint8_t { counting = 1, done = 2 };

  void edge() override {
    if (edges_ == limit_) {
      state_ = State::done;
      sleep();
      return;
    }
    ++edges_;
    squares_[edges_ % 2] = static_cast<std::uint16_t>(edges_ * edges_);
    half_ = edges_ / 2.0;
    count = static_cast<std::uint8_t>(edges_);
    odd = edges_ % 2 == 1;
  }

  unsigned limit_;
  unsigned edges_ = 0;
  State state_ = State::counting;
  std::uint16_t squares_[2] = {0, 0};
  double half_ = 0;
  vp::Probe<State> state_probe_{"state", state_, 2};
  vp::ProbeArray<std::uint16_t> squares_probe_{"square", squares_};
  vp::Probe<double> half_probe_{"half", half_};
};

/// Two counters, on 100 MHz and 40 MHz, and a tracer.
class Platform : public sc_core::sc_module {
 public:
  explicit Platform(const vp::TraceOptions& options, unsigned limit = 1000,
                    sc_core::sc_module_name name = "top")
      : sc_module(name),
        fast("fast", fast_clock, limit),
        slow("slow", slow_clock, limit),
        tracer("tracer", scheduler, options) {}

  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock fast_clock{"fast_clock", scheduler, 100'000'000};
  vp::Clock slow_clock{"slow_clock", scheduler, 40'000'000};
  Counter fast;
  Counter slow;
  vp::Tracer tracer;
};

/// Runs the platform until `until_ps` and gives the text of its VCD.
struct TraceFixture : kit::Simulation {
  TraceFixture() { options.file = folder / "out.vcd"; }

  std::string run(std::uint64_t until_ps, unsigned limit = 1000,
                  const std::function<void(Platform&)>& middle = {}) {
    Platform platform(options, limit);
    if (middle) {
      sc_core::sc_start(vp::from_ps(until_ps / 2));
      middle(platform);
      sc_core::sc_start(vp::from_ps(until_ps - until_ps / 2));
    } else {
      sc_core::sc_start(vp::from_ps(until_ps));
    }
    platform.tracer.close();
    return text();
  }
  std::string text() const { return VcdCheck::text_of(options.file.string()); }

  kit::TemporaryFolder folder;
  vp::TraceOptions options;
};
