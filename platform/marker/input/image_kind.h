#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace platform::input {

/// What kind of image a whole TIFF or WebP file is, if it is one that is not read, and what to do:
/// samples that are no grey levels of 8 or 16 bits, several pictures in one file. Codecs refuse it
/// as damaged, or give the first picture alone. Empty for all others.
std::string unread_kind(const std::vector<std::uint8_t>& bytes);

}  // namespace platform::input
