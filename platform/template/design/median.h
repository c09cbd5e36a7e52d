#pragma once

#include <pl/common/pixel_filter.h>

/// The median of a pixel and its eight neighbours; pixels at the border pass as they are. A pixel
/// leaves width + 2 clocks after it came: its last neighbour is one line and one pixel behind it.
class Median : public pl::PixelFilter {
 protected:
  Median(sc_core::sc_module_name name, const pl::FilterSite& site)
      : PixelFilter(name, site.clk), geometry_(site.geometry) {}

  const pl::Geometry geometry_;

 private:
  vp::IpEstimate own_estimate() const override;
};

/// As `site` asks for it, clock by clock or whole frames: the same words at the same clocks.
std::unique_ptr<pl::PixelFilter> make_median(const pl::FilterSite& site);
