#include <marker/light_curves.h>
#include <marker/optics_fit.h>
#include <marker/optics_frame.h>
#include <marker/quad_measure.h>
#include <marker/work.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace marker {
namespace {

/// The narrow one, px across the edge: half of the shade between two markers that are 2 px apart is
/// beyond it, and a blob's extremes are nearer than that to its corners (measured).
constexpr double narrow_reach = 1.2;
/// Passes in light before the last, where corners were found in the light of another curve.
constexpr unsigned passes_in_light = 2;
/// A pass that moves no corner farther is enough, px.
constexpr double still = 0.05;
/// What is left of a side's own error beside that of its strips, in deviations of their transition:
/// 0.002 px in sharp pictures, 0.006 px in blurred ones (measured).
constexpr double side_error = 0.007;
/// Where the border's cell is narrower than the first number, in deviations of a transition, the
/// code behind it shows in the dark level: sides are off by up to the second, all of them alike and
/// each by itself (measured).
constexpr double clear_cell = 6, narrow_error = 0.05;

/// A curve of exponent 2.2 has the middle of light at 0.73 of the way between the levels. An edge
/// that was found in grey levels is shifted by 0.39 of its transition's deviation, outwards, and
/// narrower by 0.04: that much for how far the middle is off (measured).
constexpr double shift_of_middle = 1.7, narrowing_of_middle = 0.19;

/// How far off the middle is, as share of the way between both levels. 0 where levels are light.
double middle_of_light(const std::uint16_t* light, const QuadFit& fit) {
  const auto dark = static_cast<std::uint32_t>(fit.dark);
  const auto bright = static_cast<std::uint32_t>(fit.bright);
  if (!(dark < bright && bright < std::tuple_size_v<LightTable>) || light == linear_light())
    return 0;
  const std::uint32_t middle = (light[dark] + light[bright]) / 2;
  const std::uint16_t* const at = std::lower_bound(light + dark, light + bright, middle);
  return static_cast<double>(at - light - dark) / (bright - dark) - 0.5;
}

LitFrame lit(const CameraFrame& frame, const std::uint16_t* light) {
  return {{{frame.image.pixels, light}, frame.image.width, frame.image.height},
          frame.optics->lens,
          frame.part};
}

void tell([[maybe_unused]] const FitEffort& effort, [[maybe_unused]] bool in_dma_memory) {
  work(Work::lit_fits, 1);
  work(Work::lit_passes, effort.passes);
  work(Work::lit_side_fits, effort.sides);
  work(Work::lit_crossings, effort.crossings);
  work(Work::lit_strips, effort.strips);
  work(Work::lit_level_reads, effort.level_reads);
  work(Work::lit_level_pixels, effort.level_pixels);
  work(Work::lit_refitted, effort.refitted);
  work(Work::lit_transitions, effort.transitions);
  if (in_dma_memory) work(Work::crossings_dma, effort.crossings);
}

/// How a corner moves if the side before it moves out by `first` px, and the one behind by
/// `second`.
Point moved(const Side& before, const Side& behind, double first, double second) {
  const Point n = before.outward, m = behind.outward;
  const double determinant = n.x * m.y - n.y * m.x;
  return {(first * m.y - second * n.y) / determinant, (second * n.x - first * m.x) / determinant};
}

void add_product(std::array<double, 64>& covariance, const std::array<double, 8>& move) {
  for (unsigned i = 0; i < 8; ++i) {
    for (unsigned j = 0; j < 8; ++j) covariance[8 * i + j] += move[i] * move[j];
  }
}

/// Moves all sides from where they were found in grey levels to where light is expected to have
/// them: near enough for the last pass.
void go_to_light(const Optics& optics, QuadFit& fit) {
  const double middle = middle_of_light(optics.light, fit);
  const double shift = shift_of_middle * middle * fit.reach / reach_in_deviations;
  std::array<Side, 4> sides = sides_of(fit.ideal, fit.image);
  std::array<double, 4> moves{};
  double pixel = 0;
  for (unsigned i = 0; i < 4; ++i) moves[i] = shift * lay_in_picture(optics.lens, sides[i], pixel);
  for (unsigned i = 0; i < 4; ++i) {
    const unsigned before = (i + 3) % 4;
    fit.ideal[i] = fit.ideal[i] + moved(sides[before], sides[i], moves[before], moves[i]);
    fit.image[i] = distort(optics.lens, fit.ideal[i]);
  }
  fit.reach *= 1 - narrowing_of_middle * middle;
}

/// Adds what the strips of a side cannot see: a shift that all sides have in common, and one of
/// each.
void widen(const GeneralLens& lens, double common_shift, const QuadFitOptions& options,
           QuadFit& fit) {
  std::array<Side, 4> sides = sides_of(fit.ideal, fit.image);
  const double deviation = fit.reach / reach_in_deviations;
  std::array<double, 4> scale{};
  double pixel = 0, cell = clear_cell * deviation;
  for (unsigned i = 0; i < 4; ++i) {
    scale[i] = lay_in_picture(lens, sides[i], pixel);
    cell = std::min(cell, cell_at(sides[i], options) / scale[i]);
  }
  // A transition may have no width at all.
  const double rest = narrow_error * std::min(clear_cell * deviation - cell, deviation);
  const double shift = std::sqrt(common_shift * common_shift * deviation * deviation + rest * rest);
  const double own = std::sqrt(side_error * side_error * deviation * deviation + rest * rest);
  for (unsigned i = 0; i < 4; ++i) {
    const unsigned before = (i + 3) % 4, next = (i + 1) % 4;
    const Point both = moved(sides[before], sides[i], shift * scale[before], shift * scale[i]);
    fit.common[2 * i] = both.x;
    fit.common[2 * i + 1] = both.y;
    std::array<double, 8> one{};
    const Point from = moved(sides[before], sides[i], 0, own * scale[i]);
    const Point to = moved(sides[i], sides[next], own * scale[i], 0);
    one[2 * i] = from.x;
    one[2 * i + 1] = from.y;
    one[2 * next] = to.x;
    one[2 * next + 1] = to.y;
    add_product(fit.covariance, one);
  }
  add_product(fit.covariance, fit.common);
}

}  // namespace

