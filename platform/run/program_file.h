#pragma once

#include <string>

#include <zynq/design.h>

namespace platform {

/// The file of a PS program: `name` itself, or the installed program of that name. A word without
/// folder and extension names an installed program, unless a file is called so. Throws
/// vp::InputError if there is no program of that name.
std::string program_file(const std::string& name);

/// That of the first program that belongs to the design: `<name>.so` in the folder of a design from
/// outside, or installed. Throws vp::InputError if there is none.
std::string usual_program(const DesignInfo& design);

/// Whether program_file() takes the name for a file.
bool is_own_program(const std::string& name);

}  // namespace platform
