#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "frames.h"
#include "word.h"

namespace bench {

/// Feeds frames to a Verilated model of the feature extraction (top.sv) as fast as it takes them.
/// `Model` is what Verilator made of it.
class RtlPipelineBase {
 public:
  /// What left the detectors in the last frame, in the order of the clocks.
  const std::vector<harness::Word>& words() const { return words_; }

 protected:
  /// Pixel clocks from a feature word to its acknowledgement.
  static constexpr unsigned acknowledge_after = 10;
  static constexpr std::uint32_t end_of_frame = 0xFFFF'FFFF;

  std::vector<harness::Word> words_;
};

template <class Model>
class RtlPipeline : public RtlPipelineBase {
 public:
  RtlPipeline() {
    model_.por = model_.rst = 1;
    model_.ena = model_.wr_thresh = 0;
    model_.ready = 0;
    model_.tready = 1;
    for (int i = 0; i < 4; ++i) tick();
    model_.por = model_.rst = 0;
    tick();
  }
  ~RtlPipeline() { model_.final(); }
  RtlPipeline(const RtlPipeline&) = delete;
  RtlPipeline& operator=(const RtlPipeline&) = delete;

  /// Puts an image of 640x480 pixels into the BRAM.
  void load(const harness::Image& image) {
    std::copy(image.begin(), image.end(), &model_.rootp->top__DOT__s__DOT__bram[0]);
  }

  /// A whole frame, until its end word was seen and everything is at rest.
  void run_frame() {
    model_.rst = 1;
    for (int i = 0; i < 2; ++i) tick();
    model_.rst = 0;
    for (int i = 0; i < 2; ++i) tick();
    words_.clear();
    last_ = model_.feature;
    hold_ = 0;
    clock_ = 0;
    model_.ena = 1;
    tick();
    model_.ena = 0;
    for (int i = 0; i < 3; ++i) tick();
    while (model_.busy || model_.frame_ena || last_ != end_of_frame) tick();
  }

  /// The threshold that the next frame will use.
  int threshold() const { return model_.threshold; }

 private:
  /// One pixel clock, two system clocks.
  void tick() {
    half(1, 1);
    half(1, 0);
    half(0, 1);
    half(0, 0);
    ++clock_;
    collect();
    acknowledge();
  }

  void half(std::uint8_t pixel_clk, std::uint8_t system_clk) {
    model_.clk = pixel_clk;
    model_.clk100 = system_clk;
    model_.eval();
  }

  void collect() {
    if (model_.blob_out) words_.push_back({'B', clock_, model_.blob_start, model_.blob_end});
    if (model_.corner_out) words_.push_back({'C', clock_, model_.corner_data, 0});
    if (model_.thresh_out) words_.push_back({'T', clock_, model_.thresh_data, 0});
  }

  /// What the software would do with the feature register.
  void acknowledge() {
    if (hold_ != 0) {
      if (--hold_ == 0) model_.ready ^= 1;
    } else if (model_.feature != last_) {
      last_ = model_.feature;
      hold_ = acknowledge_after;
    }
  }

  Model model_;
  std::uint64_t clock_ = 0;  ///< of the frame: the edge that first samples `ena` is 1
  std::uint32_t last_ = 0;   ///< the newest feature word
  unsigned hold_ = 0;        ///< pixel clocks until the acknowledgement
};

}  // namespace bench
