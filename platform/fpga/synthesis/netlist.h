#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fpga/synthesis/clocks.h>
#include <fpga/synthesis/path_timing.h>

/// What Yosys makes of RTL for the 7 series: `synth_xilinx -flatten -abc9`, then `write_json`.
namespace platform::synthesis {

/// Primitives as Yosys counts them.
struct Cells {
  std::uint32_t lut = 0;  ///< without those that are memory
  /// Pairs of them that share inputs and have five at most together: they fit into one LUT6_2, as
  /// Vivado packs them and Yosys does not.
  std::uint32_t lut_pairs = 0;
  std::uint32_t lut_memory = 0;  ///< distributed memory and shift registers
  /// That nothing but let a signal through, to a carry chain: it has no other entrance. Yosys does
  /// not count them.
  std::uint32_t lut_through = 0;
  std::uint32_t ff = 0;  ///< and latches, which take the same place
  std::uint32_t carry4 = 0;
  std::uint32_t ramb18 = 0;
  std::uint32_t ramb36 = 0;
  std::uint32_t dsp = 0;
};

/// How fast a design may be clocked.
struct Fmax {
  FmaxRange mhz;
  std::string limited_by;  ///< what of the chip lowers the range; empty: only the longest path
};

struct Netlist {
  Cells cells;
  /// All that the top has, as it was built; those of more than 64 bits are left out.
  std::map<std::string, std::uint64_t> parameters;
  std::optional<Path> longest;  ///< none: there is no path from register to register
  ClockLimit limit;
  std::vector<std::string> not_covered;  ///< by Fmax, a phrase each
  /// Bits of the top's outputs, and those of them that never change: what drives them is left out.
  std::uint32_t output_bits = 0;
  std::uint32_t constant_bits = 0;

  /// That of the longest path, and no more than the limit; none without a path.
  std::optional<Fmax> fmax(const PathTiming& timing) const;
};

/// Reads the module `top`. Throws vp::InputError: no such file or module, a cell
/// whose delay is not known; LoopError.
Netlist read_netlist(const std::filesystem::path& file, const std::string& top,
                     const PathTiming& timing);

}  // namespace platform::synthesis