QuadFit guess_through_optics(const CameraFrame& frame, const Quad& corners,
                             const QuadFitOptions& options, double smallest_cell) {
  const GeneralLens& lens = frame.optics->lens;
  QuadFit fit{};
  fit.image = corners;
  fit.refusal = Refusal::shape;
  std::uint32_t steps = 0;
  for (unsigned i = 0; i < 4; ++i) {
    if (!undistort(lens, corners[i], fit.ideal[i], steps)) return fit;
  }
  if (!is_convex_clockwise(fit.ideal)) return fit;
  double pixel = 0;
  for (Side& side : sides_of(fit.ideal, fit.image)) {
    const double cell = cell_at(side, options);
    if (!(cell >= smallest_cell * lay_in_picture(lens, side, pixel))) return fit;
  }
  fit.refusal = Refusal::none;
  return fit;
}

void find_through_optics(const CameraFrame& frame, const QuadFitOptions& options, FirstReach reach,
                         QuadFit& fit) {
  const FunctionScope scope(Function::quad_fit);
  if (fit.refusal != Refusal::none) return;
  const LitFrame grey = lit(frame, linear_light());
  FitEffort effort;
  const Quad guess = fit.image;
  fit.reach = reach == FirstReach::narrow ? narrow_reach : first_reach;
  for (unsigned pass = 0; pass < most_passes; ++pass) {
    const Quad before = fit.image;
    fit.refusal = improve(grey, options, Pass::coarse, effort, fit);
    if (fit.refusal == Refusal::none && !(farthest_move(fit.image, guess) <= most_move)) {
      fit.refusal = Refusal::shape;
    }
    if (fit.refusal != Refusal::none || farthest_move(fit.image, before) <= settled) break;
  }
  fit.dark /= grey_level_light;
  fit.bright /= grey_level_light;
  tell(effort, frame.in_dma_memory);
}

LightLevels refine_through_optics(const CameraFrame& frame, const QuadFitOptions& options,
                                  FoundIn place, QuadFit& fit) {
  const FunctionScope scope(Function::quad_fit);
  if (fit.refusal != Refusal::none) return {};
  const LitFrame light = lit(frame, frame.optics->light);
  // Its contrast was enough in grey levels; a curve may leave little of it.
  QuadFitOptions in_light = options;
  in_light.minimum_contrast = 1 / grey_level_light;
  FitEffort effort;
  const Quad found = fit.image;
  const double dark = fit.dark, bright = fit.bright;
  if (place == FoundIn::levels) go_to_light(*frame.optics, fit);
  const unsigned passes = place == FoundIn::levels ? 0 : passes_in_light;
  for (unsigned pass = 0; pass < passes && fit.refusal == Refusal::none; ++pass) {
    const Quad before = fit.image;
    fit.refusal = improve(light, in_light, Pass::coarse, effort, fit);
    if (farthest_move(fit.image, before) <= still) break;
  }
  if (fit.refusal == Refusal::none) fit.refusal = improve_last(light, in_light, effort, fit);
  if (fit.refusal == Refusal::none && !(farthest_move(fit.image, found) <= most_move)) {
    fit.refusal = Refusal::shape;
  }
  if (fit.refusal == Refusal::none && fit.raggedness > options.maximum_raggedness) {
    fit.refusal = Refusal::ragged;
  }
  tell(effort, frame.in_dma_memory);
  const LightLevels levels{fit.dark, fit.bright};
  fit.dark = dark;
  fit.bright = bright;
  if (fit.refusal == Refusal::none) {
    work(Work::lit_corners, 1);
    widen(frame.optics->lens, frame.optics->common_shift, options, fit);
  }
  return levels;
}

}  // namespace marker
