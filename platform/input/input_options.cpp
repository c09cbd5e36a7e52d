#include <input/input_options.h>

namespace platform::input {

Camera camera_of(const InputOptions& options, ImageSize size) {
  return options.camera ? camera_for(*options.camera, size)
                        : Camera::for_resolution(size.width, size.height);
}

}  // namespace platform::input
