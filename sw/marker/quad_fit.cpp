#include <marker/quad_fit.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace marker {
namespace {

constexpr Point operator+(Point a, Point b) {
  return {a.x + b.x, a.y + b.y};
}
constexpr Point operator-(Point a, Point b) {
  return {a.x - b.x, a.y - b.y};
}
constexpr Point operator*(double s, Point a) {
  return {s * a.x, s * a.y};
}
constexpr double dot(Point a, Point b) {
  return a.x * b.x + a.y * b.y;
}

/// Around a side that is a guess, so far the edge is looked for, px across it.
constexpr double first_reach = 3.2;
/// Then an edge is measured so many standard deviations of its transition to both sides, but not
/// less than the half pixel that every edge takes. Wider costs accuracy (each pixel adds its
/// noise), narrower makes the blur show.
constexpr double reach_in_deviations = 2.5;
/// For what the place of the edge is off in the pass before, px.
constexpr double slack = 0.05;
/// A marker with smaller cells is too small, px.
constexpr double least_cell = 1.5;
/// So deep beyond the transition a grey level is read, px across the edge: as far as the border's
/// cell goes, but not less than the first, which tells whether the code's cell is black, too.
constexpr double least_depth = 3;
constexpr double most_depth = 10;
/// The corners are fitted so often, each time around where they were found before.
constexpr unsigned passes = 4;
/// A corner that leaves its guess by more belongs to something else, px.
constexpr double most_move = 6;
/// A side with fewer crossings is not measured.
constexpr std::uint32_t least_crossings = 6;
/// So many crossings of a side are used; longer ones leave rows out.
constexpr std::uint32_t most_crossings = 256;

/// Where grey values come from: the rows and columns of `image`, or `sides` where it has no pixels.
struct Source {
  GreyImage image;
  const std::array<SideSupport, 4>* sides;
};

/// Between two corners of the quadrilateral, in ideal px.
struct Side {
  Point from, to, along, outward;
  double length;
  double height;     ///< of the quadrilateral over this side, at its lower end
  bool by_rows;      ///< rows cross it
  double steepness;  ///< px across the edge for one px along a strip
};

/// A strip and where its edge is expected.
struct Crossing {
  Strip strip;
  double position;           ///< px along the strip: expected, then found
  std::uint32_t begin, end;  ///< the pixels that hold the transition
  bool dark_first;           ///< the dark side has the lower coordinates
  double along, outward;     ///< what was found: px from the side's middle, and from the side
};

/// A line near a side: outward = offset + slope · along.
struct Line {
  double offset, slope;
  double offset_variance, covariance, slope_variance;
  double scatter;     ///< px
  double transition;  ///< variance of the way from dark to bright, px²
  double dark, bright;
};

/// The mean of some grey values and how far single ones lie from it.
struct Level {
  double sum = 0, squares = 0;
  double count = 0;

