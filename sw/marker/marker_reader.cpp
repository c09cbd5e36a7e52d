#include <marker/board_pose.h>
#include <marker/marker_reader.h>
#include <marker/optics.h>
#include <marker/optics_fit.h>
#include <marker/rectification.h>
#include <marker/work.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace marker {
namespace {

/// A cell is looked at in its middle and so far from it, shares of its side: blur and neighbours
/// reach less far.
constexpr double spread = 0.2;
constexpr std::uint32_t samples = 9;
constexpr std::uint32_t white = 255;
/// Shares of a cell: by so much corners may be off before its nine places leave it.
constexpr double most_shift = 0.15;
/// A cell that is hardly darker or brighter than the middle between both levels makes no word of a
/// dictionary of which chance makes words, too. Of what is no marker and reads as one, the least
/// clear cell has 0.03 to 0.13; of a hundredth of the markers, less than 0.15 (measured: 303
/// pictures without a marker, 42 of boards).
constexpr double least_margin = 0.14;
/// But cells narrower than so many reaches of an edge are unclear in any marker.
constexpr double clear_cell = 3;
/// Cells that are narrower still cannot be read, px; and so far off, in x and in y, are the corners
/// of such an outline (measured).
constexpr double least_narrow_cell = 0.6, narrow_deviation = 0.3;

/// A cell in the picture: its middle, and the ways to the places right and below. Perspective and
/// lens bend nothing within a cell that matters.
struct Cell {
  Point middle, right, down;
};

/// Through a lens, from where a pinhole camera would see it.
template <class AnyLens>
Cell seen_through(const AnyLens& lens, const Cell& ideal) {
  Cell seen = ideal;
  seen.middle = distort(lens, ideal.middle);
  seen.right = distort(lens, ideal.middle + ideal.right) - seen.middle;
  seen.down = distort(lens, ideal.middle + ideal.down) - seen.middle;
  return seen;
}

/// The sum of the grey values of the pixels at the nine places; what lies outside is white.
std::uint32_t sum_of(const Cell& cell, const CameraFrame& frame) {
  const Box& part = frame.part;
  const double reach_x = std::abs(cell.right.x) + std::abs(cell.down.x);
  const double reach_y = std::abs(cell.right.y) + std::abs(cell.down.y);
  const Point first = cell.middle - cell.right - cell.down;
  std::uint32_t sum = 0;
  // The hundredth of a pixel is for what the steps below are rounded by.
  if (cell.middle.x - reach_x > part.left + 0.01 && cell.middle.x + reach_x < part.right - 0.01 &&
      cell.middle.y - reach_y > part.top + 0.01 && cell.middle.y + reach_y < part.bottom - 0.01) {
    constexpr double whole = 65536;
    const auto fixed = [](double value) { return static_cast<std::int32_t>(value * whole); };
    const std::int32_t right_x = fixed(cell.right.x), right_y = fixed(cell.right.y);
    const std::int32_t back_x = fixed(cell.down.x) - 3 * right_x;
    const std::int32_t back_y = fixed(cell.down.y) - 3 * right_y;
    std::uint32_t x = fixed(first.x), y = fixed(first.y);
    for (unsigned row = 0; row < 3; ++row, x += back_x, y += back_y) {
      for (unsigned column = 0; column < 3; ++column, x += right_x, y += right_y) {
        sum += frame.image.pixels[(y >> 16) * frame.image.width + (x >> 16)];
      }
    }
    return sum;
  }
  for (unsigned i = 0; i < samples; ++i) {
    // Whole rows. NOLINTNEXTLINE(bugprone-integer-division)
    const Point p = first + (i % 3) * cell.right + static_cast<double>(i / 3) * cell.down;
    const bool inside =
        p.x >= part.left && p.x < part.right && p.y >= part.top && p.y < part.bottom;
    sum +=
        inside
            ? frame.image.pixels[std::size_t{static_cast<std::uint32_t>(p.y)} * frame.image.width +
                                 static_cast<std::uint32_t>(p.x)]
            : white;
  }
  return sum;
}

/// Squared, px².
double distance(Point a, Point b) {
  return dot(b - a, b - a);
}

/// True if cells that were looked at in one quadrilateral are still those of another.
bool are_same_cells(const Quad& one, const Quad& other, std::uint32_t side) {
  double farthest = 0, shortest = distance(one[3], one[0]);
  for (unsigned i = 0; i < 4; ++i) {
    farthest = std::max(farthest, distance(one[i], other[i]));
    if (i != 0) shortest = std::min(shortest, distance(one[i - 1], one[i]));
  }
  const double most = most_shift / side;
  return farthest <= most * most * shortest;
}

/// The sums of the darkest cell and of the brightest.
std::array<std::uint32_t, 2> extremes_of(const CellLook& look) {
  const auto end = look.sums.begin() + (look.cells + 2) * (look.cells + 2);
  const auto [least, most] = std::minmax_element(look.sums.begin(), end);
  return {*least, *most};
}

/// The mean grey levels of black cells and of white ones, in a few steps from the extremes.
void part_levels(const CellLook& look, double& dark, double& bright) {
  constexpr unsigned steps = 3;
  const std::uint32_t cells = (look.cells + 2) * (look.cells + 2);
  auto [low, high] = extremes_of(look);
  for (unsigned step = 0; step < steps; ++step) {
    const std::uint32_t limit = (low + high) / 2;
    std::uint32_t below = 0, above = 0, count = 0;
    for (std::uint32_t i = 0; i < cells; ++i) {
      const bool is_dark = look.sums[i] <= limit;
      (is_dark ? below : above) += look.sums[i];
      if (is_dark) ++count;
    }
    low = below / count;
    high = above / (cells - count);
  }
  dark = static_cast<double>(low) / samples;
  bright = static_cast<double>(high) / samples;
}

}  // namespace

