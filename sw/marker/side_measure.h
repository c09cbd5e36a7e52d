#pragma once

#include <marker/side_fit.h>
#include <marker/work.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

/// How a side is measured, for each kind of pixel and lens: part of side_fit.cpp and of
/// optics_side_fit.cpp.
namespace marker {
namespace {

// Internal to each source that includes this: neither's code depends on the other.

/// A lens bends a side by less than a twentieth of a pixel on so many lines.
constexpr double straight_lines = 32;
constexpr std::uint32_t most_pieces = 64;
/// Points farther out than any picture reaches are not followed, px.
constexpr double farthest = 16384;

/// A side that scatters by more may have something over a corner, px: by so much of its crossings
/// at either end, whose scatter is less than this share of all (measured).
constexpr double ragged_scatter = 0.1, hidden_end = 0.2, clear_scatter = 0.5;

/// Coordinates of a point along the strips of a side, and from strip to strip.
double along_strip(const Side& side, Point p) {
  return side.by_rows ? p.x : p.y;
}
double line_of(const Side& side, Point p) {
  return side.by_rows ? p.y : p.x;
}
Point on_strip(const Side& side, double line, double position) {
  return side.by_rows ? Point{position, line} : Point{line, position};
}

/// The rows or columns of a frame: pixel i of line k is at `pixels + i · pixel + k · line`.
template <class Kind>
struct Strips {
  typename Kind::Pixels pixels;
  std::ptrdiff_t pixel, line;
  std::uint32_t begin, end;            ///< of those that may be read
  std::uint32_t first_line, end_line;  ///< the same

  Strips(const typename Kind::Frame& frame, bool rows)
      : pixels(frame.image.pixels),
        pixel(rows ? 1 : frame.image.width),
        line(rows ? frame.image.width : 1),
        begin(rows ? frame.part.left : frame.part.top),
        end(rows ? frame.part.right : frame.part.bottom),
        first_line(rows ? frame.part.top : frame.part.left),
        end_line(rows ? frame.part.bottom : frame.part.right) {}
};

/// A strip and where its edge is.
template <class Pixels>
struct Crossing {
  Pixels pixels;              ///< of the first pixel that holds the transition
  std::uint32_t begin, size;  ///< px along the strip
  std::uint32_t line;
  double edge;            ///< px from `begin`
  double along, outward;  ///< px from the side's middle, and from the side
};

/// The mean of some grey values and how far single ones lie from it.
template <class Square>
struct Level {
  std::uint32_t sum = 0;
  Square squares = 0;
  std::uint32_t count = 0;

  void add(std::uint32_t value) {
    sum += value;
    squares += Square{value} * value;
    ++count;
  }
  double mean() const { return static_cast<double>(sum) / count; }
  /// Of the mean.
  double variance() const {
    if (count < 2) return 0;
    const double n = count, s = sum;
    return (static_cast<double>(squares) - s * s / n) / (n - 1) / n;
  }
};

/// Both grey levels of a side.
template <class Square>
struct Levels {
  Level<Square> dark, bright;

  double contrast() const { return bright.mean() - dark.mean(); }
};

/// Where the strips that stand on lines meet a side.
template <class AnyLens>
class Path {
 public:
  /// False if no line meets the side at least `reach` px from its neighbours, there or where the
  /// transition ends inside.
  bool find(const AnyLens& lens, const std::array<Side, 4>& sides, unsigned which, double reach,
            FitEffort& effort) {
    const Side& side = sides[which];
    const double half = reach / side.steepness;
    const Point inside = on_strip(side, 0, side.dark_first ? -half : half);
    const Point span = side.to_seen - side.from_seen;
    if constexpr (squeezes) reach = half * std::abs(along_strip(side, seen_outward(side)));
    const double from = line_of(side, side.from_seen), to = line_of(side, side.to_seen);
    const double ahead = distance_from(sides[(which + 3) % 4], span, inside, reach);
    const double behind = distance_from(sides[(which + 1) % 4], -1 * span, inside, reach);
    if (!(ahead + behind < 1)) return false;
    first_ = from + ahead * (to - from);
    last_ = to - behind * (to - from);
    if (first_ > last_) std::swap(first_, last_);
    start_ = from;
    nodes_[0] = along_strip(side, side.from_seen);
    pieces_ = 1;
    if (!lens.is_pinhole()) {
      pieces_ += static_cast<std::uint32_t>(std::abs(to - from) / straight_lines);
      if (pieces_ > most_pieces) pieces_ = most_pieces;
    }
    lines_ = (to - from) / pieces_;
    for (std::uint32_t i = 1; i < pieces_; ++i) {
      if (!meet_strip(lens, side, from + i * lines_, nodes_[i] = nodes_[i - 1], effort))
        return false;
    }
    nodes_[pieces_] = along_strip(side, side.to_seen);
    slope_ = (nodes_[1] - nodes_[0]) / lines_;
    for (std::uint32_t i = 0; i <= pieces_; ++i) {
      if (!(std::abs(nodes_[i]) < farthest)) return false;
    }
    return true;
  }

