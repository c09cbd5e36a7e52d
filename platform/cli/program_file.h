#pragma once

#include <optional>
#include <string>

namespace platform::cli {

/// The file of a PS program: `asked` itself, or the installed program of that name; none is the
/// thesis' hybrid system. A word without folder and extension names an installed program, unless a
/// file is called so. Throws vp::InputError if there is no program of that name.
std::string program_file(const std::optional<std::string>& asked);

/// Whether program_file() takes the name for a file.
bool is_own_program(const std::string& name);

}  // namespace platform::cli
