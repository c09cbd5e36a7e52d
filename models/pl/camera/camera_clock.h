#pragma once

#include <cstdint>
#include <optional>
#include <systemc>

#include <vp/clock.h>
#include <vp/parameter.h>

namespace pl {

/// The clock that pixels come with: the sensor's own, at a clock-capable pin, or one that the chip
/// gives the sensor.
class CameraClock : public sc_core::sc_module {
 public:
  /// `otherwise`: the chip's.
  CameraClock(sc_core::sc_module_name name, vp::Clock& otherwise)
      : sc_module(name), otherwise_(otherwise) {
    if (frequency != 0) own_.emplace("clk", otherwise.scheduler(), frequency);
  }

  vp::Parameter<std::uint64_t> frequency{"frequency",
                                         0,
                                         vp::Unit::frequency,
                                         {0, 1'000'000'000},
                                         vp::Source::decision,
                                         "pixel clock of the sensor's own, which all that takes "
                                         "pixels has, too; 0: it is the clock of "
                                         "the buses"};

  bool own() const { return own_.has_value(); }
  vp::Clock& clk() { return own_ ? *own_ : otherwise_; }

 private:
  vp::Clock& otherwise_;
  std::optional<vp::Clock> own_;
};

}  // namespace pl