CellLook look_at_cells(const CameraFrame& frame, const Quad& corners, std::uint32_t cells) {
  const FunctionScope scope(Function::cell_reading);
  CellLook look;
  look.cells = cells;
  const std::uint32_t side = cells + 2;
  const Homography h = make_homography({corners[0], corners[1], corners[3], corners[2]}, side);
  // The frame's own lens, or one that it does not say.
  const GeneralLens* const lens = frame.optics == nullptr ? nullptr : &frame.optics->lens;
  const bool is_pinhole = lens == nullptr ? frame.lens.is_pinhole() : lens->is_pinhole();
  std::uint32_t* sum = look.sums.data();
  for (std::uint32_t row = 0; row < side; ++row) {
    const double v = row + 0.5, x = h.h2 * v + h.u1, y = h.h5 * v + h.v1, depth = h.h8 * v + 1;
    for (std::uint32_t column = 0; column < side; ++column) {
      const double u = column + 0.5, scale = 1 / (h.h7 * u + depth), step = spread * scale;
      const Point middle{(h.h1 * u + x) * scale, (h.h4 * u + y) * scale};
      const Cell cell{middle,
                      {(h.h1 - middle.x * h.h7) * step, (h.h4 - middle.y * h.h7) * step},
                      {(h.h2 - middle.x * h.h8) * step, (h.h5 - middle.y * h.h8) * step}};
      *sum++ = sum_of(is_pinhole        ? cell
                      : lens == nullptr ? seen_through(frame.lens, cell)
                                        : seen_through(*lens, cell),
                      frame);
    }
  }
  work(Work::codes_read, 1);
  work(Work::code_cells, std::uint64_t{side} * side);
  if (!is_pinhole && lens == nullptr) work(Work::lens_steps, std::uint64_t{3} * side * side);
  return look;
}

bool is_plain(const CellLook& look, double minimum_contrast) {
  const auto [least, most] = extremes_of(look);
  return most - least < minimum_contrast / 2 * samples;
}

