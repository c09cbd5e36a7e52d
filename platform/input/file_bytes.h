#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace platform::input {

/// Throws vp::InputError unless `path` is a regular file, or a link to one: a FIFO, a socket or a
/// device might be endless, and opening it might block or do something.
void require_regular_file(const std::string& path);

/// The whole file, or its first `limit` bytes. Throws vp::InputError if it is missing, no regular
/// file, unreadable or empty.
std::vector<std::uint8_t> read_bytes(const std::string& path, std::uintmax_t limit = UINTMAX_MAX);

}  // namespace platform::input