  void add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  double mean() const { return sum / count; }
  /// Of the mean.
  double variance() const {
    return count < 2 ? 0 : (squares - sum * sum / count) / (count - 1) / count;
  }
};

std::array<Side, 4> sides_of(const Source& source, const Quad& quad) {
  std::array<Side, 4> sides{};
  for (unsigned i = 0; i < 4; ++i) {
    Side& side = sides[i];
    side.from = quad[i];
    side.to = quad[(i + 1) % 4];
    const Point span = side.to - side.from;
    side.length = std::sqrt(dot(span, span));
    side.along = (1 / side.length) * span;
    side.outward = {side.along.y, -side.along.x};
    const double one = dot(side.from - quad[(i + 2) % 4], side.outward);
    const double other = dot(side.from - quad[(i + 3) % 4], side.outward);
    side.height = one < other ? one : other;
    side.by_rows = source.image.pixels != nullptr ? std::abs(span.y) >= std::abs(span.x)
                                                  : (*source.sides)[i].rows;
    side.steepness = std::abs(side.by_rows ? side.outward.x : side.outward.y);
  }
  return sides;
}

Point on_strip(const Strip& strip, bool by_rows, double position) {
  return by_rows ? Point{position, strip.line + 0.5} : Point{strip.line + 0.5, position};
}

/// Looks where a strip meets a side. False if it does not, or not far enough from other edges.
bool expect(const Lens& lens, const std::array<Side, 4>& sides, unsigned which, double reach,
            Crossing& crossing) {
  const Side& side = sides[which];
  const Side& before = sides[(which + 3) % 4];
  const Side& after = sides[(which + 1) % 4];
  const double across = side.by_rows ? side.outward.x : side.outward.y;
  const Point middle = distort(lens, 0.5 * (side.from + side.to));
  double position = side.by_rows ? middle.x : middle.y;
  Point at{};
  // A lens bends the side a little: the slope of the straight one leads there in a few steps.
  const unsigned steps = lens.is_pinhole() ? 1 : 4;
  for (unsigned step = 0; step < steps; ++step) {
    if (!undistort(lens, on_strip(crossing.strip, side.by_rows, position), at)) return false;
    position -= dot(at - side.from, side.outward) / across;
  }
  if (!undistort(lens, on_strip(crossing.strip, side.by_rows, position), at)) return false;
  const double half = reach / side.steepness;
  // Where the transition ends inside, other edges must be as far as this one.
  crossing.dark_first = across > 0;
  const double inwards = crossing.dark_first ? -half : half;
  const Point inside = at + (side.by_rows ? Point{inwards, 0} : Point{0, inwards});
  for (const Point p : {at, inside}) {
    if (dot(p - before.to, before.outward) > -reach ||
        dot(p - after.from, after.outward) > -reach) {
      return false;
    }
  }
  const Strip& strip = crossing.strip;
  if (!(position - half >= strip.first && position + half <= strip.first + strip.size))
    return false;
  crossing.position = position;
  crossing.begin = static_cast<std::uint32_t>(position - half);
  crossing.end = static_cast<std::uint32_t>(position + half) + 1;
  // One pixel more on each side tells the level.
  return crossing.begin > strip.first && crossing.end < strip.first + strip.size;
}

std::uint32_t grey(const Strip& strip, std::uint32_t position) {
  return strip.pixels[std::size_t{position - strip.first} * strip.stride];
}

/// Adds the pixels beyond the transition on one side, if all of them, and one more, are on the same
/// side of `limit`.
void read_level(const Crossing& crossing, bool dark, double depth, double limit, Level& level) {
  const Strip& strip = crossing.strip;
  const bool below = dark == crossing.dark_first;
  const std::uint32_t room =
      below ? crossing.begin - strip.first : strip.first + strip.size - crossing.end;
  const auto wanted = static_cast<std::uint32_t>(depth) + 1;
  const std::uint32_t count = room < wanted ? room : wanted;
  const auto at = [&](std::uint32_t i) {
    return grey(strip, below ? crossing.begin - 1 - i : crossing.end + i);
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    if (dark ? at(i) > limit : at(i) < limit) return;
  }
  for (std::uint32_t i = 0; i + 1 < count; ++i) level.add(at(i));
}

/// Both grey levels of a side.
struct Levels {
  Level dark, bright;

  double contrast() const { return bright.mean() - dark.mean(); }
};

Levels read_levels(const Crossing* crossings, std::uint32_t count, double depth) {
  Levels near;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Crossing& c = crossings[i];
    (c.dark_first ? near.dark : near.bright).add(grey(c.strip, c.begin));
    (c.dark_first ? near.bright : near.dark).add(grey(c.strip, c.end - 1));
  }
  const double eighth = near.contrast() / 8;
  Levels deep;
  for (std::uint32_t i = 0; i < count; ++i) {
    read_level(crossings[i], true, depth, near.dark.mean() + eighth, deep.dark);
    read_level(crossings[i], false, depth, near.bright.mean() - eighth, deep.bright);
  }
  // A cell of the code next to the border may be white all along a side.
  if (deep.dark.count < least_crossings) deep.dark = near.dark;
  if (deep.bright.count < least_crossings) deep.bright = near.bright;
  return deep;
}

/// Where the edge crosses: as many pixels are dark as the sum says. False if that is outside.
bool locate(const Lens& lens, const Side& side, const Levels& levels, Crossing& c) {
  std::uint32_t sum = 0;
  for (std::uint32_t i = c.begin; i < c.end; ++i) sum += grey(c.strip, i);
  const double bright = levels.bright.mean(), size = c.end - c.begin;
  const double dark = (bright * size - sum) / (bright - levels.dark.mean());
  if (!(dark > 0 && dark < size)) return false;
  c.position = c.dark_first ? c.begin + dark : c.end - dark;
  Point at{};
  if (!undistort(lens, on_strip(c.strip, side.by_rows, c.position), at)) return false;
  const Point off = at - 0.5 * (side.from + side.to);
  c.along = dot(off, side.along);
  c.outward = dot(off, side.outward);
  return true;
}

