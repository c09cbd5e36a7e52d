#include <pl/sensor_input/frame_view.h>

#include <algorithm>

#include <vp/clock_scheduler.h>

namespace pl {

namespace {

/// Clocks behind the last pixel in which a model may still look at the frame.
constexpr std::uint64_t drain_clocks = 8;

}  // namespace

FrameView::FrameView(const vp::Clock& clk, const Geometry& geometry, xilinx::Bram& bram)
    : clock_(clk), size_(geometry.pixels()), bram_(bram), pixels_(bram.contents().data()) {
  bram_.set_listener(this);
}

void FrameView::begin(std::uint64_t first_cycle) {
  for (FrameListener* listener : listeners_) listener->frame_begins();
  before_.swap(kept_);
  forked_ = false;
  pixels_ = bram_.contents().data();
  first_cycle_ = first_cycle;
  running_ = true;
}

// At coincident edges the memory's side runs first: what it writes now, the sensor still gets.
std::uint64_t FrameView::edges_before_now() const {
  if (clock_.frequency_hz() == 0) return clock_.cycle();
  return clock_.cycle_at_or_after(clock_.scheduler().now_ps()) - 1;
}

std::uint32_t FrameView::sent() const {
  const std::uint64_t edges = edges_before_now() + 1;
  if (edges <= first_cycle_) return 0;
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(edges - first_cycle_, size_));
}

bool FrameView::watched() {
  if (running_) running_ = edges_before_now() < first_cycle_ + size_ + drain_clocks;
  return running_;
}

void FrameView::before_write(std::uint32_t first, std::uint32_t) {
  if (forked_ || !watched() || first >= sent()) return;
  kept_ = bram_.fork();
  forked_ = true;
}

void FrameView::after_write(std::uint32_t first, std::uint32_t count) {
  if (!watched()) return;
  const std::uint32_t changed = std::max(first, sent()), end = std::min(first + count, size_);
  if (changed >= end) return;
  if (forked_) {
    const auto& now = bram_.contents();
    std::copy(now.begin() + changed, now.begin() + end, kept_.begin() + changed);
  }
  for (FrameListener* listener : listeners_) listener->pixels_changed(changed, end - changed);
}

}  // namespace pl
