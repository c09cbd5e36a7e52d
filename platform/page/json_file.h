#pragma once

#include <filesystem>
#include <string>

#include <report/result_json.h>

namespace platform::page {

/// The bytes of a file. Throws vp::InputError.
std::string read_file(const std::filesystem::path& path);

/// Its JSON. Throws vp::InputError if it is not whole.
report::Json parse_json(const std::string& text, const std::filesystem::path& path);

}  // namespace platform::page
