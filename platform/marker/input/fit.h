#pragma once

#include <string>

#include <marker/input/image_file.h>
#include <marker/scene/grey_image.h>
#include <marker/scene/pose.h>

namespace platform::input {

/// What to do with an image that has not the platform's resolution.
enum class Fit {
  none,   ///< refuse it
  crop,   ///< take the middle; an image smaller than the platform's is refused
  scale,  ///< resample all of it to the largest size of its own aspect ratio that fits: every pixel
          ///< the mean of the area it covers (bilinear where it must grow). Bars fill the rest
};

/// Throws vp::InputError, naming `name` and what to do, if an image of `size` cannot be made
/// `target` by `fit`.
void check_fit(const std::string& name, ImageSize size, ImageSize target, Fit fit);

/// The image at the target's size, after check_fit(). Bars have the mean grey of the image's bright
/// pixels: a threshold between bright and dark stays where the image has it, and a bar is never an
/// object.
GreyImage fit_image(GreyImage image, ImageSize target, Fit fit);

/// The camera that would have taken the fitted image: `camera` took one of its own size. Scaling
/// moves focal lengths and principal point with the pixels, bars and cropping move the principal
/// point.
Camera fit_camera(const Camera& camera, ImageSize target, Fit fit);

/// What fitting does to images of `size`, and what is lost; empty if they fit as they are.
std::string fit_text(ImageSize size, ImageSize target, Fit fit);

}  // namespace platform::input
