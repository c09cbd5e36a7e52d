#pragma once

#include <string>

/// What Yosys' primitives of the 7 series are, by name.
namespace platform::synthesis {

enum class Kind {
  lut,
  inverter,
  mux,
  carry,
  ff,
  latch,
  bram,
  lutram,
  shift,
  dsp,
  outside,
  unknown
};

/// `outside`: buffers of pins and clocks, and constants.
Kind kind_of(const std::string& type);

/// LUT that a distributed memory takes.
unsigned luts_of(const std::string& type);

/// Whether a cell of that kind is clocked through the port; of a latch, opened.
bool is_clock(Kind kind, const std::string& port);

bool starts_with(const std::string& text, const char* begin);

}  // namespace platform::synthesis
