#pragma once

#include <marker/quad_fit.h>
#include <marker/side_fit.h>
#include <marker/work.h>

#include <algorithm>
#include <array>
#include <cmath>

/// How the corners of a candidate are measured: part of quad_fit.cpp and of optics_fit.cpp.
namespace marker {
namespace {

// Internal to each source that includes this: neither's code depends on the other.

/// Around a side that is a guess, so far the edge is looked for, px across it.
constexpr double first_reach = 3.2;
/// And never more than this share of the border's cell: behind it the code may be white.
constexpr double most_reach = 0.4;
/// For what the place of the edge is off in the pass before, px.
constexpr double slack = 0.05;
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

/// Noisy edges are measured once more, less widely: each pixel's noise costs more there than what
/// is left of the blur (measured).
constexpr double narrow_share = 0.6;
/// A grey level is the mean of at most so many pixels; in the last pass it shifts the side.
constexpr std::uint32_t coarse_level_pixels = 64, level_pixels = 256, noisy_level_pixels = 1024;

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

/// A few crossings of each side; all of them; and all of them where there is noise.
enum class Pass : std::uint32_t { coarse, fine, narrow };

/// Of the border, behind which the code may begin, px.
double cell_at(const Side& side, const QuadFitOptions& options) {
  return side.height / options.cells;
}

/// One pass: the sides around `fit.ideal`, and the corners anew. `Frame` says what a pixel is read
/// as and what the lens is; LitFrame's may squeeze the picture.
template <class Frame>
Refusal improve(const Frame& frame, const QuadFitOptions& options, Pass which, FitEffort& effort,
                QuadFit& fit) {
  MARKERVP_COUNT(effort.passes);
  if (!is_convex_clockwise(fit.ideal)) return Refusal::shape;
  std::array<Side, 4> sides = sides_of(fit.ideal, fit.image);
  const bool is_last = which != Pass::coarse;
  double transition = 0;
  std::array<EdgeLine, 4> lines{};
  fit.dark = fit.bright = fit.raggedness = 0;
  for (unsigned i = 0; i < 4; ++i) {
    double cell = cell_at(sides[i], options);
    double pixel = (std::abs(sides[i].outward.x) + std::abs(sides[i].outward.y)) / 2;
    [[maybe_unused]] double scale = 1;  // ideal px across the side for one px in the picture
    if constexpr (Frame::may_squeeze) {
      scale = lay_in_picture(frame.lens, sides[i], pixel);
      cell /= scale;
    }
    if (!(cell >= least_cell)) return Refusal::shape;
    const double wanted = which == Pass::narrow ? narrow_share * fit.reach : fit.reach;
    const double reach = std::min(most_reach * cell, std::max(wanted, pixel) + slack);
    const double depth =
        is_last ? std::min(std::max(cell - 2 * reach, least_depth), most_depth) : least_depth;
    FitPass pass{reach, depth, is_last ? options.crossings : coarse_crossings,
                 which == Pass::narrow ? noisy_level_pixels
                 : is_last             ? level_pixels
                                       : coarse_level_pixels,
                 is_last};
    if constexpr (Frame::may_squeeze) {
      pass.reach *= scale;
      pass.depth *= scale;
    }
    const Refusal refusal = fit_side(frame, sides, i, pass, options, effort, lines[i]);
    if (refusal != Refusal::none) return refusal;
    if constexpr (Frame::may_squeeze) {
      lines[i].transition /= scale * scale;
      lines[i].scatter /= scale;
    }
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

/// The last pass, and another one if there is noise.
template <class Frame>
Refusal improve_last(const Frame& frame, const QuadFitOptions& options, FitEffort& effort,
                     QuadFit& fit) {
  const Refusal refusal = improve(frame, options, Pass::fine, effort, fit);
  if (refusal != Refusal::none || !(fit.raggedness > options.noisy)) return refusal;
  return improve(frame, options, Pass::narrow, effort, fit);
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

}  // namespace
}  // namespace marker
