#pragma once

#include <apps/ps_only/options.h>
#include <drivers/gic.h>
#include <drivers/global_timer.h>
#include <hal/hal.h>
#include <marker/blob_grouping.h>
#include <marker/fast.h>
#include <marker/result.h>
#include <marker/threshold.h>

#include <array>
#include <cstdint>

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
