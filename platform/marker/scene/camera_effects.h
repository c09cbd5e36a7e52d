#pragma once

#include <vector>

#include <marker/scene/grey_image.h>
#include <marker/scene/scene.h>

/// What comes between the light of a scene and the grey levels that a program gets.
namespace platform {

/// Lays a disc of the floor's brightness over the marker's own top left corner, as a finger does.
/// `light`: of all pixels, row by row.
void hide_corner(const Scene& scene, std::vector<double>& light);

/// The grey level, 0 to 1, that a camera of this curve gives for a light of 0 to 1 (white).
double level_of(double light, const marker::LightTable& curve);

/// What a baseline JPEG file of this quality, 1 to 100, loses of a grey image: the coefficients of
/// blocks of 8×8 pixels, in steps of the usual table for luminance (ITU-T T.81, annex K; its
/// scale by quality is that of the Independent JPEG Group's library).
void lose_as_jpeg(GreyImage& image, int quality);

}  // namespace platform
