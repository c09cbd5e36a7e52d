#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <input/camera_file.h>
#include <input/image_file.h>
#include <scene/grey_image.h>
#include <scene/pose.h>

namespace platform::input {

/// What to do with an image that has not the platform's resolution.
enum class Fit {
  none,   ///< refuse it
  crop,   ///< take the middle; an image smaller than the platform's is refused
  scale,  ///< take the largest middle part of the platform's aspect ratio, then resample it: every
          ///< pixel the mean of the area it covers (bilinear where it must grow)
};

/// Throws vp::InputError, naming `name` and what to do, if an image of `size` cannot be made
/// `target` by `fit`.
void check_fit(const std::string& name, ImageSize size, ImageSize target, Fit fit);

/// The image at the target's size, after check_fit().
GreyImage fit_image(GreyImage image, ImageSize target, Fit fit);

/// The camera that would have taken the fitted image: `camera` took one of its own size. Scaling
/// moves focal lengths and principal point with the pixels, cropping moves the principal point.
Camera fit_camera(const Camera& camera, ImageSize target, Fit fit);

/// How inputs become frames.
struct InputOptions {
  ImageSize size{640, 480};  ///< resolution of the platform
  Fit fit = Fit::none;       ///< for images and videos of another size
  std::optional<CalibratedCamera>
      camera;                          ///< of images, videos and scenes; none: the thesis' camera
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
  std::string source;  ///< scene name or path
  std::string name;    ///< without folders
};

/// The inputs with groups and folders resolved, each looked at (see open_inputs).
std::vector<InputItem> list_inputs(const std::vector<std::string>& inputs,
                                   const InputOptions& options);

/// True if `a` comes before `b` when runs of digits count as numbers: "a9" before "a10". A total
/// order.
bool natural_less(const std::string& a, const std::string& b);

}  // namespace platform::input
