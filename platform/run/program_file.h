#pragma once

#include <string>

#include <zynq/design.h>

namespace platform {

/// The file of a PS program: `name` itself, or the installed program of that name. A word without
/// folder and extension names an installed program, unless a file is called so. Throws
/// vp::InputError if there is no program of that name.
std::string program_file(const std::string& name);

/// That of a program that comes with markervp or a design: `<name>.so` in `folder`, unless that is
/// empty, or installed. Throws vp::InputError if there is none.
std::string installed_program(const std::string& name, const std::string& folder = {});

/// That of the first program that belongs to the design.
std::string usual_program(const DesignInfo& design);

/// Whether program_file() takes the name for a file.
bool is_own_program(const std::string& name);

}  // namespace platform
