#pragma once

#include <filesystem>
#include <string>

#include <report/result_json.h>

namespace platform::page {

/// The bytes of a file. Throws vp::InputError.
std::string read_file(const std::filesystem::path& path);

/// Its JSON. Throws vp::InputError if it is not whole.
report::Json parse_json(const std::string& text, const std::filesystem::path& path);

/// The JSON of a file with no more than the first `count` objects of its top-level list `list`, in
/// memory that does not grow with the others. Throws vp::InputError if it is not whole.
report::Json parse_first(const std::filesystem::path& path, const std::string& list,
                         std::size_t count);

}  // namespace platform::page
