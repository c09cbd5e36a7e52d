#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace platform::input {

/// What kind of image a whole TIFF or WebP file is, if it is one that is not read, and what to do:
/// samples that are signed or have too many bits, several pictures in one file. Codecs refuse it
/// as damaged, or give the first picture alone. Empty for all others.
std::string unread_kind(const std::vector<std::uint8_t>& bytes);

/// True for a whole TIFF with floating-point samples.
bool is_floating_tiff(const std::vector<std::uint8_t>& bytes);

}  // namespace platform::input
