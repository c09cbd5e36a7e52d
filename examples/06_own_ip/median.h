#pragma once

#include <pl/common/frame_channel.h>

/// A 3×3 median filter, clock by clock or whole frames: the same words at the same clocks.
const pl::Models<pl::PixelFilter>& median_models();
