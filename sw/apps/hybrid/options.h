#pragma once

#include <hal/hal.h>

#include <cstdint>

/// X(name, unit, default, minimum, maximum, documentation). The order is that of
/// hal_program.options.
#define HYBRID_OPTIONS(X)                                                                          \
  X(margin, "px", 4, 0, 64,                                                                        \
    "how far outside its bounding box a blob's corner may lie (thesis 3.5.1; 4 px is a decision)") \
  X(canonical_width, "px", 60, 18, 600,                                                            \
    "width of the rectified marker, rounded to a multiple of 6; 24 suffices (thesis 3.5.2)")       \
  X(marker_side, "m", 0.30, 0.001, 100, "side of the marker's black square (thesis chapter 5)")    \
  X(reprojection_stop, "px", 2, 0, 1000,                                                           \
    "POSIT stops when the mean reprojection error is below (thesis 4.5.6)")                        \
  X(iteration_limit, "", 100, 1, 100000,                                                           \
    "POSIT refines a solution at most so many times (thesis 4.5.6)")                               \
  X(upload, "", 1, 0, 1,                                                                           \
    "1: the image goes to the image store through DMA 0; 0: it is there already, as from a "       \
    "camera on the PL (decision)")                                                                 \
  X(timeout, "ms", 1000, 0.1, 1000000,                                                             \
    "longest time for an upload, and from ena to the end word (decision)")                         \
  X(binary_timeout, "ms", 10, 0.001, 1000000,                                                      \
    "longest wait for the binary image after the end word (decision)")

namespace hybrid {

/// The options as values in the units above.
struct Options {
  double margin;
  std::uint32_t canonical_width;
  double marker_side;
  double reprojection_stop;
  std::uint32_t iteration_limit;
  bool upload;
  double timeout;
  double binary_timeout;
};

/// For hal_program.options.
extern const hal_option_info option_table[];
extern const std::uint32_t option_count;

/// What the run asks for.
Options read_options();

}  // namespace hybrid
