#pragma once

#include <cstdint>
#include <string>
#include <systemc>

#include <vp/clock.h>
#include <vp/parameter.h>

namespace platform {

/// A clock that the PS makes, with its frequency at the start.
class ClockSource : public sc_core::sc_module {
 public:
  ClockSource(sc_core::sc_module_name name, vp::ClockScheduler& scheduler, std::uint64_t default_hz,
              vp::Source source, const std::string& documentation)
      : sc_module(name),
        frequency("frequency", default_hz, vp::Unit::frequency, {1'000, 1'000'000'000'000}, source,
                  documentation),
        clk("clk", scheduler, frequency) {}

  vp::Parameter<std::uint64_t> frequency;
  vp::Clock clk;
};

}  // namespace platform
