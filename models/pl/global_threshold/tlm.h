#pragma once

#include <cstdint>

#include <pl/common/frame_channel.h>
#include <pl/global_threshold/frame.h>
#include <pl/global_threshold/global_threshold.h>

namespace pl {

/// Global Threshold at transaction level: a frame's binary image when it begins, the next threshold
/// when it ends.
///
/// Words are in `binary`; they leave one by one on `thresh_out`, too, unless nobody asks for that.
class GlobalThresholdTlm : public GlobalThreshold, private FrameListener {
 public:
  GlobalThresholdTlm(sc_core::sc_module_name name, vp::Clock& clk, const Geometry& geometry,
                     FrameChannel& view);

  void show_words(bool show) override { show_words_ = show; }

 private:
  void edge() override;
  void pixels_changed(std::uint32_t first, std::uint32_t count) override;
  void reset();
  void begin(std::uint64_t cycle);
  void end();
  void load(std::uint64_t cycle);
  bool emit(std::uint64_t cycle);

  FrameChannel& view_;
  ThresholdFrame frame_;
  bool running_ = false;           ///< pixels are taken
  std::uint64_t first_cycle_ = 0;  ///< edge that takes the frame's first pixel
  std::uint32_t next_word_ = 0;    ///< that leaves on thresh_out
  bool show_words_ = true;
};

}  // namespace pl
