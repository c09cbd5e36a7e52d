#pragma once

#include <marker/optics.h>
#include <marker/quad_fit.h>
#include <marker/side_fit.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace marker {

/// Pixels as they follow each other, read as the light that they stand for.
class LitPixels {
 public:
  LitPixels() = default;
  LitPixels(const std::uint8_t* first, const std::uint16_t* light) : at_(first), light_(light) {}

  std::uint32_t operator*() const { return light_[*at_]; }
  std::uint32_t operator[](std::ptrdiff_t i) const { return light_[at_[i]]; }
  LitPixels& operator+=(std::ptrdiff_t n) {
    at_ += n;
    return *this;
  }
  friend LitPixels operator+(LitPixels p, std::ptrdiff_t n) { return p += n; }
  friend LitPixels operator-(LitPixels p, std::ptrdiff_t n) { return p += -n; }

 private:
  const std::uint8_t* at_;
  const std::uint16_t* light_;
};

/// A CameraFrame as its optics show it.
struct LitFrame {
  static constexpr bool may_squeeze = true;

  struct Image {
    LitPixels pixels;
    std::uint32_t width, height;  ///< px
  };

  Image image;
  const GeneralLens& lens;
  Box part;
};

/// Lays the strips of a side as they run in the picture: their direction and steepness. Returns how
/// many ideal px across the side are one px in the picture. `pixel`: half of what a pixel reaches
/// across the side, px.
double lay_in_picture(const GeneralLens& lens, Side& side, double& pixel);

/// As fit_side() of side_fit.h. Levels, and the least contrast in `options`, are light there.
Refusal fit_side(const LitFrame& frame, const std::array<Side, 4>& sides, unsigned which,
                 const FitPass& pass, const QuadFitOptions& options, FitEffort& effort,
                 EdgeLine& line);

}  // namespace marker
