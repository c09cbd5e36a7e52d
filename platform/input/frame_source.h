#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <input/input_frame.h>
#include <input/input_options.h>

namespace platform::input {

/// Frames one after the other, in memory that does not grow with their number.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// The next frame; nothing when there are no more. Throws vp::InputError that names the input.
  virtual std::optional<InputFrame> next() = 0;
  /// How many frames there are, if that is known: videos do not tell for sure.
  virtual std::optional<std::uint64_t> size() const = 0;
  /// What the user should know and is no error, once each, complete after the last frame.
  virtual const std::vector<std::string>& warnings() const = 0;
};

/// Each input is the name of a scene or of a group of scenes, an image file, a folder (its image
/// files in natural order: 9.png before 10.png; no subfolders) or a video. No input at all is the
/// demo scene. Scene names come first: write
/// ./demo for a file of that name.
///
/// All inputs are looked at before the first frame is made, so that a wrong one costs no time.
/// Throws vp::InputError for one that is unknown, missing, unreadable, empty, truncated,
/// zero-sized, of the wrong or an absurd size, no file at all (a FIFO, a device, also inside a
/// folder), a folder without images, or a video without frames.
std::unique_ptr<FrameSource> open_inputs(const std::vector<std::string>& inputs,
                                         const InputOptions& options);

}  // namespace platform::input
