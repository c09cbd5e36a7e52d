#pragma once

#include <string>

#include <input/image_file.h>
#include <scene/camera.h>
#include <scene/grey_image.h>

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

}  // namespace platform::input
