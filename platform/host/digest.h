#pragma once

#include <string>
#include <string_view>

namespace platform::host {

/// SHA-256 of the bytes, 64 hexadecimal digits.
std::string content_hash(std::string_view bytes);

/// The same of a file's content. Throws vp::InputError if it cannot be read.
std::string file_hash(const std::string& path);

}  // namespace platform::host
