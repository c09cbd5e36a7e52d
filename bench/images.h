#pragma once

#include <string>
#include <vector>

#include "frames.h"

namespace bench {

/// Pictures of 640x480 that benchmarks run on: "demo", the demo scene; "noise", any grey level in
/// each pixel, the most corners there can be; "photograph", textured like one, with the demo scene
/// in it. Throws std::invalid_argument for another name.
harness::Image make_image(const std::string& name);

const std::vector<std::string>& image_names();

}  // namespace bench
