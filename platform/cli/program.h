#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include <cli/simulation.h>
#include <host/ending.h>

namespace platform::cli {

/// Exit codes of the program (README).
enum ExitCode {
  done = 0,
  run_failed = 1,  ///< the program said so, or a required marker was not found
  wrong_input = 2,
  protocol_broken = 3,
  points_failed = 4,  ///< some points of a sweep did not run
  interrupted = host::interrupted_code,
};

/// What `work` returns, or the code of the error that it throws, after one line about it on `err`.
int exit_code_of(const std::function<int()>& work, std::ostream& err);

/// The whole program but main(): parses `arguments` (without the program's name), runs the command,
/// writes what the user reads to `out` and one line on what went wrong to `err`. Returns the exit
/// code.
int run_program(const std::vector<std::string>& arguments, const SimulationFactory& make_simulation,
                std::ostream& out, std::ostream& err);

}  // namespace platform::cli
