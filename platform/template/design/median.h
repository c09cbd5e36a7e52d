#pragma once

#include <pl/common/pixel_filter.h>

/// The median of a pixel and its eight neighbours; pixels at the border pass as they are. Its
/// last neighbour is one line and one pixel behind it.
class Median : public pl::PixelFilter {
 protected:
  using PixelFilter::PixelFilter;

  /// Clocks from the one that takes a pixel to the one in which it leaves, filtered.
  std::uint32_t latency() const { return geometry_.width + 1; }

 private:
  vp::IpEstimate own_estimate() const override;
};

/// Clock by clock, or whole frames: the same words at the same clocks.
const pl::Models<pl::PixelFilter>& median_models();