  double first() const { return first_; }
  double last() const { return last_; }

  /// px along the strip on that line, which is from first() to last().
  double at(double line) const {
    return pieces_ == 1 ? nodes_[0] + (line - start_) * slope_ : at_piece(line);
  }

 private:
  /// Ways in the picture are then not those of ideal points.
  static constexpr bool squeezes = !std::is_same_v<AnyLens, Lens>;

  /// As distance_from() a side that looks `outward` in the picture.
  static double share_before(Point outward, Point span, Point inside, double reach) {
    const double away = -dot(span, outward);
    return away > 0 ? (reach + std::max(dot(inside, outward), 0.0)) / away : 1;
  }

  /// As Side::outward, in the picture.
  static Point seen_outward(const Side& side) {
    const Point span = side.to_seen - side.from_seen;
    return 1 / std::sqrt(dot(span, span)) * Point{span.y, -span.x};
  }

  double at_piece(double line) const {
    const double place = (line - start_) / lines_;
    std::uint32_t piece = place > 0 ? static_cast<std::uint32_t>(place) : 0;
    if (piece >= pieces_) piece = pieces_ - 1;
    return nodes_[piece] + (place - piece) * (nodes_[piece + 1] - nodes_[piece]);
  }

  /// The share of a side next to a neighbour that is too near to it; `span` leads away from there.
  static double distance_from(const Side& neighbour, Point span, Point inside, double reach) {
    if constexpr (squeezes) return share_before(seen_outward(neighbour), span, inside, reach);
    const double away = -dot(span, neighbour.outward);
    if (!(away > 0)) return 1;
    const double nearer = dot(inside, neighbour.outward);
    return (reach + (nearer > 0 ? nearer : 0)) / away;
  }

  /// From a position near by; the slope of the straight side leads there in a few steps.
  static bool meet_strip(const AnyLens& lens, const Side& side, double line, double& position,
                         FitEffort& effort) {
    const double across = side.dark_first ? side.steepness : -side.steepness;
    for (unsigned step = 0; step < 4; ++step) {
      Point at{};
      if (!undistort(lens, on_strip(side, line, position), at, effort.lens_steps)) return false;
      position -= dot(at - side.from, side.outward) / across;
    }
    return true;
  }

