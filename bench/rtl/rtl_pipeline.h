#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include <Vrtl_lean.h>
#include <Vrtl_lean___024root.h>
#include <Vrtl_thesis.h>
#include <Vrtl_thesis___024root.h>

#include "frames.h"
#include "word.h"

namespace bench {

/// Feeds frames to the Verilated feature extraction (models/pl/feature_extraction/rtl) as fast as
/// it takes them. `Model` is what Verilator made of it.
template <class Model>
class RtlPipeline {
 public:
  RtlPipeline() {
    model_.por = 1;
    model_.binary_tready = 1;
    for (int i = 0; i < 4; ++i) tick();
    model_.por = 0;
    tick();
  }
  ~RtlPipeline() { model_.final(); }
  RtlPipeline(const RtlPipeline&) = delete;
  RtlPipeline& operator=(const RtlPipeline&) = delete;

  /// Puts an image of 640x480 pixels into the BRAM.
  void load(const harness::Image& image) {
    std::memcpy(&inside_.feature_extraction__DOT__bram__DOT__words[0], image.data(), image.size());
  }

  /// A whole frame, until its end word was seen and everything is at rest.
  void run_frame() {
    control(rst, 2);
    control(0, 2);
    words_.clear();
    last_ = model_.feature;
    hold_ = 0;
    clock_ = 0;
    control(ena, 1);
    control(0, 3);
    while (busy() || last_ != end_of_frame) tick();
  }

  /// What left the detectors in the last frame, in the order of the clocks.
  const std::vector<harness::Word>& words() const { return words_; }
  /// The threshold that the next frame will use.
  int threshold() const { return inside_.feature_extraction__DOT__active_threshold; }

 private:
  /// Pixel clocks from a feature word to its acknowledgement.
  static constexpr unsigned acknowledge_after = 10;
  static constexpr std::uint32_t end_of_frame = 0xFFFF'FFFF;
  // Of the control packet; its header needs SystemC, of which Verilator would take the time.
  static constexpr std::uint32_t ena = 1u << 0, rst = 1u << 1, ready = 1u << 2;

  bool busy() const {
    return inside_.feature_extraction__DOT__busy || inside_.feature_extraction__DOT__frame_ena;
  }

  /// Shows bits of the control packet, beside the toggling one, for some pixel clocks.
  void control(std::uint32_t bits, int clocks) {
    model_.gpio_in = (model_.gpio_in & ready) | bits;
    for (int i = 0; i < clocks; ++i) tick();
  }

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
    model_.pixel_clk = pixel_clk;
    model_.system_clk = system_clk;
    model_.eval();
  }

  void collect() {
    if (inside_.feature_extraction__DOT__blob_out) {
      words_.push_back({'B', clock_, inside_.feature_extraction__DOT__blob_start,
                        inside_.feature_extraction__DOT__blob_end});
    }
    if (inside_.feature_extraction__DOT__corner_out) {
      words_.push_back({'C', clock_, inside_.feature_extraction__DOT__corner_data, 0});
    }
    if (inside_.feature_extraction__DOT__thresh_out) {
      words_.push_back({'T', clock_, inside_.feature_extraction__DOT__thresh_data, 0});
    }
  }

  /// What the software would do with the feature register.
  void acknowledge() {
    if (hold_ != 0) {
      if (--hold_ == 0) model_.gpio_in ^= ready;
    } else if (model_.feature != last_) {
      last_ = model_.feature;
      hold_ = acknowledge_after;
    }
  }

  Model model_;
  decltype(*Model::rootp)& inside_ = *model_.rootp;
  std::vector<harness::Word> words_;
  std::uint64_t clock_ = 0;  ///< of the frame: the edge that first samples `ena` is 1
  std::uint32_t last_ = 0;   ///< the newest feature word
  unsigned hold_ = 0;        ///< pixel clocks until the acknowledgement
};

/// Corner detection as the thesis builds it: nine FAST modules.
using ThesisRtl = RtlPipeline<Vrtl_thesis>;
/// The same outputs from one FAST module.
using LeanRtl = RtlPipeline<Vrtl_lean>;

}  // namespace bench
