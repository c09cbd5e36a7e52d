#pragma once

#include <cstdint>

#include <xilinx/v_tc/video_timing.h>

namespace xilinx {

/// Finds the timing of frames from their wires. It needs both syncs and active video, which is
/// active high; a sync is inactive while pixels come, and so its polarity shows. It locks when two
/// frames in a row have the same timing (assumed).
class TimingDetector {
 public:
  /// What happened on an edge.
  struct Events {
    bool frame = false;   ///< the first pixel of a frame
    bool vblank = false;  ///< the last pixel of a frame is over
    bool lock = false, lock_loss = false;
  };
  /// The wires as they are on edge `clocks` of those that count. To be called for each on which one
  /// differs from the edge before, and for others as one likes.
  Events sample(std::uint64_t clocks, bool hsync, bool vsync, bool active);
  void reset() { *this = TimingDetector(); }

  bool locked() const { return locked_; }
  bool in_active() const { return active_; }
  bool in_vblank() const { return vblank_; }
  /// Of the last whole frame.
  const VideoTiming& timing() const { return found_; }
  bool hsync_high() const { return !hsync_rest_; }
  bool vsync_high() const { return !vsync_rest_; }
  /// The edge on which lock is lost unless a frame begins; never: it is not locked.
  std::uint64_t lost_at() const;

 private:
  Events begin_frame(std::uint64_t clocks);

  bool seen_ = false;  ///< a frame began
  bool locked_ = false;
  bool whole_ = false;  ///< found_ is of a whole frame
  bool active_ = false, vblank_ = true;
  bool hsync_ = false, vsync_ = false;            ///< as sampled last
  bool hsync_rest_ = false, vsync_rest_ = false;  ///< while pixels come
  bool had_vsync_ = false;                        ///< since the last frame began
  std::uint64_t frame_at_ = 0, line_at_ = 0, last_pixel_end_ = 0;
  std::uint64_t vsync_at_ = 0, vsync_end_at_ = 0;
  std::uint32_t lines_ = 0;
  VideoTiming frame_, found_;
};

}  // namespace xilinx
