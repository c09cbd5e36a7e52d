#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <input/input_list.h>
#include <scene/grey_image.h>
#include <scene/pose.h>
#include <scene/scene.h>

namespace platform::input {

/// One image as the platform takes it: of the platform's resolution, with the camera that saw it.
struct InputFrame {
  std::string
      name;  ///< scene, file ("photo.png") or file and picture number ("clip.avi#12"); no folders
  GreyImage image;
  Camera camera;
  std::optional<GroundTruth> truth;  ///< of scenes
};

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

/// Renders the scenes among these inputs now, once, for this process and those that it forks:
/// rendering takes longer than simulating a frame. Stops when those kept fill `most_bytes`; others
/// are rendered when they are needed. Throws vp::InputError for an unknown input.
void keep_scenes(const std::vector<std::string>& inputs, const InputOptions& options,
                 std::size_t most_bytes);

/// A kept scene as that camera sees it; null if it was not kept.
const InputFrame* kept_scene(const std::string& name, const Camera& camera);

}  // namespace platform::input
