#pragma once

#include <filesystem>

namespace appendix_c {

void trace_non_maximum_suppression(const std::filesystem::path& file);

}  // namespace appendix_c
