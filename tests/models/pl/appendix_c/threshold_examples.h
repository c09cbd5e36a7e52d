#pragma once

#include <filesystem>

namespace appendix_c {

void trace_pixel_threshold(const std::filesystem::path& file);
void trace_next_threshold(const std::filesystem::path& file);

}  // namespace appendix_c
