#include <marker/quad_fit.h>
#include <marker/side_fit.h>
#include <marker/work.h>

#include <algorithm>
#include <cmath>

namespace marker {
namespace {

/// Around a side that is a guess, so far the edge is looked for, px across it.
constexpr double first_reach = 3.2;
/// Then an edge is measured so many standard deviations of its transition to both sides, but not
/// less than the half pixel that every edge takes. Wider costs accuracy (each pixel adds its
/// noise), narrower makes the blur show.
constexpr double reach_in_deviations = 2.5;
/// And never more than this share of the border's cell: behind it the code may be white.
constexpr double most_reach = 0.4;
/// For what the place of the edge is off in the pass before, px.
constexpr double slack = 0.05;
/// A marker with smaller cells is too small, px.
constexpr double least_cell = 1.5;
/// So deep beyond the transition a grey level is read, px across the edge: as far as the border's
/// cell goes, but not less than the first, which tells whether the code's cell is black, too.
constexpr double least_depth = 2;
constexpr double most_depth = 10;
/// The corners are found in passes, each around where they were before, from a few crossings of
/// each side, until a pass moves none by more than `settled` px; then a last pass has all the
/// crossings that are asked for.
constexpr unsigned most_passes = 2;
constexpr double settled = 1;
constexpr std::uint32_t coarse_crossings = 12;
/// A corner that leaves its guess by more belongs to something else, px.
constexpr double most_move = 6;

/// Where two lines meet, and how the corner moves with their offsets there.
struct Meeting {
  Point corner;
  Point by_first, by_second;
};

bool meet(const Side& first, const EdgeLine& one, const Side& second, const EdgeLine& other,
          Meeting& meeting) {
  // Line: n · p = d.
  const Point n = first.outward - one.slope * first.along;
  const Point m = second.outward - other.slope * second.along;
  const double d = one.offset + dot(n, first.middle);
  const double e = other.offset + dot(m, second.middle);
  const double determinant = n.x * m.y - n.y * m.x;
  if (!(std::abs(determinant) > 1e-3)) return false;
  meeting.by_first = {m.y / determinant, -m.x / determinant};
  meeting.by_second = {-n.y / determinant, n.x / determinant};
  meeting.corner = d * meeting.by_first + e * meeting.by_second;
  return true;
}

/// Covariance of a line's offsets at two places along it.
double offset_covariance(const EdgeLine& line, double s, double t) {
  return line.offset_variance + (s + t) * line.covariance + s * t * line.slope_variance;
}

/// Corner i lies between the sides i − 1 and i. Each side moves both of its corners.
void fill_covariance(const std::array<Side, 4>& sides, const std::array<EdgeLine, 4>& lines,
                     const std::array<Meeting, 4>& corners, std::array<double, 64>& covariance) {
  covariance.fill(0);
  for (unsigned side = 0; side < 4; ++side) {
    const std::array<unsigned, 2> ends = {side, (side + 1) % 4};
    const std::array<Point, 2> moves = {corners[ends[0]].by_second, corners[ends[1]].by_first};
    for (unsigned a = 0; a < 2; ++a) {
      for (unsigned b = 0; b < 2; ++b) {
        const double c =
            offset_covariance(lines[side], sides[side].place_of(corners[ends[a]].corner),
                              sides[side].place_of(corners[ends[b]].corner));
        double* const at = &covariance[ends[a] * 16 + ends[b] * 2];
        at[0] += c * moves[a].x * moves[b].x;
        at[1] += c * moves[a].x * moves[b].y;
        at[8] += c * moves[a].y * moves[b].x;
        at[9] += c * moves[a].y * moves[b].y;
      }
    }
  }
}

/// Of the border, behind which the code may begin, px.
double cell_at(const Side& side, const QuadFitOptions& options) {
  return side.height / options.cells;
}

/// One pass: the sides around `fit.ideal`, and the corners anew.
Refusal improve(const CameraFrame& frame, const QuadFitOptions& options, bool is_last,
                FitEffort& effort, QuadFit& fit) {
  MARKERVP_COUNT(effort.passes);
  if (!is_convex_clockwise(fit.ideal)) return Refusal::shape;
  const std::array<Side, 4> sides = sides_of(fit.ideal, fit.image);
  double transition = 0;
  std::array<EdgeLine, 4> lines{};
  fit.dark = fit.bright = fit.raggedness = 0;
  for (unsigned i = 0; i < 4; ++i) {
    const double cell = cell_at(sides[i], options);
    if (!(cell >= least_cell)) return Refusal::shape;
    const double pixel = (std::abs(sides[i].outward.x) + std::abs(sides[i].outward.y)) / 2;
    const double reach = std::min(most_reach * cell, std::max(fit.reach, pixel) + slack);
    const double depth =
        is_last ? std::min(std::max(cell - 2 * reach, least_depth), most_depth) : least_depth;
    const FitPass pass{reach, depth, is_last ? options.crossings : coarse_crossings, is_last};
    const Refusal refusal = fit_side(frame, sides, i, pass, options, effort, lines[i]);
    if (refusal != Refusal::none) return refusal;
    fit.dark += lines[i].dark / 4;
    fit.bright += lines[i].bright / 4;
    transition += lines[i].transition / 4;
    if (lines[i].scatter > fit.raggedness) fit.raggedness = lines[i].scatter;
  }
  std::array<Meeting, 4> corners{};
  for (unsigned i = 0; i < 4; ++i) {
    const unsigned before = (i + 3) % 4;
    MARKERVP_COUNT(effort.corners);
    if (!meet(sides[before], lines[before], sides[i], lines[i], corners[i])) return Refusal::shape;
    fit.ideal[i] = corners[i].corner;
    fit.image[i] = distort(frame.lens, corners[i].corner);
    MARKERVP_ADD(effort.lens_steps, frame.lens.is_pinhole() ? 0 : 1);
  }
  if (is_last) fill_covariance(sides, lines, corners, fit.covariance);
  if (!is_last) fit.reach = reach_in_deviations * std::sqrt(transition);
  return is_convex_clockwise(fit.ideal) ? Refusal::none : Refusal::shape;
}

/// The longest way from one of `guess` to the corner that it became, px.
double farthest_move(const Quad& corners, const Quad& guess) {
  double farthest = 0;
  for (unsigned i = 0; i < 4; ++i) {
    const Point move = corners[i] - guess[i];
    farthest = std::max(farthest, dot(move, move));
  }
  return std::sqrt(farthest);
}

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
    fit.refusal = improve(frame, options, false, effort, fit);
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
  fit.refusal = improve(frame, options, true, effort, fit);
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
    for (unsigned j = 0; j < 8; ++j) {
      counted.covariance[i * 8 + j] = fit.covariance[(i + 2 * first) % 8 * 8 + (j + 2 * first) % 8];
    }
  }
  return counted;
}

}  // namespace marker