/// The variance of a transition is twice the first moment of what parts it from a step.
double transition_variance(const Crossing* crossings, std::uint32_t count, const Side& side,
                           const Levels& levels) {
  const double dark = levels.dark.mean(), bright = levels.bright.mean();
  double moment = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Crossing& c = crossings[i];
    for (std::uint32_t p = c.begin; p < c.end; ++p) {
      const double off = p + 0.5 - c.position;
      const bool is_dark = (off < 0) == c.dark_first;
      const double level = grey(c.strip, p);
      moment += (is_dark ? level - dark : bright - level) * std::abs(off);
    }
  }
  const double variance = 2 * moment / (count * (bright - dark)) * side.steepness * side.steepness;
  return variance > 0 ? variance : 0;
}

/// The least-squares line through `count` crossings, none of which is known better than to a
/// variance of `least_variance`, px².
Line fit_line(const Crossing* crossings, std::uint32_t count, double least_variance) {
  double t = 0, e = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    t += crossings[i].along / count;
    e += crossings[i].outward / count;
  }
  double tt = 0, te = 0, ee = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double dt = crossings[i].along - t, de = crossings[i].outward - e;
    tt += dt * dt;
    te += dt * de;
    ee += de * de;
  }
  Line line{};
  line.slope = te / tt;
  line.offset = e - line.slope * t;
  const double left = ee - line.slope * te;
  double variance = left / (count - 2);
  if (!(variance > least_variance)) variance = least_variance;
  line.scatter = std::sqrt(variance);
  line.slope_variance = variance / tt;
  line.covariance = -t * line.slope_variance;
  line.offset_variance = variance / count + t * t * line.slope_variance;
  return line;
}

/// Leaves out crossings that lie more than `limit` px from the line. Returns how many are left.
std::uint32_t keep_near(Crossing* crossings, std::uint32_t count, const Line& line, double limit) {
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Crossing& c = crossings[i];
    if (std::abs(c.outward - line.offset - line.slope * c.along) <= limit) crossings[kept++] = c;
  }
  return kept;
}

class SideFit {
 public:
  SideFit(const Source& source, const Lens& lens, const std::array<Side, 4>& sides, unsigned which,
          double reach, double depth, const QuadFitOptions& options)
      : source_(source),
        lens_(lens),
        sides_(sides),
        which_(which),
        reach_(reach),
        depth_(depth),
        options_(options) {}

