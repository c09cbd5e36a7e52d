#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// RTL as it is given: a module, its parameters, and the sources in which it is.
namespace platform::synthesis {

/// By name in capitals: of a module what Verilog calls its parameters.
using Parameters = std::map<std::string, std::int64_t>;

/// A module with its parameters. Those that are not named keep their default.
struct Design {
  std::string ip;  ///< in reports
  std::string top;
  std::vector<std::filesystem::path> sources;  ///< .v, .sv, .vhd, .vhdl
  Parameters parameters;
  bool dsp = true;   ///< multiplications may become DSP48E1; else all of them are LUT
  bool own = false;  ///< comes with markervp
  std::vector<std::filesystem::path> includes = {};  ///< folders, besides those of the sources
  std::vector<std::string> defines = {};             ///< NAME or NAME=VALUE
  std::vector<std::string> ghdl_options = {};        ///< besides ours, for VHDL
};

/// The .v, .sv, .vhd and .vhdl files of a folder and of those below it. Throws vp::InputError if
/// missing.
std::vector<std::filesystem::path> sources_in(const std::filesystem::path& folder);

/// What a source declares: modules, packages and interfaces, of VHDL entities and packages, in
/// small letters.
std::vector<std::string> units_in(const std::filesystem::path& source);

/// Those of `sources` that `top` is made of: what declares it, and the units (units_in()) whose
/// names stand in what is needed. So an IP's figures do not depend on sources that
/// it has nothing to do with: ties in Yosys' mapping fall by numbers that everything it reads
/// shares.
std::vector<std::filesystem::path> needed_by(const std::string& top,
                                             const std::vector<std::filesystem::path>& sources);

/// Whether the design's top declares a parameter of that name, as its text has it.
bool has_parameter(const Design& design, const std::string& name);

/// The modules that a text declares, or what else `what` says: an alternative of words.
std::vector<std::string> declared_in(const std::string& text, const char* what = "module");

/// LABELS=64, as a user gives it; true is 1, false 0. Throws vp::InputError.
Parameters parse_parameters(const std::vector<std::string>& given);

/// " LABELS=64 WIDTH=32"
std::string parameters_text(const Parameters& parameters);

}  // namespace platform::synthesis
