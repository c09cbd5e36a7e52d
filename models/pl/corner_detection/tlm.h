#pragma once

#include <cstdint>
#include <vector>

#include <pl/common/frame_channel.h>
#include <pl/corner_detection/corner_detection.h>
#include <pl/corner_detection/frame.h>

namespace pl {

/// Corner Detection at transaction level: finds a frame's corners when it begins, and shows each on
/// its clock.
///
/// `rst` is the sensor's, too.
class CornerDetectionTlm : public CornerDetection, private FrameListener {
 public:
  CornerDetectionTlm(sc_core::sc_module_name name, vp::Clock& clk, const Geometry& geometry,
                     FrameChannel& view);

 private:
  void edge() override;
  void pixels_changed(std::uint32_t first, std::uint32_t count) override;
  void begin(std::uint64_t cycle);
  void find_again(std::uint64_t cycle);
  void append_corners();
  std::vector<StampedWord>::iterator first_at_or_after(std::uint64_t cycle, std::size_t from);
  std::uint64_t next_change(std::uint64_t cycle) const;
  void emit(std::uint64_t cycle);
  void reset();
  std::uint64_t cycle_of(std::uint64_t clock) const { return offset_ + clock; }

  Geometry geometry_;
  FrameChannel& view_;
  CornerFrame frame_;
  std::vector<StampedWord> corners_;  ///< stamped with cycles; those to come from next_ on
  std::size_t next_ = 0;
  bool ena_before_ = false;
  std::uint64_t offset_ = 0;                        ///< cycle of the frame's clock 0
  std::uint32_t changed_ = ~0u;                     ///< first pixel that is not what it was
  std::uint64_t changed_cycle_ = vp::Clock::never;  ///< edge on which that pixel is taken
};

}  // namespace pl
