#pragma once

#include <cstdint>

namespace chip {

/// Messages of the HAL itself, straight to the console.
void print(const char* text);
void print_number(std::uint32_t value);
void print_hexadecimal(std::uint32_t value);  ///< 0x and 8 digits

/// Starts the console.
void initialise_console();

/// Waits until the console has sent everything.
void drain_console();

}  // namespace chip
