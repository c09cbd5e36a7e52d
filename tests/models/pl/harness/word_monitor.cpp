#include "word_monitor.h"

namespace harness {

WordMonitor::WordMonitor(sc_core::sc_module_name name, vp::Clock& pixel_clk,
                         pl::FeatureExtraction& pl)
    : Clocked(name, pixel_clk) {
  corner_out_(pl.corner_detection.corner_out);
  corner_(pl.corner_detection.corner_data);
  blob_out_(pl.blob_detection.blob_out);
  start_(pl.blob_detection.blob_start);
  end_(pl.blob_detection.blob_end);
  thresh_out_(pl.global_threshold.thresh_out);
  thresh_(pl.global_threshold.thresh_data);
  wake_on(corner_out_);
  wake_on(blob_out_);
  wake_on(thresh_out_);
}

void WordMonitor::start() {
  words.clear();
  base_ = clock().cycle();
}

void WordMonitor::edge() {
  const std::uint64_t left = clock_number() - 1;
  if (corner_out_) words.push_back({'C', left, corner_, 0});
  if (blob_out_) words.push_back({'B', left, start_, end_});
  if (thresh_out_) words.push_back({'T', left, thresh_, 0});
  if (!corner_out_ && !blob_out_ && !thresh_out_) sleep();
}

}  // namespace harness