  Refusal fit(Line& line) {
    const Side& side = sides_[which_];
    if (source_.image.pixels != nullptr) {
      collect_from_frame();
    } else {
      const SideSupport& support = (*source_.sides)[which_];
      for (std::uint32_t i = 0; i < support.count; ++i) collect(support.strips[i]);
    }
    if (!is_covered(count_)) return Refusal::hidden;
    const Levels levels = read_levels(crossings_.data(), count_, depth_ / side.steepness);
    if (!(levels.contrast() >= options_.minimum_contrast)) return Refusal::contrast;
    std::uint32_t located = 0;
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (locate(lens_, side, levels, crossings_[i])) crossings_[located++] = crossings_[i];
    }
    if (!is_covered(located)) return Refusal::hidden;
    // Grey levels are whole numbers: each is off by a variance of 1/12.
    const double pixels = crossings_[0].end - crossings_[0].begin;
    const double per_level = side.steepness / levels.contrast();
    const double rounding = pixels / 12 * per_level * per_level;
    line = fit_line(crossings_.data(), located, rounding);
    const double limit = line.scatter > 0.02 ? 3 * line.scatter : 0.06;
    const std::uint32_t kept = keep_near(crossings_.data(), located, line, limit);
    if (kept < least_crossings) return Refusal::ragged;
    line = fit_line(crossings_.data(), kept, rounding);
    line.transition = transition_variance(crossings_.data(), kept, side, levels);
    // A level that is off shifts the whole side.
    const double lever = pixels / 2 * per_level;
    line.offset_variance += lever * lever * (levels.dark.variance() + levels.bright.variance());
    line.dark = levels.dark.mean();
    line.bright = levels.bright.mean();
    return Refusal::none;
  }

 private:
  void collect_from_frame() {
    const Side& side = sides_[which_];
    const GreyImage& image = source_.image;
    const Point a = distort(lens_, side.from), b = distort(lens_, side.to);
    double low = side.by_rows ? a.y : a.x, high = side.by_rows ? b.y : b.x;
    if (low > high) std::swap(low, high);
    const double limit = side.by_rows ? image.height : image.width;
    if (low < 0) low = 0;
    if (high > limit) high = limit;
    if (!(high > low)) return;
    const auto first = static_cast<std::uint32_t>(low), last = static_cast<std::uint32_t>(high);
    step_ = (last - first) / most_crossings + 1;
    for (std::uint32_t i = first; i <= last && i < limit; i += step_) {
      if (side.by_rows) {
        collect({image.pixels + std::size_t{i} * image.width, 1, 0, image.width, i});
      } else {
        collect({image.pixels + i, image.width, 0, image.height, i});
      }
    }
  }

  /// True if the edge was seen on enough of the side, its ends at the corners left out.
  bool is_covered(std::uint32_t count) const {
    const Side& side = sides_[which_];
    const double lines = side.length * side.steepness - 4 * reach_;
    return count >= least_crossings && count * step_ >= options_.minimum_coverage * lines;
  }

  void collect(const Strip& strip) {
    if (count_ == most_crossings) return;
    Crossing& crossing = crossings_[count_];
    crossing.strip = strip;
    if (expect(lens_, sides_, which_, reach_, crossing)) ++count_;
  }

  const Source& source_;
  const Lens& lens_;
  const std::array<Side, 4>& sides_;
  unsigned which_;
  double reach_, depth_;
  const QuadFitOptions& options_;
  std::array<Crossing, most_crossings> crossings_;
  std::uint32_t count_ = 0;
  std::uint32_t step_ = 1;
};

/// Where two lines meet, and how the corner moves with their offsets there.
struct Meeting {
  Point corner;
  Point by_first, by_second;
};

bool meet(const Side& first, const Line& one, const Side& second, const Line& other,
          Meeting& meeting) {
  // Line: n · p = d.
  const Point n = first.outward - one.slope * first.along;
  const Point m = second.outward - other.slope * second.along;
  const double d = one.offset + 0.5 * dot(n, first.from + first.to);
  const double e = other.offset + 0.5 * dot(m, second.from + second.to);
  const double determinant = n.x * m.y - n.y * m.x;
  if (!(std::abs(determinant) > 1e-3)) return false;
  meeting.by_first = {m.y / determinant, -m.x / determinant};
  meeting.by_second = {-n.y / determinant, n.x / determinant};
  meeting.corner = d * meeting.by_first + e * meeting.by_second;
  return true;
}

double along(const Side& side, Point corner) {
  return dot(corner - 0.5 * (side.from + side.to), side.along);
}

/// Covariance of a line's offsets at two places along it.
double offset_covariance(const Line& line, double s, double t) {
  return line.offset_variance + (s + t) * line.covariance + s * t * line.slope_variance;
}

/// Corner i lies between the sides i − 1 and i. Each side moves both of its corners.
void fill_covariance(const std::array<Side, 4>& sides, const std::array<Line, 4>& lines,
                     const std::array<Meeting, 4>& corners, std::array<double, 64>& covariance) {
  covariance.fill(0);
  for (unsigned side = 0; side < 4; ++side) {
    const std::array<unsigned, 2> ends = {side, (side + 1) % 4};
    const std::array<Point, 2> moves = {corners[ends[0]].by_second, corners[ends[1]].by_first};
    for (unsigned a = 0; a < 2; ++a) {
      for (unsigned b = 0; b < 2; ++b) {
        const double c = offset_covariance(lines[side], along(sides[side], corners[ends[a]].corner),
                                           along(sides[side], corners[ends[b]].corner));
        double* const at = &covariance[ends[a] * 16 + ends[b] * 2];
        at[0] += c * moves[a].x * moves[b].x;
        at[1] += c * moves[a].x * moves[b].y;
        at[8] += c * moves[a].y * moves[b].x;
        at[9] += c * moves[a].y * moves[b].y;
      }
    }
  }
}

