#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <fpga/synthesis/path_timing.h>

/// What clocks the registers of a netlist, of which paths alone say nothing.
namespace platform::synthesis {

/// Above this the chip cannot clock something that the design uses, however short its paths are.
struct ClockLimit {
  double mhz = 0;
  std::string of;  ///< "clock buffer (BUFG)"
};

/// The least limit of the clock network and of the block RAM and multipliers of `module`, as Yosys
/// writes it.
ClockLimit clock_limit(const nlohmann::json& module, const PathTiming& timing);

/// What Fmax does not cover, a phrase each: clocks that registers or logic make, several clocks,
/// both edges of one, latches. Paths are judged as if all registers had one clock.
std::vector<std::string> clocks_not_covered(const nlohmann::json& module);

}  // namespace platform::synthesis
