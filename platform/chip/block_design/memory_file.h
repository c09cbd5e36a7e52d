#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace platform::block_design {

/// The words of a file of memory contents (.coe, PG058): `memory_initialization_radix` 2, 10 or 16,
/// then `memory_initialization_vector`. Words have up to 64 bits. Throws vp::InputError with file
/// and line.
std::vector<std::uint64_t> read_memory_file(const std::string& text, const std::string& file);

/// A hexadecimal number without prefix, as Vivado writes values of memories; 0 if it is no number.
std::uint64_t hex_number(const std::string& text);

}  // namespace platform::block_design
