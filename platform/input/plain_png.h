#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <scene/grey_image.h>

namespace platform::input {

/// Decompresses a PNG of 8-bit grey without interlacing: the values as stored, no gamma. Nothing if
/// its data is damaged.
std::optional<GreyImage> read_plain_png(const std::vector<std::uint8_t>& bytes, int width,
                                        int height);

}  // namespace platform::input
