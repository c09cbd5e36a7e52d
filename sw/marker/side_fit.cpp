#include <marker/side_fit.h>
#include <marker/side_measure.h>
#include <marker/work.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace marker {
namespace {

/// Grey levels as they are, through a pinhole or Brown–Conrady's lens.
struct Grey {
  using Frame = CameraFrame;
  using AnyLens = Lens;
  using Pixels = const std::uint8_t*;
  using Square = std::uint32_t;
  static constexpr std::uint32_t white = 255;
  static constexpr double of_a_level = 1;
};

}  // namespace

void FitEffort::tell(bool in_dma_memory) const {
  work(Work::fit_passes, passes);
  work(Work::side_fits, sides);
  work(Work::crossings, crossings);
  work(Work::strips, strips);
  work(Work::level_reads, level_reads);
  work(Work::level_pixels, level_pixels);
  work(Work::transitions, transitions);
  work(Work::points_refitted, refitted);
  work(Work::corners_met, corners);
  if (lens_steps != 0) work(Work::lens_steps, lens_steps);
  if (in_dma_memory) work(Work::crossings_dma, crossings);
}

double Side::place_of(Point corner) const {
  return dot(corner - middle, along);
}

std::array<Side, 4> sides_of(const Quad& ideal, const Quad& seen) {
  std::array<Side, 4> sides{};
  for (unsigned i = 0; i < 4; ++i) {
    Side& side = sides[i];
    side.from = ideal[i];
    side.to = ideal[(i + 1) % 4];
    side.middle = 0.5 * (side.from + side.to);
    side.from_seen = seen[i];
    side.to_seen = seen[(i + 1) % 4];
    const Point span = side.to - side.from;
    side.length = std::sqrt(dot(span, span));
    side.along = (1 / side.length) * span;
    side.outward = {side.along.y, -side.along.x};
    const double one = dot(side.from - ideal[(i + 2) % 4], side.outward);
    const double other = dot(side.from - ideal[(i + 3) % 4], side.outward);
    side.height = one < other ? one : other;
    side.by_rows = std::abs(span.y) >= std::abs(span.x);
    const double across = side.by_rows ? side.outward.x : side.outward.y;
    side.dark_first = across > 0;
    side.steepness = std::abs(across);
  }
  return sides;
}

Refusal fit_side(const CameraFrame& frame, const std::array<Side, 4>& sides, unsigned which,
                 const FitPass& pass, const QuadFitOptions& options, FitEffort& effort,
                 EdgeLine& line) {
  MARKERVP_COUNT(effort.sides);
  Path<Lens> path;
  if (!path.find(frame.lens, sides, which, pass.reach, effort)) return Refusal::hidden;
  return SideFit<Grey>(frame, sides[which], effort).fit(path, pass, options, line);
}

}  // namespace marker
