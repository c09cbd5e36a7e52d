#pragma once

#include <string>

#include <zynq/design.h>

namespace platform {

/// A design from outside: with a folder in its name, or the ending .so.
bool is_design_file(const std::string& name);

/// Where the programs of a design stand: the folder of its shared object; empty for one that is
/// built in.
std::string folder_of(const DesignInfo& design);

/// Loads it once; it stays loaded. Throws vp::InputError for a file that is no design, or one that
/// was built against another version.
const DesignInfo& load_design(const std::string& file);

}  // namespace platform
