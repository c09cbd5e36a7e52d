#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace platform::cli {

/// The whole program but main(): parses `arguments` (without the program's name), runs the command,
/// writes what the user reads to `out` and one line on what went wrong to `err`. Returns the exit
/// code.
int run_program(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace platform::cli
