#include <marker/optics_frame.h>
#include <marker/side_measure.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace marker {
namespace {

/// Light, through any lens.
struct Lit {
  using Frame = LitFrame;
  using AnyLens = GeneralLens;
  using Pixels = LitPixels;
  using Square = std::uint64_t;
  static constexpr std::uint32_t white = white_light;
  static constexpr double of_a_level = white_light / 255.0;
};

}  // namespace

double lay_in_picture(const GeneralLens& lens, Side& side, double& pixel) {
  const Point across = gradient(lens, side.middle, side.outward);
  side.by_rows = std::abs(across.x) >= std::abs(across.y);
  const double along_strip = side.by_rows ? across.x : across.y;
  side.dark_first = along_strip > 0;
  side.steepness = std::abs(along_strip);
  const double scale = std::sqrt(dot(across, across));
  pixel = (std::abs(across.x) + std::abs(across.y)) / scale / 2;
  return scale;
}

Refusal fit_side(const LitFrame& frame, const std::array<Side, 4>& sides, unsigned which,
                 const FitPass& pass, const QuadFitOptions& options, FitEffort& effort,
                 EdgeLine& line) {
  MARKERVP_COUNT(effort.sides);
  Path<GeneralLens> path;
  if (!path.find(frame.lens, sides, which, pass.reach, effort)) return Refusal::hidden;
  return SideFit<Lit>(frame, sides[which], effort).fit(path, pass, options, line);
}

}  // namespace marker
