#include <marker/quad_fit.h>
#include <marker/quad_measure.h>
#include <marker/side_fit.h>
#include <marker/work.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace marker {
namespace {

/// Of some points that with which two others span the largest triangle, clockwise.
struct Farthest {
  unsigned index;
  std::int32_t area;  ///< twice
};

Farthest farthest_of(const std::array<Pixel, 8>& points, unsigned begin, unsigned end, Pixel from,
                     Pixel to) {
  Farthest farthest{begin, 0};
  for (unsigned i = begin; i < end; ++i) {
    const Pixel p = points[i];
    const std::int32_t area = (p.x - from.x) * (to.y - from.y) - (p.y - from.y) * (to.x - from.x);
    if (area > farthest.area) farthest = {i, area};
  }
  return farthest;
}

Point in_pixels(Pixel half_pixels) {
  return {half_pixels.x / 2.0, half_pixels.y / 2.0};
}

}  // namespace

bool largest_quad(const Extremes& extremes, Quad& quad) {
  [[maybe_unused]] std::uint32_t tests = 0;
  // A blob ends where its outermost pixels end. In half pixels.
  constexpr std::array<Pixel, 8> ends = {
      {{1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}, {0, 0}}};
  std::array<Pixel, 8> p;
  for (unsigned i = 0; i < 8; ++i)
    p[i] = {2 * extremes[i].x + ends[i].x, 2 * extremes[i].y + ends[i].y};
  // On each side of a diagonal the largest triangle counts.
  std::int32_t largest = 0;
  for (unsigned a = 0; a < 5; ++a) {
    for (unsigned c = a + 2; c < 7; ++c) {
      const Farthest b = farthest_of(p, a + 1, c, p[a], p[c]);
      const Farthest d = farthest_of(p, c + 1, 8, p[c], p[a]);
      if (b.area + d.area <= largest) continue;
      MARKERVP_COUNT(tests);
      const Quad candidate = {in_pixels(p[a]), in_pixels(p[b.index]), in_pixels(p[c]),
                              in_pixels(p[d.index])};
      if (!is_convex_clockwise(candidate)) continue;
      largest = b.area + d.area;
      quad = candidate;
    }
  }
  work(Work::quads_spanned, 1);
  work(Work::hulls_tested, tests);
  return largest > 0;
}

QuadFit guess_quad(const Lens& lens, const Quad& corners, const QuadFitOptions& options) {
  QuadFit fit{};
  fit.image = corners;
  fit.refusal = Refusal::shape;
  for (unsigned i = 0; i < 4; ++i) {
    if (!undistort(lens, corners[i], fit.ideal[i])) return fit;
  }
  if (!is_convex_clockwise(fit.ideal)) return fit;
  for (const Side& side : sides_of(fit.ideal, fit.image)) {
    if (!(cell_at(side, options) >= least_cell)) return fit;
  }
  fit.refusal = Refusal::none;
  return fit;
}

void find_quad(const CameraFrame& frame, const QuadFitOptions& options, QuadFit& fit) {
  const FunctionScope scope(Function::quad_fit);
  if (fit.refusal != Refusal::none) return;
  work(Work::quads_fitted, 1);
  FitEffort effort;
  const Quad guess = fit.image;
  fit.reach = first_reach;
  for (unsigned pass = 0; pass < most_passes && fit.refusal == Refusal::none; ++pass) {
    const Quad before = fit.image;
    fit.refusal = improve(frame, options, Pass::coarse, effort, fit);
    if (fit.refusal != Refusal::none) break;
    if (!(farthest_move(fit.image, guess) <= most_move)) fit.refusal = Refusal::shape;
    if (farthest_move(fit.image, before) <= settled) break;
  }
  effort.tell(frame.in_dma_memory);
}

void refine_quad(const CameraFrame& frame, const QuadFitOptions& options, QuadFit& fit) {
  const FunctionScope scope(Function::quad_fit);
  if (fit.refusal != Refusal::none) return;
  work(Work::quads_refined, 1);
  FitEffort effort;
  const Quad found = fit.image;
  fit.refusal = improve_last(frame, options, effort, fit);
  if (fit.refusal == Refusal::none && !(farthest_move(fit.image, found) <= most_move)) {
    fit.refusal = Refusal::shape;
  }
  if (fit.refusal == Refusal::none && fit.raggedness > options.maximum_raggedness) {
    fit.refusal = Refusal::ragged;
  }
  effort.tell(frame.in_dma_memory);
}

QuadFit fit_quad(const CameraFrame& frame, const Quad& guess, const QuadFitOptions& options) {
  QuadFit fit = guess_quad(frame.lens, guess, options);
  find_quad(frame, options, fit);
  refine_quad(frame, options, fit);
  return fit;
}

QuadFit counted_from(const QuadFit& fit, unsigned first) {
  QuadFit counted = fit;
  for (unsigned i = 0; i < 4; ++i) {
    counted.ideal[i] = fit.ideal[(i + first) % 4];
    counted.image[i] = fit.image[(i + first) % 4];
  }
  for (unsigned i = 0; i < 8; ++i) {
    counted.common[i] = fit.common[(i + 2 * first) % 8];
    for (unsigned j = 0; j < 8; ++j) {
      counted.covariance[i * 8 + j] = fit.covariance[(i + 2 * first) % 8 * 8 + (j + 2 * first) % 8];
    }
  }
  return counted;
}

}  // namespace marker
