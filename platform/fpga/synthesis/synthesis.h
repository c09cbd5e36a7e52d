#pragma once

#include <map>
#include <string>
#include <vector>

#include <fpga/synthesis/netlist.h>
#include <fpga/synthesis/rtl_design.h>

/// RTL through Yosys, and what came out of it as a file. Nothing of it is routed: counts are those
/// of Yosys, Fmax is a range (path_timing.h).
namespace platform::synthesis {

struct Figures {
  std::string ip;
  Parameters parameters;
  std::map<std::string, std::string> sources;  ///< that it is made of: host::file_hash() by name
  Netlist netlist;
  /// Comes with markervp: the file leaves out what Fmax does not cover. Its crossings between
  /// clocks are built for that, and their tests say so.
  bool own = false;
};

/// The IP of the pixel pipeline, each with the parameters for which figures are kept. `only` names
/// some of them; empty: all. Throws vp::InputError for one that there is not, or if no RTL is
/// installed.
std::vector<Design> own_designs(const std::vector<std::string>& only);

/// Flat, for the 7 series. Throws vp::InputError with file and line: what cannot be read or
/// synthesised, a combinational loop, no module or parameter of that name.
Figures synthesise(const Design& design, const PathTiming& timing);

/// The figures as a file of data: rtl/synthesis.json.
std::string to_json(const std::vector<Figures>& figures, const std::string& tool,
                    const PathTiming& timing);

}  // namespace platform::synthesis
