#pragma once

#include <string>
#include <string_view>

namespace platform::sweep {

/// SHA-256 of the bytes, 64 hexadecimal digits.
std::string content_hash(std::string_view bytes);

/// The same of a file's content. Throws vp::InputError if it cannot be read.
std::string file_hash(const std::string& path);

/// Digits of a hash that name a point: 128 bits.
inline constexpr std::size_t key_digits = 32;

}  // namespace platform::sweep
