#pragma once

#include <string>

/// What RTL has for simulators only, and Yosys 0.23 stumbles over.
namespace platform::synthesis {

/// The text, line by line the same, without what prints or checks: $display, $warning and their
/// like in procedures, and assertions; `++i` is `i++`. (In generate blocks Yosys knows $error
/// itself.) `ends` comes in the place of a call that ends a simulation, with the number of its
/// line: a $display that says so.
std::string without_simulation(const std::string& text, const std::string& ends);

}  // namespace platform::synthesis
