#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <fpga/synthesis/netlist.h>

/// RTL through Yosys, and what came out of it as a file. Nothing of it is routed: counts are those
/// of Yosys, Fmax is a range (path_timing.h).
namespace platform::synthesis {

/// By name in capitals: of a module what Verilog calls its parameters.
using Parameters = std::map<std::string, std::int64_t>;

/// A module with its parameters. Those that are not named keep their default.
struct Design {
  std::string ip;  ///< in reports
  std::string top;
  std::vector<std::filesystem::path> sources;  ///< .v and .sv
  Parameters parameters;
  bool dsp = true;   ///< multiplications may become DSP48E1; else all of them are LUT
  bool own = false;  ///< comes with markervp
  std::vector<std::filesystem::path> includes = {};  ///< folders, besides those of the sources
  std::vector<std::string> defines = {};             ///< NAME or NAME=VALUE
};

struct Figures {
  std::string ip;
  Parameters parameters;
  std::map<std::string, std::string> sources;  ///< that it is made of: host::file_hash() by name
  Netlist netlist;
  /// Comes with markervp: the file leaves out what Fmax does not cover. Its crossings between
  /// clocks are built for that, and their tests say so.
  bool own = false;
};

/// What Yosys calls itself: "Yosys 0.23". Throws vp::InputError if it is not installed.
std::string yosys_version();

/// The IP of the pixel pipeline, each with the parameters for which figures are kept. `only` names
/// some of them; empty: all. Throws vp::InputError for one that there is not, or if no RTL is
/// installed.
std::vector<Design> own_designs(const std::vector<std::string>& only);

/// The .v and .sv files of a folder and of those below it. Throws vp::InputError if missing.
std::vector<std::filesystem::path> sources_in(const std::filesystem::path& folder);

/// Those of `sources` that `top` is made of: what declares it, and the modules, packages and
/// interfaces whose names stand in what is needed. So an IP's figures do not depend on sources that
/// it has nothing to do with: ties in Yosys' mapping fall by numbers that everything it reads
/// shares.
std::vector<std::filesystem::path> needed_by(const std::string& top,
                                             const std::vector<std::filesystem::path>& sources);

/// Flat, for the 7 series. Throws vp::InputError with file and line: what cannot be read or
/// synthesised, a combinational loop, no module or parameter of that name.
Figures synthesise(const Design& design, const PathTiming& timing);

/// The figures as a file of data: rtl/synthesis.json.
std::string to_json(const std::vector<Figures>& figures, const std::string& tool,
                    const PathTiming& timing);

}  // namespace platform::synthesis