  double first_, last_;
  double start_, lines_;  ///< lines of a piece, with the sign of their direction
  double slope_;          ///< of the first piece
  std::uint32_t pieces_;
  std::array<double, most_pieces + 1> nodes_;
};

/// Adds the pixels of a strip beyond a transition, but for the last one, if all lie in the range
/// from `least` on.
template <class Pixels, class Square>
void read_level(Pixels pixel, std::ptrdiff_t step, std::uint32_t count, std::uint32_t least,
                std::uint32_t range, Level<Square>& level, [[maybe_unused]] FitEffort& effort) {
  if (count == 0) return;
  std::uint32_t sum = 0, last = 0;
  Square squares = 0;
  for (std::uint32_t i = 0; i < count; ++i, pixel += step) {
    MARKERVP_COUNT(effort.level_pixels);
    last = *pixel;
    if (last - least > range) return;
    sum += last;
    squares += Square{last} * last;
  }
  level.sum += sum - last;
  level.squares += squares - Square{last} * last;
  level.count += count - 1;
}

/// What parts a transition from a step, times the way to it: the first moment about the edge of
/// pixels of which the first ones are on the side of level `before`.
template <class Pixels>
double moment(const Crossing<Pixels>& c, std::ptrdiff_t step, double before, double after) {
  const auto near = static_cast<std::uint32_t>(c.edge + 0.5);
  Pixels pixel = c.pixels;
  // Sums of the grey values, and of them times twice the way of the pixel from the first one's
  // edge.
  std::uint32_t sum = 0, way = 0, sum_after = 0, way_after = 0;
  for (std::uint32_t i = 0; i < near; ++i, pixel += step) {
    sum += *pixel;
    way += *pixel * (2 * i + 1);
  }
  for (std::uint32_t i = near; i < c.size; ++i, pixel += step) {
    sum_after += *pixel;
    way_after += *pixel * (2 * i + 1);
  }
  const double n = near, size = c.size, rest = size - n;
  const double first = c.edge * (sum - n * before) - (way - before * n * n) / 2;
  const double last =
      (after * (n + size) * rest - way_after) / 2 - c.edge * (after * rest - sum_after);
  return first + last;
}

/// The least-squares line through `count` crossings, none of which is known better than to a
/// variance of `least_variance`, px². `along` is counted from the middle, so the sums lose nothing.
template <class Pixels>
EdgeLine fit_line(const Crossing<Pixels>* crossings, std::uint32_t count, double least_variance) {
  double t = 0, e = 0, tt = 0, te = 0, ee = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double along = crossings[i].along, outward = crossings[i].outward;
    t += along;
    e += outward;
    tt += along * along;
    te += along * outward;
    ee += outward * outward;
  }
  const double n = count;
  t /= n;
  e /= n;
  tt -= n * t * t;
  te -= n * t * e;
  ee -= n * e * e;
  EdgeLine line{};
  line.slope = te / tt;
  line.offset = e - line.slope * t;
  const double left = ee - line.slope * te;
  double variance = left / (n - 2);
  if (!(variance > least_variance)) variance = least_variance;
  line.scatter = std::sqrt(variance);
  line.slope_variance = variance / tt;
  line.covariance = -t * line.slope_variance;
  line.offset_variance = variance / n + t * t * line.slope_variance;
  return line;
}

/// Leaves out crossings that lie more than `limit` px from the line. Returns how many are left.
template <class Pixels>
std::uint32_t keep_near(Crossing<Pixels>* crossings, std::uint32_t count, const EdgeLine& line,
                        double limit) {
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Crossing<Pixels>& c = crossings[i];
    if (!(std::abs(c.outward - line.offset - line.slope * c.along) <= limit)) continue;
    if (kept != i) crossings[kept] = c;
    ++kept;
  }
  return kept;
}

/// `Kind` says what a pixel is read as, and the type of the lens.
template <class Kind>
class SideFit {
 public:
  using AnyLens = typename Kind::AnyLens;
  using Pixels = typename Kind::Pixels;

  SideFit(const typename Kind::Frame& frame, const Side& side, FitEffort& effort)
      : lens_(frame.lens), side_(side), strips_(frame, side.by_rows), effort_(effort) {}

  Refusal fit(const Path<AnyLens>& path, const FitPass& pass, const QuadFitOptions& options,
              EdgeLine& line) {
    collect(path, pass);
    MARKERVP_ADD(effort_.strips, count_);
    if (!is_covered(count_, pass, options)) return Refusal::hidden;
    const AllLevels levels = read_levels(pass.depth / side_.steepness, pass.level_pixels);
    double least_contrast = options.minimum_contrast;
    if constexpr (Kind::of_a_level != 1) least_contrast *= Kind::of_a_level;
    if (!(levels.contrast() >= least_contrast)) return Refusal::contrast;
    const double pixels = crossings_[0].size;
    const std::uint32_t located = locate_all(levels);
    if (!is_covered(located, pass, options)) return Refusal::hidden;
    // Grey levels are whole numbers: each is off by a variance of 1/12.
    const double per_level = side_.steepness / levels.contrast();
    double rounding = pixels / 12 * per_level * per_level;
    if constexpr (Kind::of_a_level != 1) rounding *= Kind::of_a_level * Kind::of_a_level;
    line = fit_line(crossings_.data(), located, rounding);
    if (line.scatter > ragged_scatter) leave_ends_out(located, rounding, line);
    const double limit = line.scatter > 0.02 ? 3 * line.scatter : 0.06;
    const std::uint32_t kept = keep_near(crossings_.data(), located, line, limit);
    if (!is_covered(kept, pass, options)) return Refusal::ragged;
    if (kept < located) {
      MARKERVP_ADD(effort_.refitted, kept);
      line = fit_line(crossings_.data(), kept, rounding);
    }
    if (!pass.is_last) line.transition = transition(kept, levels);
    // A level that is off shifts the whole side.
    const double lever = pixels / 2 * per_level;
    line.offset_variance += lever * lever * (levels.dark.variance() + levels.bright.variance());
    line.dark = levels.dark.mean();
    line.bright = levels.bright.mean();
    return Refusal::none;
  }

