#pragma once

#include <cstdint>

#include <hal/hal.h>
#include <marker/result.h>

/// X(name, unit, default, minimum, maximum, documentation): the options that come first in the
/// table of every program that looks for markers.
#define SEARCH_OPTIONS(X)                                                                          \
  X(margin, "px", 4, 0, 64,                                                                        \
    "how far outside its bounding box a blob's corner may lie (thesis 3.5.1; 4 px is a decision)") \
  X(canonical_width, "px", 60, 18, 600,                                                            \
    "width of the rectified marker, rounded to a multiple of 6; 24 suffices (thesis 3.5.2)")       \
  X(marker_side, "m", 0.30, 0.001, 100, "side of the marker's black square (thesis chapter 5)")    \
  X(reprojection_stop, "px", 2, 0, 1000,                                                           \
    "POSIT stops when the mean reprojection error is below (thesis 4.5.6)")                        \
  X(iteration_limit, "", 100, 1, 100000,                                                           \
    "POSIT refines a solution at most so many times (thesis 4.5.6)")

namespace apps {

/// Their values in the units above.
struct SearchOptions {
  double margin;
  std::uint32_t canonical_width;
  double marker_side;
  double reprojection_stop;
  std::uint32_t iteration_limit;
};

/// What the run asks for.
SearchOptions read_search_options();

/// Prepares `result` for the frame: empty, with its number and size.
void begin(const hal_frame& frame, marker::FrameResult& result);

/// From the features in `result` to the marker and its pose: evaluation, identification in the
/// binary image and POSIT, with their times by the global timer. `start`: when the stage before
/// ended.
void find_marker(const hal_frame& frame, const marker::BinaryImage& image,
                 const SearchOptions& options, std::uint64_t start, marker::FrameResult& result);

}  // namespace apps
