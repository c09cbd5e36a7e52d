#pragma once

#include <string>

#include <facts/result.h>
#include <marker/scene/grey_image.h>

namespace platform::picture {

/// What the page shows of a frame, a JSON text: the image, what was found in it, its camera.
std::string page_view(const GreyImage& image, const facts::UnitReport& frame);

}  // namespace platform::picture
