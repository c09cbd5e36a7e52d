#pragma once

#include <apps/hybrid/options.h>
#include <apps/hybrid/pl_link.h>
#include <hal/hal.h>
#include <marker/result.h>

#include <cstdint>

namespace hybrid {

/// The PS side of the thesis' marker detection system (figure 4.22).
class Application {
 public:
  /// Works on all frames of the run. 0: every frame went well; 1: some did not, the console says
  /// which and why.
  int run();

 private:
  bool initialise();
  void process(const hal_frame& frame);
  marker::Status receive(const hal_frame& frame);
  marker::Status admit(const hal_frame& frame);
  void reserve(std::uint32_t bytes);
  void find_marker(const hal_frame& frame);
  void report(marker::Status status) const;
  std::uint64_t counts(double milliseconds) const;

  PlLink link_;
  Options options_;
  hal_dma_buffer binary_;
  bool recovery_due_;
  marker::WordStore words_;
  marker::FrameResult result_;
};

}  // namespace hybrid
