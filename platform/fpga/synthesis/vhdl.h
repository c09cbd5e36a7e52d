#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <fpga/synthesis/rtl_design.h>

/// VHDL, which GHDL makes Verilog of.
namespace platform::synthesis {

/// Of a name of a file: .vhd and .vhdl.
bool is_vhdl(const std::filesystem::path& source);

/// Whether the design's top is an entity of its VHDL. Throws vp::InputError if it is a module, too.
bool is_of_vhdl(const Design& design);

/// The design as one file of Verilog in `folder`, its generics set: by GHDL and
/// cmake/MarkervpVhdl.cmake, as markervp_add_rtl() does it. Throws vp::InputError with what GHDL
/// says, or if it or CMake is not installed.
Design verilog_of(const Design& design, const std::filesystem::path& folder);

}  // namespace platform::synthesis