CellReading read_cells(const CellLook& look, double dark, double bright) {
  const std::uint32_t side = look.cells + 2;
  const double limit = (dark + bright) / 2 * samples;
  CellReading reading{};
  const std::uint32_t* sum = look.sums.data();
  double nearest = limit;
  for (std::uint32_t row = 0; row < side; ++row) {
    for (std::uint32_t column = 0; column < side; ++column) {
      nearest = std::min(nearest, std::abs(*sum - limit));
      const bool black = *sum++ < limit;
      if (row == 0 || column == 0 || row + 1 == side || column + 1 == side) {
        if (!black) ++reading.white_border;
      } else {
        reading.word = reading.word << 1 | (black ? 1 : 0);
      }
    }
  }
  reading.margin = bright > dark ? nearest / ((bright - dark) / 2 * samples) : 0;
  return reading;
}

namespace {

QuadFitOptions fit_options(const DetectionOptions& options, std::uint32_t cells) {
  QuadFitOptions fit = options.fit;
  fit.cells = cells + 2;
  return fit;
}

/// True if the frame's own lens is not the whole truth.
bool has_other_lens(const CameraFrame& frame) {
  return frame.optics != nullptr && frame.optics->lens.model != LensModel::brown_conrady;
}

/// True if random cells are a word of that dictionary more often than can be put up with.
bool is_likely_by_chance(const CodeBook& book) {
  return book.exact_false_share() > tolerable_false_share;
}

/// True if cells are so narrow that single ones do not reach the levels of the sides.
bool are_cells_blurred(const QuadFit& fit, std::uint32_t side) {
  double shortest = distance(fit.ideal[3], fit.ideal[0]);
  for (unsigned i = 1; i < 4; ++i)
    shortest = std::min(shortest, distance(fit.ideal[i - 1], fit.ideal[i]));
  const double clear = clear_cell * fit.reach * side;
  return shortest < clear * clear;
}

/// From corners that were found to a marker's word. `look`: of the corners in `guessed`.
Refusal read_word(const CameraFrame& frame, const QuadFit& fit, const Quad& guessed,
                  const CodeBook& book, const DetectionOptions& options, CellLook& look,
                  CodeBook::Match& match) {
  const std::uint32_t cells = book.dictionary().cells;
  if (!are_same_cells(fit.ideal, guessed, cells + 2)) look = look_at_cells(frame, fit.ideal, cells);
  const CellReading reading = read_cells(look, fit.dark, fit.bright);
  if (reading.white_border > options.white_border) return Refusal::border;
  match = book.look_up(reading.word);
  const bool is_word = match.found && (match.corrected == 0 || !options.exact) &&
                       (reading.margin >= least_margin || !is_likely_by_chance(book) ||
                        are_cells_blurred(fit, cells + 2));
  return is_word ? Refusal::none : Refusal::unknown;
}

/// All edges of a marker of that ID, with the optics of the frame. `fit`: found, and `rotation`
/// quarters before its own top left.
Refusal measure(const CameraFrame& frame, const Dictionary& dictionary,
                const DetectionOptions& options, FoundIn place, QuadFit& fit, unsigned rotation,
                DetectedMarker& marker) {
  const QuadFitOptions all = fit_options(options, dictionary.cells);
  LightLevels levels{};
  if (frame.optics == nullptr) {
    refine_quad(frame, all, fit);
  } else {
    levels = refine_through_optics(frame, all, place, fit);
  }
  if (fit.refusal != Refusal::none) return fit.refusal;
  marker.fit = counted_from(fit, rotation);
  marker.inner = {};
  if (frame.optics != nullptr && frame.optics->seeks_response) {
    marker.inner = measure_inner_edges(frame, marker.fit, levels, dictionary.words[marker.id],
                                       dictionary.cells);
  }
  return Refusal::none;
}

}  // namespace

