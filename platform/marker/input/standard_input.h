#pragma once

#include <string>

namespace platform::input {

/// The name of the standard input among inputs.
constexpr const char* standard_input_name = "-";

/// What comes through the standard input, as a file that this process keeps: an image, a video, or
/// images one behind the other. It is read once, on the first call. Throws vp::InputError if it is
/// a terminal, empty, stops sending without an end, or is larger than 4 GiB.
const std::string& standard_input_file();

}  // namespace platform::input