 private:
  using Square = typename Kind::Square;
  using AllLevels = Levels<Square>;

  /// The strips around the path, with the pixels that hold their transitions. One more on each
  /// side, which tells the level, must be there, too.
  void collect(const Path<AnyLens>& path, const FitPass& pass) {
    const double low = std::max<double>(path.first() + 0.5, strips_.first_line);
    const double high = std::min<double>(path.last() - 0.5, strips_.end_line - 1.0);
    if (!(high >= low)) return;
    const auto first = static_cast<std::uint32_t>(low), last = static_cast<std::uint32_t>(high);
    step_ = (last - first) / pass.crossings + 1;
    // Of a pixel.
    constexpr std::int32_t whole = 65536;
    const auto half = static_cast<std::int32_t>(pass.reach / side_.steepness * whole);
    const auto least = static_cast<std::int32_t>((strips_.begin + 1) * whole);
    const auto end = static_cast<std::int32_t>((strips_.end - 1) * whole);
    Pixels pixels = strips_.pixels + strips_.line * std::ptrdiff_t(first);
    for (std::uint32_t i = first; i <= last && count_ < most_crossings;
         i += step_, pixels += strips_.line * std::ptrdiff_t(step_)) {
      const auto position = static_cast<std::int32_t>(path.at(i + 0.5) * whole);
      if (position - half < least || position + half >= end) continue;
      Crossing<Pixels>& c = crossings_[count_++];
      c.begin = static_cast<std::uint32_t>(position - half) / whole;
      c.size = static_cast<std::uint32_t>(position + half) / whole + 1 - c.begin;
      c.line = i;
      c.pixels = pixels + strips_.pixel * std::ptrdiff_t(c.begin);
    }
  }

  /// True if the edge was seen on enough of the side, its ends at the corners left out.
  bool is_covered(std::uint32_t count, const FitPass& pass, const QuadFitOptions& options) const {
    double lines = side_.length * side_.steepness - 4 * pass.reach;
    if constexpr (Kind::Frame::may_squeeze) {
      lines = std::abs(line_of(side_, side_.to_seen) - line_of(side_, side_.from_seen)) -
              4 * pass.reach / side_.steepness;
    }
    return count >= least_crossings && count * step_ >= options.minimum_coverage * lines;
  }

  /// Of the pixels up to `depth` px along a strip beyond the transitions, or where those do not
  /// stay dark (bright), of the nearest ones.
  AllLevels read_levels(double depth, std::uint32_t most_pixels) {
    const auto wanted = static_cast<std::uint32_t>(depth) + 1;
    const std::uint32_t step = count_ * wanted / most_pixels + 1;
    Level<Square> first, last;
    for (std::uint32_t i = 0; i < count_; i += step) {
      const Crossing<Pixels>& c = crossings_[i];
      first.add(c.pixels[0]);
      last.add(c.pixels[strips_.pixel * std::ptrdiff_t(c.size - 1)]);
    }
    const AllLevels near = side_.dark_first ? AllLevels{first, last} : AllLevels{last, first};
    const double eighth = near.contrast() / 8;
    if (!(eighth > 0)) return near;
    const auto most_dark = static_cast<std::uint32_t>(near.dark.mean() + eighth);
    const auto least_bright = static_cast<std::uint32_t>(near.bright.mean() - eighth) + 1;
    AllLevels deep;
    Level<Square>& before = side_.dark_first ? deep.dark : deep.bright;
    Level<Square>& behind = side_.dark_first ? deep.bright : deep.dark;
    const std::uint32_t dark_range = most_dark, bright_range = Kind::white - least_bright;
    for (std::uint32_t i = 0; i < count_; i += step) {
      MARKERVP_COUNT(effort_.level_reads);
      const Crossing<Pixels>& c = crossings_[i];
      const std::uint32_t end = c.begin + c.size;
      const std::uint32_t ahead = std::min(wanted, c.begin - strips_.begin);
      const std::uint32_t after = std::min(wanted, strips_.end - end);
      read_level(c.pixels - strips_.pixel, -strips_.pixel, ahead,
                 side_.dark_first ? 0 : least_bright, side_.dark_first ? dark_range : bright_range,
                 before, effort_);
      read_level(c.pixels + strips_.pixel * std::ptrdiff_t(c.size), strips_.pixel, after,
                 side_.dark_first ? least_bright : 0, side_.dark_first ? bright_range : dark_range,
                 behind, effort_);
    }
    // A cell of the code next to the border may be white all along a side.
    if (deep.dark.count < least_crossings) deep.dark = near.dark;
    if (deep.bright.count < least_crossings) deep.bright = near.bright;
    return deep;
  }