Refusal read_marker(const CameraFrame& frame, const Quad& guess, const CodeBook& book,
                    const DetectionOptions& options, DetectedMarker& marker) {
  const std::uint32_t cells = book.dictionary().cells;
  const QuadFitOptions all = fit_options(options, cells);
  const bool other_lens = has_other_lens(frame);
  const QuadFit guessed = other_lens ? guess_through_optics(frame, guess, all, least_cell)
                                     : guess_quad(frame.lens, guess, all);
  if (guessed.refusal != Refusal::none) return guessed.refusal;
  CellLook look = look_at_cells(frame, guessed.ideal, cells);
  if (frame.in_dma_memory) work(Work::code_cells_dma, std::uint64_t{cells + 2} * (cells + 2));
  if (is_plain(look, all.minimum_contrast)) return Refusal::plain;
  QuadFit fit = guessed;
  if (other_lens) {
    find_through_optics(frame, all, FirstReach::wide, fit);
  } else {
    find_quad(frame, all, fit);
  }
  CodeBook::Match match{};
  Refusal refusal = fit.refusal;
  if (refusal == Refusal::none) {
    refusal = read_word(frame, fit, guessed.ideal, book, options, look, match);
  }
  if (refusal != Refusal::none && frame.optics != nullptr && frame.optics->tries_again) {
    fit = guessed;
    find_through_optics(frame, all, FirstReach::narrow, fit);
    if (fit.refusal != Refusal::none) return refusal;
    look = look_at_cells(frame, fit.ideal, cells);
    if (read_word(frame, fit, fit.ideal, book, options, look, match) != Refusal::none) {
      return refusal;
    }
    refusal = Refusal::none;
  }
  if (refusal != Refusal::none) return refusal;
  marker.id = match.id;
  marker.corrected = match.corrected;
  marker.part = frame.part;
  // Only what is a marker is worth all of its edges. Turned by r quarters, its own top left is the
  // r-th corner clockwise from the first.
  return measure(frame, book.dictionary(), options, FoundIn::levels, fit, match.rotation, marker);
}

Refusal read_narrow_marker(const CameraFrame& frame, const Quad& corners, const CodeBook& book,
                           const DetectionOptions& options, DetectedMarker& marker) {
  const std::uint32_t cells = book.dictionary().cells;
  if (is_likely_by_chance(book)) return Refusal::unknown;
  const QuadFitOptions all = fit_options(options, cells);
  QuadFit fit = guess_through_optics(frame, corners, all, least_narrow_cell);
  if (fit.refusal != Refusal::none) return fit.refusal;
  const CellLook look = look_at_cells(frame, fit.ideal, cells);
  if (frame.in_dma_memory) work(Work::code_cells_dma, std::uint64_t{cells + 2} * (cells + 2));
  if (is_plain(look, all.minimum_contrast)) return Refusal::plain;
  part_levels(look, fit.dark, fit.bright);
  const CellReading reading = read_cells(look, fit.dark, fit.bright);
  if (reading.white_border > options.white_border) return Refusal::border;
  const CodeBook::Match match = book.look_up(reading.word);
  if (!match.found || match.corrected > 0) return Refusal::unknown;
  fit.covariance = independent_corners(narrow_deviation);
  marker = {match.id, 0, counted_from(fit, match.rotation), frame.part, {}};
  return Refusal::none;
}

bool measure_again(const CameraFrame& frame, const Dictionary& dictionary,
                   const DetectionOptions& options, DetectedMarker& marker) {
  CameraFrame near = frame;
  near.part = marker.part;
  QuadFit fit = marker.fit;
  return measure(near, dictionary, options, FoundIn::light, fit, 0, marker) == Refusal::none;
}

Refusal detect_marker(const CameraFrame& frame, const Extremes& blob, const CodeBook& book,
                      const DetectionOptions& options, DetectedMarker& marker) {
  Quad guess{};
  if (!largest_quad(blob, guess)) return Refusal::shape;
  return read_marker(frame, guess, book, options, marker);
}

}  // namespace marker
