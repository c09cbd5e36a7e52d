#pragma once

namespace chip {

inline constexpr int input_exit_code = 2;  ///< an option of the build does not fit the program
inline constexpr int fault_exit_code = 3;  ///< as on the virtual platform

/// The program is over: says so on the console, tells a debugger, and sleeps for good.
[[noreturn]] void end(int exit_code);

/// Checks the options given to the build against those of the program; ends it if one does not fit.
void check_options();

}  // namespace chip
