#pragma once

#include <marker/optics.h>

#include <cstdint>

namespace marker {

/// The light of a grey level where levels are light: 255 of them make white_light.
inline constexpr double grey_level_light = white_light / 255.0;

/// Levels that are light.
const std::uint16_t* linear_light();

/// Light as the power `exponent` of the grey level, 0.5 to 5.
void fill_light(double exponent, LightTable& table);

/// Light by a standard's curve, the inverse of its transfer function: IEC 61966-2-1 (sRGB), and
/// Recommendation ITU-R BT.709.
void fill_srgb_light(LightTable& table);
void fill_rec709_light(LightTable& table);

}  // namespace marker