/// One pass: the sides around `fit.ideal`, and the corners anew.
Refusal improve(const Source& source, const Lens& lens, const QuadFitOptions& options,
                double& transition_reach, QuadFit& fit) {
  if (!is_convex_clockwise(fit.ideal)) return Refusal::shape;
  const std::array<Side, 4> sides = sides_of(source, fit.ideal);
  double transition = 0;
  std::array<Line, 4> lines{};
  fit.dark = fit.bright = fit.raggedness = 0;
  for (unsigned i = 0; i < 4; ++i) {
    // Behind the border's cell the code may begin.
    const double cell = sides[i].height / options.cells;
    if (!(cell >= least_cell)) return Refusal::shape;
    const double pixel = (std::abs(sides[i].outward.x) + std::abs(sides[i].outward.y)) / 2;
    const double reach = std::min(cell / 2, std::max(transition_reach, pixel) + slack);
    const double depth = std::min(std::max(cell - 2 * reach, least_depth), most_depth);
    const Refusal refusal = SideFit(source, lens, sides, i, reach, depth, options).fit(lines[i]);
    if (refusal != Refusal::none) return refusal;
    fit.dark += lines[i].dark / 4;
    fit.bright += lines[i].bright / 4;
    transition += lines[i].transition / 4;
    if (lines[i].scatter > fit.raggedness) fit.raggedness = lines[i].scatter;
  }
  std::array<Meeting, 4> corners{};
  for (unsigned i = 0; i < 4; ++i) {
    const unsigned before = (i + 3) % 4;
    if (!meet(sides[before], lines[before], sides[i], lines[i], corners[i])) return Refusal::shape;
    fit.ideal[i] = corners[i].corner;
    fit.image[i] = distort(lens, corners[i].corner);
  }
  fill_covariance(sides, lines, corners, fit.covariance);
  transition_reach = reach_in_deviations * std::sqrt(transition);
  return is_convex_clockwise(fit.ideal) ? Refusal::none : Refusal::shape;
}

QuadFit fit_quad(const Source& source, const Lens& lens, const Quad& guess,
                 const QuadFitOptions& options) {
  QuadFit fit{};
  for (unsigned i = 0; i < 4; ++i) {
    if (!undistort(lens, guess[i], fit.ideal[i])) fit.refusal = Refusal::shape;
  }
  const Quad start = fit.ideal;
  double reach = first_reach;
  for (unsigned pass = 0; pass < passes && fit.refusal == Refusal::none; ++pass) {
    fit.refusal = improve(source, lens, options, reach, fit);
    for (unsigned i = 0; i < 4 && fit.refusal == Refusal::none; ++i) {
      const Point move = fit.ideal[i] - start[i];
      if (!(dot(move, move) <= most_move * most_move)) fit.refusal = Refusal::shape;
    }
  }
  if (fit.refusal == Refusal::none && fit.raggedness > options.maximum_raggedness) {
    fit.refusal = Refusal::ragged;
  }
  return fit;
}

}  // namespace

bool largest_quad(const Extremes& extremes, Quad& quad) {
  // A blob ends where its outermost pixels end.
  constexpr std::array<Point, 8> half_pixel = {{{0, -0.5},
                                                {0.5, -0.5},
                                                {0.5, 0},
                                                {0.5, 0.5},
                                                {0, 0.5},
                                                {-0.5, 0.5},
                                                {-0.5, 0},
                                                {-0.5, -0.5}}};
  Extremes ends{};
  for (unsigned i = 0; i < 8; ++i) ends[i] = extremes[i] + half_pixel[i];
  double largest = 0;
  for (unsigned a = 0; a < 5; ++a) {
    for (unsigned b = a + 1; b < 6; ++b) {
      for (unsigned c = b + 1; c < 7; ++c) {
        for (unsigned d = c + 1; d < 8; ++d) {
          const Quad q = {ends[a], ends[b], ends[c], ends[d]};
          const double area = cross(q[0], q[1], q[2]) + cross(q[0], q[2], q[3]);
          if (area > largest && is_convex_clockwise(q)) {
            largest = area;
            quad = q;
          }
        }
      }
    }
  }
  return largest > 0;
}

QuadFit fit_quad(const GreyImage& image, const Lens& lens, const Quad& guess,
                 const QuadFitOptions& options) {
  return fit_quad(Source{image, nullptr}, lens, guess, options);
}

QuadFit fit_quad(const std::array<SideSupport, 4>& sides, const Lens& lens, const Quad& guess,
                 const QuadFitOptions& options) {
  return fit_quad(Source{{}, &sides}, lens, guess, options);
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
