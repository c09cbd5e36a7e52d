#pragma once

#include <optional>
#include <string>

#include <scene/camera.h>
#include <scene/grey_image.h>
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

}  // namespace platform::input
