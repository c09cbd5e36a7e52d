#pragma once

#include <vector>

#include <scene/grey_image.h>
#include <scene/scene.h>

namespace platform {

/// The picture before noise and rounding: one brightness a pixel, fraction of full scale, row by
/// row. The mean over the pixel's square is exact (analytic coverage), then blurred as the lens
/// does. Throws vp::InputError like validate().
std::vector<double> render_light(const Scene& scene);

/// The picture that the camera delivers: light plus noise, times 255, rounded and saturated. Equal
/// scenes give equal bytes on any host. Throws vp::InputError like validate().
GreyImage render(const Scene& scene);

}  // namespace platform
