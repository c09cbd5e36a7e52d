#pragma once

#include <set>
#include <string>

/// Primitives of the chip (UG953) in RTL.
namespace platform::handoff {

/// The text without comments and without the lines under `ifdef, which the compiler decides on.
std::string unconditional(const std::string& text, bool vhdl);

/// Those that a source instantiates, each once.
std::set<std::string> primitives_in(const std::string& source, bool vhdl);

/// Whether the build has a model of one: a file of models/xilinx/cells, in VHDL an entity of
/// cmake/MarkervpUnisim.cmake.
bool has_model(const std::string& primitive, bool vhdl);

}  // namespace platform::handoff
