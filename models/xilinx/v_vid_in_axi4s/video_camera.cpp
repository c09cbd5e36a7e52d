#include <xilinx/v_vid_in_axi4s/video_camera.h>

#include <algorithm>

#include <vp/error.h>

namespace xilinx {

namespace {

std::vector<std::string> names_of(const std::string& files) {
  std::vector<std::string> names;
  std::string name;
  for (const char c : files + ",") {
    if (c != ',' && c != ' ') {
      name += c;
    } else if (!name.empty()) {
      names.push_back(name);
      name.clear();
    }
  }
  return names;
}

/// From the front porches and syncs of a standard, across and down.
VideoTiming timing_of(std::uint32_t width, std::uint32_t htotal, std::uint32_t hfront,
                      std::uint32_t hsync, std::uint32_t height, std::uint32_t vtotal,
                      std::uint32_t vfront, std::uint32_t vsync) {
  VideoTiming t;
  t.hactive = width;
  t.htotal = htotal;
  t.hsync_start = width + hfront;
  t.hsync_end = t.hsync_start + hsync;
  t.vactive = height;
  t.vtotal = vtotal;
  t.vsync_start = height + vfront - 1;
  t.vsync_end = t.vsync_start + vsync;
  t.vblank_hstart = t.vblank_hend = width;
  t.vsync_hstart = t.vsync_hend = t.hsync_start;
  return t;
}

}  // namespace

VideoTiming usual_timing(std::uint32_t width, std::uint32_t height) {
  if (width == 640 && height == 480) return timing_of(640, 800, 16, 96, 480, 525, 10, 2);
  if (width == 800 && height == 600) return timing_of(800, 1056, 40, 128, 600, 628, 1, 4);
  if (width == 1024 && height == 768) return timing_of(1024, 1344, 24, 136, 768, 806, 3, 6);
  if (width == 1280 && height == 720) return timing_of(1280, 1650, 110, 40, 720, 750, 5, 5);
  if (width == 1920 && height == 1080) return timing_of(1920, 2200, 88, 44, 1080, 1125, 4, 5);
  return timing_of(width, width + 160, 48, 32, height, height + 30, 3, 6);
}

VideoCamera::VideoCamera(const std::string& files, const PixelLayout& layout, const std::string& of)
    : layout_(layout) {
  const std::vector<std::string> names = names_of(files);
  if (names.empty()) return;
  check_layout(layout, of);
  for (const std::string& name : names) {
    pictures_.push_back(read_picture(name));
    const VideoPicture &first = pictures_.front(), &last = pictures_.back();
    if (last.width != first.width || last.height != first.height)
      throw vp::InputError(name + ": it has another size than " + names.front() +
                           ", and a camera's frames have one: scale it");
  }
  timing_ = usual_timing(pictures_.front().width, pictures_.front().height);
}

// It is switched on in the vertical blank, before a frame's first line.
VideoLevels VideoCamera::levels(std::uint64_t clock) const {
  const VideoTiming& t = timing_;
  const std::uint64_t first = std::uint64_t{t.vactive} * t.htotal;
  const std::uint64_t at = (clock + first) % t.frame_clocks();
  const std::uint64_t line = at / t.htotal, column = at % t.htotal;
  VideoLevels now;
  now.active = line < t.vactive && column < t.hactive;
  now.hblank = column >= t.hactive;
  now.vblank =
      at >= t.clock_at(t.vactive - 1, t.hactive) && at < t.clock_at(t.vtotal - 1, t.hactive);
  now.hsync = column >= t.hsync_start && column < t.hsync_end;
  now.vsync =
      at >= t.clock_at(t.vsync_start, t.vsync_hstart) && at < t.clock_at(t.vsync_end, t.vsync_hend);
  return now;
}

std::uint64_t VideoCamera::data(std::uint64_t clock) const {
  const VideoTiming& t = timing_;
  const std::uint64_t shown = clock + std::uint64_t{t.vactive} * t.htotal;
  // The blank before the first frame is the end of one that was not shown.
  const std::uint64_t frame = shown / t.frame_clocks() - 1, at = shown % t.frame_clocks();
  const VideoPicture& picture = pictures_[frame % pictures_.size()];
  return pixel_word(picture, at / t.htotal * t.hactive + at % t.htotal, layout_);
}

std::uint64_t VideoCamera::next_change(std::uint64_t clock) const {
  const VideoTiming& t = timing_;
  const std::uint64_t column = (clock + std::uint64_t{t.vactive} * t.htotal) % t.htotal;
  std::uint64_t next = t.htotal;
  for (const std::uint32_t at : {t.hactive, t.hsync_start, t.hsync_end})
    if (at > column) next = std::min<std::uint64_t>(next, at);
  return clock + next - column;
}

}  // namespace xilinx
