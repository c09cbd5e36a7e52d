#pragma once

#include <filesystem>

namespace appendix_c {

void trace_new_label(const std::filesystem::path& file);
void trace_existing_label(const std::filesystem::path& file);
void trace_bounding_box(const std::filesystem::path& file);
void trace_deactivated_label(const std::filesystem::path& file);
void trace_blob_filter(const std::filesystem::path& file);

}  // namespace appendix_c
