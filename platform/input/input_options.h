#pragma once

#include <cstdint>
#include <optional>

#include <input/camera_file.h>
#include <input/fit.h>
#include <input/image_file.h>
#include <scene/camera.h>

namespace platform::input {

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

}  // namespace platform::input
