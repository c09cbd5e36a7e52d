#pragma once

#include <apps/common/search_options.h>
#include <hal/hal.h>
#include <marker/result.h>

#include <cstdint>

namespace apps {

/// Prepares `result` for the frame: empty, with its number and size.
void begin(const hal_frame& frame, marker::FrameResult& result);

/// From the features in `result` to the marker and its pose: evaluation, identification in the
/// binary image and POSIT, with their times by the global timer. `start`: when the stage before
/// ended.
void find_marker(const hal_frame& frame, const marker::BinaryImage& image,
                 const SearchOptions& options, std::uint64_t start, marker::FrameResult& result);

}  // namespace apps
