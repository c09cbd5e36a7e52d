#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <facts/unit.h>
#include <marker/input/camera_file.h>
#include <marker/input/fit.h>
#include <marker/input/image_file.h>
#include <marker/scene/grey_image.h>
#include <marker/scene/pose.h>
#include <marker/scene/scene.h>

namespace platform::input {

/// How inputs become frames.
struct InputOptions {
  ImageSize size{640, 480};  ///< resolution of the platform
  Fit fit = Fit::none;       ///< for images and videos of another size
  std::optional<CalibratedCamera>
      camera;                          ///< of images, videos and scenes; none: the thesis' camera
  bool corrects_lens = false;          ///< the program frees what it sees from the lens
  std::uint64_t repeat = 1;            ///< times that the whole list of inputs runs
  std::optional<std::uint64_t> limit;  ///< frames at most
};

/// The camera that took an image of `size`: the calibrated one, or the thesis' with as wide a view.
/// Throws vp::InputError if the calibration is for another size.
Camera camera_of(const InputOptions& options, ImageSize size);

/// One input that can be opened.
struct InputItem {
  enum class Kind { scene, image, video };

  Kind kind;
  std::string source;        ///< scene name or path
  std::string name;          ///< without folders
  bool in_sequence = false;  ///< an image that is a picture of a video
  std::string oddity = {};   ///< a warning; empty: none
};

/// The inputs with groups and folders resolved, each looked at (see open_inputs).
std::vector<InputItem> list_inputs(const std::vector<std::string>& inputs,
                                   const InputOptions& options);

/// True if `a` comes before `b` when runs of digits count as numbers: "a9" before "a10". A total
/// order.
bool natural_less(const std::string& a, const std::string& b);

/// One image as the platform takes it: of the platform's resolution, with the camera that saw it.
/// Its name is that of a scene, a file ("photo.png"), or file and picture number ("clip.avi#12").
struct InputFrame : facts::UnitInput {
  using Truths = std::vector<GroundTruth>;

  InputFrame() = default;
  InputFrame(std::string frame_name, GreyImage picture, const Camera& taken_by,
             const std::optional<GroundTruth>& own = std::nullopt, Truths further = {},
             InputItem::Kind of_kind = InputItem::Kind::scene)
      : UnitInput(std::move(frame_name)),
        image(std::move(picture)),
        camera(taken_by),
        truth(own),
        further_truth(std::move(further)),
        kind(of_kind) {}

  const std::vector<std::uint8_t>& bytes() const override { return image.pixels; }
  std::uint32_t width() const override { return static_cast<std::uint32_t>(image.width); }
  std::uint32_t height() const override { return static_cast<std::uint32_t>(image.height); }
  /// The threshold comes from the picture before. An image file that is not the one before it
  /// settles, and so does a scene behind one; pictures of a video are shown once.
  bool settles_after(const facts::UnitInput* before) const override;

  GreyImage image;
  Camera camera;
  std::optional<GroundTruth> truth;  ///< of a scene: its own marker
  Truths further_truth = {};         ///< of a scene: its other markers
  InputItem::Kind kind = InputItem::Kind::scene;
};

/// It is shared; none: there is no frame.
using SharedFrame = std::shared_ptr<const InputFrame>;

/// Frames one after the other, in memory that does not grow with their number.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// The next frame; none when there are no more. Throws vp::InputError that names the input.
  virtual SharedFrame next() = 0;
  /// How many frames there are, if that is known: videos do not tell for sure.
  virtual std::optional<std::uint64_t> size() const = 0;
  /// What the user should know and is no error, once each, complete after the last frame.
  virtual const std::vector<std::string>& warnings() const = 0;
  /// What was assumed, and done to the inputs as the user asked for; the same way.
  virtual const std::vector<std::string>& notes() const = 0;
};

/// Each input is the name of a scene or of a group of scenes, an image file, a folder (its image
/// files in natural order: 9.png before 10.png; no subfolders), a video, the images of a video
/// ("%04d.png"), or "-", the standard input. No input at all is the demo scene. Scene names come
/// first: write ./demo for a file of that name.
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

/// A kept scene as that camera sees it; none if it was not kept.
SharedFrame kept_scene(const std::string& name, const Camera& camera);

}  // namespace platform::input
