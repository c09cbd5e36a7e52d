#pragma once

#include <filesystem>

namespace appendix_c {

void trace_threshold_component(const std::filesystem::path& file);
void trace_contiguity(const std::filesystem::path& file);
void trace_direction(const std::filesystem::path& file);
void trace_strength(const std::filesystem::path& file);

}  // namespace appendix_c
