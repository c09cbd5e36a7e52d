#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <xilinx/v_tc/video_timing.h>
#include <xilinx/video_frames/video_frames.h>

namespace xilinx {

/// The usual timing of frames of this size (CEA-861 and VESA DMT for 640x480, 800x600, 1024x768,
/// 1280x720 and 1920x1080); of others, with blanks of 160 clocks and 30 lines (as VESA's reduced
/// blanking has across).
VideoTiming usual_timing(std::uint32_t width, std::uint32_t height);

/// A camera that shows pictures of files one after the other, over and over.
class VideoCamera {
 public:
  /// `files`: names with a space or a comma between; "": there is no camera. Throws vp::InputError
  /// for what cannot be read, and for pictures of different sizes.
  VideoCamera(const std::string& files, const PixelLayout& layout, const std::string& of);

  bool is_on() const { return !pictures_.empty(); }
  const VideoTiming& timing() const { return timing_; }
  /// What its wires carry `clock` clocks after it was switched on.
  VideoLevels levels(std::uint64_t clock) const;
  std::uint64_t data(std::uint64_t clock) const;
  /// The first clock after this one on which a wire other than the data changes.
  std::uint64_t next_change(std::uint64_t clock) const;

 private:
  PixelLayout layout_;
  VideoTiming timing_;
  std::vector<VideoPicture> pictures_;
};

}  // namespace xilinx