  /// Leaves out those without an edge. Returns how many have one.
  std::uint32_t locate_all(const AllLevels& levels) {
    const double bright = levels.bright.mean(), per_level = 1 / levels.contrast();
    const AnyLens* const lens = lens_.is_pinhole() ? nullptr : &lens_;
    MARKERVP_ADD(effort_.crossings, count_);
    std::uint32_t located = 0;
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (located != i) crossings_[located] = crossings_[i];
      if (locate(lens, bright, per_level, crossings_[located])) ++located;
    }
    return located;
  }

  /// Where the edge crosses: as many pixels are dark as the sum says. False if that is outside.
  /// No `lens`: a pinhole.
  bool locate(const AnyLens* lens, double bright, double per_level, Crossing<Pixels>& c) {
    std::uint32_t sum = 0;
    Pixels pixel = c.pixels;
    for (std::uint32_t i = 0; i < c.size; ++i, pixel += strips_.pixel) sum += *pixel;
    const double size = c.size;
    const double dark = (bright * size - sum) * per_level;
    if (!(dark > 0 && dark < size)) return false;
    c.edge = side_.dark_first ? dark : size - dark;
    Point at = on_strip(side_, c.line + 0.5, c.begin + c.edge);
    if (lens != nullptr && !undistort(*lens, Point(at), at, effort_.lens_steps)) return false;
    const Point off = at - side_.middle;
    c.along = dot(off, side_.along);
    c.outward = dot(off, side_.outward);
    return true;
  }

  /// What hides a corner pulls the ends of both its sides. Where the inner crossings lie much
  /// nearer to a line of their own than all do to theirs, that line counts.
  void leave_ends_out(std::uint32_t located, double rounding, EdgeLine& line) {
    const auto end = static_cast<std::uint32_t>(hidden_end * located);
    const std::uint32_t inner = located - 2 * end;
    if (inner < least_crossings) return;
    MARKERVP_ADD(effort_.refitted, inner);
    const EdgeLine own = fit_line(crossings_.data() + end, inner, rounding);
    if (own.scatter < clear_scatter * line.scatter) line = own;
  }

  /// The variance of a transition is twice its moment.
  double transition(std::uint32_t count, const AllLevels& levels) {
    MARKERVP_ADD(effort_.transitions, count);
    const double dark = levels.dark.mean(), bright = levels.bright.mean();
    const double before = side_.dark_first ? dark : bright;
    const double after = side_.dark_first ? bright : dark;
    double sum = 0;
    for (std::uint32_t i = 0; i < count; ++i)
      sum += moment(crossings_[i], strips_.pixel, before, after);
    const double variance =
        2 * sum / (count * (after - before)) * side_.steepness * side_.steepness;
    return variance > 0 ? variance : 0;
  }

  const AnyLens& lens_;
  const Side& side_;
  const Strips<Kind> strips_;
  FitEffort& effort_;
  std::array<Crossing<Pixels>, most_crossings> crossings_;
  std::uint32_t count_ = 0;
  std::uint32_t step_ = 1;
};

}  // namespace
}  // namespace marker
