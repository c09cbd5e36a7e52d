#pragma once

#include <array>
#include <cstdint>

#include <apps/common/search.h>
#include <drivers/gic.h>
#include <drivers/timers.h>
#include <hal/hal.h>
#include <marker/blob_grouping.h>
#include <marker/fast.h>
#include <marker/result.h>
#include <marker/threshold.h>

/// X(name, unit, default, minimum, maximum, documentation). The order is that of
/// hal_program.options. What the hybrid system has, too, is called the same there.
#define PS_ONLY_OPTIONS(X)                                                                     \
  SEARCH_OPTIONS(X)                                                                            \
  X(pixel_clock, "MHz", 50, 0.1, 1000,                                                         \
    "the camera's pixel clock: an image takes one clock a pixel into memory (thesis 5.4)")     \
  X(cpu_clock, "MHz", 666.666687, 1, 10000,                                                    \
    "the CPU's clock; the global timer counts every other cycle (the platform tells its own)") \
  X(corner_threshold, "", 30, 0, 255,                                                          \
    "grey levels by which the circle must be brighter than a corner (decision, as in the PL)") \
  X(label_count, "", 128, 4, 1024,                                                             \
    "labels of the blob grouping, the background's included (decision, as in the PL)")         \
  X(minimum_side, "px", 24, 1, 1023,                                                           \
    "smallest Ex - Sx and Ey - Sy of a blob that is reported (thesis 4.3.6.4)")

namespace ps_only {

/// The options as values in the units above.
struct Options : apps::SearchOptions {
  double pixel_clock;
  double cpu_clock;
  std::uint32_t corner_threshold;
  std::uint32_t label_count;
  std::uint32_t minimum_side;
};

/// For hal_program.options.
extern const hal_option_info option_table[];
extern const std::uint32_t option_count;

/// What the run asks for.
Options read_options();

}  // namespace ps_only
namespace ps_only {

/// The thesis' baseline (5.4): the same marker detection with nothing in the PL. All stages run one
/// after the other on the PS.
class Application {
 public:
  /// Works on all frames of the run. 0: every frame went well; 1: some did not, the console says
  /// which and why.
  int run();

 private:
  void initialise();
  void process(const hal_frame& frame);
  void capture(const hal_frame& frame);
  void find_features(const hal_frame& frame);
  void find_marker(const hal_frame& frame);
  static void on_alarm(void* self);

  drivers::Gic gic_;
  drivers::GlobalTimer timer_;
  volatile bool alarm_;
  Options options_;
  marker::CornerDetector corners_;
  marker::AdaptiveThreshold threshold_;
  marker::BlobGrouping blobs_;
  std::array<std::uint32_t,
             marker::max_image_width * marker::max_image_height / marker::pixels_per_word>
      binary_;
  marker::FrameResult result_;
};

}  // namespace ps_only
