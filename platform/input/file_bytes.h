#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace platform::input {

/// The whole file, or its first `limit` bytes. Throws vp::InputError if it is missing, a folder,
/// unreadable or empty.
std::vector<std::uint8_t> read_bytes(const std::string& path, std::uintmax_t limit = UINTMAX_MAX);

}  // namespace platform::input
