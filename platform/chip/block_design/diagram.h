#pragma once

#include <string>

#include <chip/block_design/design_file.h>

namespace platform::block_design {

/// The design as a graph in the language of Graphviz: parts, buses and streams from left to right,
/// wires, clocks by colour, addresses.
std::string diagram(const DesignFile& design);

/// Writes it: a file .dot as it is, .svg and .png as Graphviz draws it. Throws vp::InputError for
/// another ending, or without Graphviz.
void write_diagram(const DesignFile& design, const std::string& file);

}  // namespace platform::block_design
