#include <xilinx/v_tc/timing_detector.h>

#include <vp/clock.h>

namespace xilinx {

std::uint64_t TimingDetector::lost_at() const {
  return locked_ ? frame_at_ + 2 * found_.frame_clocks() : vp::Clock::never;
}

TimingDetector::Events TimingDetector::sample(std::uint64_t clocks, bool hsync, bool vsync,
                                              bool active) {
  Events events;
  if (clocks >= lost_at()) {
    reset();
    events.lock_loss = true;
  }
  const bool begins = active && !active_, ends = !active && active_;
  if (active) {
    hsync_rest_ = hsync;
    vsync_rest_ = vsync;
  }
  if (vsync != vsync_) {
    const bool starts = vsync != vsync_rest_;
    (starts ? vsync_at_ : vsync_end_at_) = clocks;
    if (!starts) had_vsync_ = true;
  }
  if (hsync != hsync_ && lines_ == 1 && seen_) {
    const auto at = static_cast<std::uint32_t>(clocks - line_at_);
    (hsync != hsync_rest_ ? frame_.hsync_start : frame_.hsync_end) = at;
  }
  if (begins) {
    if (had_vsync_) {
      const Events more = begin_frame(clocks);
      events.frame = true;
      events.lock = more.lock;
      events.lock_loss |= more.lock_loss;
    } else if (lines_ == 1) {
      frame_.htotal = static_cast<std::uint32_t>(clocks - line_at_);
    }
    ++lines_;
    line_at_ = clocks;
    vblank_ = false;
  }
  if (ends) {
    if (lines_ == 1) frame_.hactive = static_cast<std::uint32_t>(clocks - line_at_);
    last_pixel_end_ = clocks;
    if (locked_ && lines_ == found_.vactive) {
      vblank_ = true;
      events.vblank = true;
    }
  }
  active_ = active;
  hsync_ = hsync;
  vsync_ = vsync;
  return events;
}

// What was collected since the last frame began is its timing.
TimingDetector::Events TimingDetector::begin_frame(std::uint64_t clocks) {
  Events events;
  if (seen_ && frame_.htotal != 0) {
    const std::uint32_t line = frame_.htotal;
    const auto lines = [&](std::uint64_t at) {
      return static_cast<std::uint32_t>((at - frame_at_) / line);
    };
    const auto rest = [&](std::uint64_t at) {
      return static_cast<std::uint32_t>((at - frame_at_) % line);
    };
    frame_.vactive = lines_;
    frame_.vtotal = lines(clocks);
    frame_.vsync_start = lines(vsync_at_);
    frame_.vsync_hstart = rest(vsync_at_);
    frame_.vsync_end = lines(vsync_end_at_);
    frame_.vsync_hend = rest(vsync_end_at_);
    frame_.vblank_hstart = frame_.vblank_hend = frame_.hactive;
    const bool same = whole_ && frame_ == found_ && rest(clocks) == 0;
    events.lock = same && !locked_;
    events.lock_loss = !same && locked_;
    locked_ = same;
    found_ = frame_;
    whole_ = true;
  }
  seen_ = true;
  had_vsync_ = false;
  frame_ = VideoTiming{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  lines_ = 0;
  frame_at_ = clocks;
  return events;
}

}  // namespace xilinx
