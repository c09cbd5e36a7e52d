#pragma once

#include <array>
#include <cstdint>

namespace xilinx {

/// The timing of a frame in clocks and lines, as the Video Timing Controller has it (PG016): both
/// count from the first active pixel. Vertical signals change in a line at a clock of it, so that
/// a vertical blank begins within the last active line, where the pixels end.
struct VideoTiming {
  std::uint32_t hactive = 1280, htotal = 1650, hsync_start = 1390, hsync_end = 1430;
  std::uint32_t vactive = 720, vtotal = 750, vsync_start = 724, vsync_end = 729;
  std::uint32_t vblank_hstart = 1280, vblank_hend = 1280;
  std::uint32_t vsync_hstart = 1390, vsync_hend = 1390;

  /// Clocks from the first pixel to a clock of a line.
  std::uint64_t clock_at(std::uint32_t line, std::uint32_t clock) const {
    return std::uint64_t{line} * htotal + clock;
  }
  std::uint64_t frame_clocks() const { return std::uint64_t{htotal} * vtotal; }
  bool operator==(const VideoTiming& other) const {
    const auto list = [](const VideoTiming& t) {
      return std::array<std::uint32_t, 12>{
          t.hactive,     t.htotal,    t.hsync_start,   t.hsync_end,   t.vactive,      t.vtotal,
          t.vsync_start, t.vsync_end, t.vblank_hstart, t.vblank_hend, t.vsync_hstart, t.vsync_hend};
    };
    return list(*this) == list(other);
  }
  bool operator!=(const VideoTiming& other) const { return !(*this == other); }
};

/// What the wires of a frame's timing carry; true is active.
struct VideoLevels {
  bool hsync = false, vsync = false, hblank = true, vblank = true, active = false;
};

}  // namespace xilinx
