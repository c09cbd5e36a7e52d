#include <marker/quad_fit.h>
#include <marker/work.h>

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
/// The corners are found in so many passes, each around where they were before, from a few
/// crossings of each side, and refined in a last one from all that are asked for.
constexpr unsigned coarse_passes = 2;
constexpr std::uint32_t coarse_crossings = 12;
/// A corner that leaves its guess by more belongs to something else, px.
constexpr double most_move = 6;
/// A side with fewer crossings is not measured.
constexpr std::uint32_t least_crossings = 6;
/// Room for the crossings of a side.
constexpr std::uint32_t most_crossings = 256;
/// A grey level is the mean of at most so many pixels; in the last pass it shifts the side.
constexpr std::uint32_t level_pixels = 256, coarse_level_pixels = 64;
/// A lens bends a side by less than a twentieth of a pixel on so many lines.
constexpr double straight_lines = 32;
constexpr std::uint32_t most_pieces = 64;

/// Units of work that were done.
struct Effort {
  std::uint64_t passes = 0, sides = 0, strips = 0, crossings = 0, level_pixels = 0;
  std::uint64_t transitions = 0, refitted = 0, level_reads = 0, corners = 0;
  std::uint32_t lens_steps = 0;

  void tell(bool in_dma_memory) const {
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
};

/// Where grey values come from: the rows and columns of `image`, or `sides` where it has no pixels.
struct Source {
  GreyImage image;
  const std::array<SideSupport, 4>* sides;
  Effort& effort;
};

/// Between two corners of the quadrilateral, in ideal px.
struct Side {
  Point from, to, middle, along, outward;
  double length;
  double height;             ///< of the quadrilateral over this side, at its lower end
  bool by_rows;              ///< rows cross it
  bool dark_first;           ///< along them the dark side comes first
  double steepness;          ///< px across the edge for one px along a strip
  Point from_seen, to_seen;  ///< in the picture
};

/// A strip and where its edge is.
struct Crossing {
  Strip strip;
  std::uint32_t begin, end;  ///< the pixels that hold the transition
  double position;           ///< px along the strip
  double along, outward;     ///< px from the side's middle, and from the side
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
  std::uint32_t sum = 0, squares = 0, count = 0;

  void add(std::uint32_t value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  double mean() const { return static_cast<double>(sum) / count; }
  /// Of the mean.
  double variance() const {
    if (count < 2) return 0;
    const double n = count, s = sum;
    return (squares - s * s / n) / (n - 1) / n;
  }
};

std::array<Side, 4> sides_of(const Source& source, const Quad& ideal, const Quad& seen) {
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
    side.by_rows = source.image.pixels != nullptr ? std::abs(span.y) >= std::abs(span.x)
                                                  : (*source.sides)[i].rows;
    const double across = side.by_rows ? side.outward.x : side.outward.y;
    side.dark_first = across > 0;
    side.steepness = std::abs(across);
  }
  return sides;
}

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

/// Where the strips that stand on lines meet a side.
class Path {
 public:
  /// False if no line meets the side at least `reach` px from its neighbours, there or where the
  /// transition ends inside.
  bool find(const Lens& lens, const std::array<Side, 4>& sides, unsigned which, double reach,
            Effort& effort) {
    const Side& side = sides[which];
    const double half = reach / side.steepness;
    const Point inside = on_strip(side, 0, side.dark_first ? -half : half);
    const Point span = side.to_seen - side.from_seen;
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
    per_line_ = pieces_ / (to - from);
    for (std::uint32_t i = 1; i < pieces_; ++i) {
      if (!meet_strip(lens, side, from + i / per_line_, nodes_[i] = nodes_[i - 1], effort))
        return false;
    }
    nodes_[pieces_] = along_strip(side, side.to_seen);
    return true;
  }

  double first() const { return first_; }
  double last() const { return last_; }

  /// px along the strip on that line.
  double at(double line) const {
    const double place = (line - start_) * per_line_;
    std::uint32_t piece = place > 0 ? static_cast<std::uint32_t>(place) : 0;
    if (piece >= pieces_) piece = pieces_ - 1;
    return nodes_[piece] + (place - piece) * (nodes_[piece + 1] - nodes_[piece]);
  }

 private:
  /// The share of a side next to a neighbour that is too near to it; `span` leads away from there.
  static double distance_from(const Side& neighbour, Point span, Point inside, double reach) {
    const double away = -dot(span, neighbour.outward);
    if (!(away > 0)) return 1;
    const double nearer = dot(inside, neighbour.outward);
    return (reach + (nearer > 0 ? nearer : 0)) / away;
  }

  /// From a position near by; the slope of the straight side leads there in a few steps.
  static bool meet_strip(const Lens& lens, const Side& side, double line, double& position,
                         Effort& effort) {
    const double across = side.dark_first ? side.steepness : -side.steepness;
    for (unsigned step = 0; step < 4; ++step) {
      Point at{};
      if (!undistort(lens, on_strip(side, line, position), at, effort.lens_steps)) return false;
      position -= dot(at - side.from, side.outward) / across;
    }
    return true;
  }

  double first_, last_;
  double start_, per_line_;
  std::uint32_t pieces_;
  std::array<double, most_pieces + 1> nodes_;
};

/// The pixels of a strip around `position` that hold a transition of `half` px to both sides. False
/// if they, or one more on each side, which tells the level, are not in the strip.
bool cover(const Strip& strip, double position, double half, Crossing& crossing) {
  if (!(position - half >= strip.first + 1.0 && position + half < strip.first + strip.size - 1.0)) {
    return false;
  }
  crossing.strip = strip;
  crossing.begin = static_cast<std::uint32_t>(position - half);
  crossing.end = static_cast<std::uint32_t>(position + half) + 1;
  return true;
}

std::uint32_t grey(const Strip& strip, std::uint32_t position) {
  return strip.pixels[std::size_t{position - strip.first} * strip.stride];
}

/// Both grey levels of a side.
struct Levels {
  Level dark, bright;

  double contrast() const { return bright.mean() - dark.mean(); }
};

/// Pixels beyond a transition.
struct Beyond {
  const std::uint8_t* pixels;  ///< the first
  std::ptrdiff_t stride;
  std::uint32_t count;
};

Beyond beyond(const Crossing& crossing, bool below, std::uint32_t wanted) {
  const Strip& strip = crossing.strip;
  const auto stride = static_cast<std::ptrdiff_t>(strip.stride);
  const std::uint32_t room =
      below ? crossing.begin - strip.first : strip.first + strip.size - crossing.end;
  const std::uint32_t at = below ? crossing.begin - 1 : crossing.end;
  return {strip.pixels + static_cast<std::ptrdiff_t>(at - strip.first) * stride,
          below ? -stride : stride, room < wanted ? room : wanted};
}

/// Adds them, but for the last one, if all are from `least` to `most`.
void read_level(const Beyond& beyond, std::uint32_t least, std::uint32_t most, Level& level,
                [[maybe_unused]] Effort& effort) {
  const std::uint32_t range = most - least;
  const std::uint8_t* pixel = beyond.pixels;
  Level found;
  std::uint32_t last = 0;
  for (std::uint32_t i = 0; i < beyond.count; ++i, pixel += beyond.stride) {
    MARKERVP_COUNT(effort.level_pixels);
    last = *pixel;
    if (last - least > range) return;
    found.sum += last;
    found.squares += last * last;
  }
  if (beyond.count == 0) return;
  level.sum += found.sum - last;
  level.squares += found.squares - last * last;
  level.count += beyond.count - 1;
}

Levels read_levels(const Crossing* crossings, std::uint32_t count, bool dark_first, double depth,
                   std::uint32_t most_pixels, Effort& effort) {
  const auto wanted = static_cast<std::uint32_t>(depth) + 1;
  const std::uint32_t step = count * wanted / most_pixels + 1;
  Levels near;
  for (std::uint32_t i = 0; i < count; i += step) {
    const Crossing& c = crossings[i];
    (dark_first ? near.dark : near.bright).add(grey(c.strip, c.begin));
    (dark_first ? near.bright : near.dark).add(grey(c.strip, c.end - 1));
  }
  const double dark = near.dark.mean(), bright = near.bright.mean(), eighth = (bright - dark) / 8;
  if (!(eighth > 0)) return near;
  const auto most_dark = static_cast<std::uint32_t>(dark + eighth);
  const auto least_bright = static_cast<std::uint32_t>(bright - eighth) + 1;
  Levels deep;
  for (std::uint32_t i = 0; i < count; i += step) {
    MARKERVP_COUNT(effort.level_reads);
    read_level(beyond(crossings[i], dark_first, wanted), 0, most_dark, deep.dark, effort);
    read_level(beyond(crossings[i], !dark_first, wanted), least_bright, 255, deep.bright, effort);
  }
  // A cell of the code next to the border may be white all along a side.
  if (deep.dark.count < least_crossings) deep.dark = near.dark;
  if (deep.bright.count < least_crossings) deep.bright = near.bright;
  return deep;
}

/// What turns the sum of a strip's pixels into the place of its edge.
struct Scale {
  double bright, per_level;  ///< grey level; 1 / contrast

  explicit Scale(const Levels& levels)
      : bright(levels.bright.mean()), per_level(1 / levels.contrast()) {}
};

/// Where the edge crosses: as many pixels are dark as the sum says. False if that is outside.
/// No `lens`: a pinhole.
bool locate(const Lens* lens, const Side& side, const Scale& scale, Crossing& c, Effort& effort) {
  const std::uint8_t* pixel =
      c.strip.pixels + std::size_t{c.begin - c.strip.first} * c.strip.stride;
  std::uint32_t sum = 0;
  for (std::uint32_t i = c.begin; i < c.end; ++i, pixel += c.strip.stride) sum += *pixel;
  const double size = c.end - c.begin;
  const double dark = (scale.bright * size - sum) * scale.per_level;
  if (!(dark > 0 && dark < size)) return false;
  c.position = side.dark_first ? c.begin + dark : c.end - dark;
  Point at = on_strip(side, c.strip.line + 0.5, c.position);
  if (lens != nullptr && !undistort(*lens, Point(at), at, effort.lens_steps)) return false;
  const Point off = at - side.middle;
  c.along = dot(off, side.along);
  c.outward = dot(off, side.outward);
  return true;
}

/// What parts a transition from a step, times the way to it: the first moment about the edge of
/// `size` pixels of which the first ones are on the side of level `before`.
double moment(const Crossing& c, double before, double after) {
  const std::uint32_t size = c.end - c.begin;
  const double edge = c.position - c.begin;
  const auto near = static_cast<std::uint32_t>(edge + 0.5);
  const std::uint8_t* pixel =
      c.strip.pixels + std::size_t{c.begin - c.strip.first} * c.strip.stride;
  // Sums of the grey values, and of them times twice the way of the pixel from the first one's
  // edge.
  std::uint32_t sum = 0, way = 0, sum_after = 0, way_after = 0;
  for (std::uint32_t i = 0; i < near; ++i, pixel += c.strip.stride) {
    sum += *pixel;
    way += *pixel * (2 * i + 1);
  }
  for (std::uint32_t i = near; i < size; ++i, pixel += c.strip.stride) {
    sum_after += *pixel;
    way_after += *pixel * (2 * i + 1);
  }
  const double n = near, rest = size - near;
  const double first = edge * (sum - n * before) - (way - before * n * n) / 2;
  const double last =
      (after * (n + size) * rest - way_after) / 2 - edge * (after * rest - sum_after);
  return first + last;
}

/// The variance of a transition is twice that moment.
double transition_variance(const Crossing* crossings, std::uint32_t count, const Side& side,
                           const Levels& levels) {
  const double dark = levels.dark.mean(), bright = levels.bright.mean();
  double sum = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    sum +=
        side.dark_first ? moment(crossings[i], dark, bright) : -moment(crossings[i], bright, dark);
  }
  const double variance = 2 * sum / (count * (bright - dark)) * side.steepness * side.steepness;
  return variance > 0 ? variance : 0;
}

/// The least-squares line through `count` crossings, none of which is known better than to a
/// variance of `least_variance`, px². `along` is counted from the middle, so the sums lose nothing.
Line fit_line(const Crossing* crossings, std::uint32_t count, double least_variance) {
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
  Line line{};
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
std::uint32_t keep_near(Crossing* crossings, std::uint32_t count, const Line& line, double limit) {
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Crossing& c = crossings[i];
    if (!(std::abs(c.outward - line.offset - line.slope * c.along) <= limit)) continue;
    if (kept != i) crossings[kept] = c;
    ++kept;
  }
  return kept;
}

/// How one pass measures the sides.
struct Pass {
  double reach, depth;      ///< px across the edge
  std::uint32_t crossings;  ///< of a side, at most
  bool is_last;             ///< nobody asks for the transition any more
};

class SideFit {
 public:
  SideFit(const Source& source, const Lens& lens, const std::array<Side, 4>& sides, unsigned which,
          const Pass& pass, const QuadFitOptions& options)
      : source_(source),
        lens_(lens),
        sides_(sides),
        which_(which),
        pass_(pass),
        options_(options),
        half_(pass.reach / sides[which].steepness) {}

  Refusal fit(Line& line) {
    const Side& side = sides_[which_];
    if (path_.find(lens_, sides_, which_, pass_.reach, source_.effort)) {
      if (source_.image.pixels != nullptr) {
        collect_from_frame();
      } else {
        collect_from_strips((*source_.sides)[which_]);
      }
    }
    MARKERVP_ADD(source_.effort.strips, count_);
    if (!is_covered(count_)) return Refusal::hidden;
    const Levels levels =
        read_levels(crossings_.data(), count_, side.dark_first, pass_.depth / side.steepness,
                    pass_.is_last ? level_pixels : coarse_level_pixels, source_.effort);
    if (!(levels.contrast() >= options_.minimum_contrast)) return Refusal::contrast;
    const double pixels = crossings_[0].end - crossings_[0].begin;
    const std::uint32_t located = locate_all(levels);
    if (!is_covered(located)) return Refusal::hidden;
    // Grey levels are whole numbers: each is off by a variance of 1/12.
    const double per_level = side.steepness / levels.contrast();
    const double rounding = pixels / 12 * per_level * per_level;
    line = fit_line(crossings_.data(), located, rounding);
    const double limit = line.scatter > 0.02 ? 3 * line.scatter : 0.06;
    const std::uint32_t kept = keep_near(crossings_.data(), located, line, limit);
    if (kept < least_crossings) return Refusal::ragged;
    MARKERVP_ADD(source_.effort.refitted, kept < located ? kept : 0);
    if (kept < located) line = fit_line(crossings_.data(), kept, rounding);
    if (!pass_.is_last) {
      MARKERVP_ADD(source_.effort.transitions, kept);
      line.transition = transition_variance(crossings_.data(), kept, side, levels);
    }
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
    const double limit = side.by_rows ? image.height : image.width;
    const double low = path_.first() > 0 ? path_.first() : 0;
    const double high = path_.last() < limit - 1 ? path_.last() : limit - 1;
    if (!(high >= low)) return;
    const auto first = static_cast<std::uint32_t>(low), last = static_cast<std::uint32_t>(high);
    step_ = (last - first) / pass_.crossings + 1;
    for (std::uint32_t i = first; i <= last; i += step_) {
      if (side.by_rows) {
        collect({image.pixels + std::size_t{i} * image.width, 1, 0, image.width, i});
      } else {
        collect({image.pixels + i, image.width, 0, image.height, i});
      }
    }
  }

  void collect_from_strips(const SideSupport& support) {
    step_ = (support.count - 1) / pass_.crossings + 1;
    for (std::uint32_t i = 0; i < support.count; i += step_) collect(support.strips[i]);
  }

  /// True if the edge was seen on enough of the side, its ends at the corners left out.
  bool is_covered(std::uint32_t count) const {
    const Side& side = sides_[which_];
    const double lines = side.length * side.steepness - 4 * pass_.reach;
    return count >= least_crossings && count * step_ >= options_.minimum_coverage * lines;
  }

  void collect(const Strip& strip) {
    const double line = strip.line + 0.5;
    if (count_ == crossings_.size() || line < path_.first() || line > path_.last()) return;
    if (cover(strip, path_.at(line), half_, crossings_[count_])) ++count_;
  }

  /// Leaves out those without an edge. Returns how many have one.
  std::uint32_t locate_all(const Levels& levels) {
    const Side& side = sides_[which_];
    const Scale scale(levels);
    const Lens* const lens = lens_.is_pinhole() ? nullptr : &lens_;
    MARKERVP_ADD(source_.effort.crossings, count_);
    std::uint32_t located = 0;
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (!locate(lens, side, scale, crossings_[i], source_.effort)) continue;
      if (located != i) crossings_[located] = crossings_[i];
      ++located;
    }
    return located;
  }

  const Source& source_;
  const Lens& lens_;
  const std::array<Side, 4>& sides_;
  unsigned which_;
  const Pass& pass_;
  const QuadFitOptions& options_;
  double half_;  ///< of the pixels around a crossing, px
  Path path_;
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
  const double d = one.offset + dot(n, first.middle);
  const double e = other.offset + dot(m, second.middle);
  const double determinant = n.x * m.y - n.y * m.x;
  if (!(std::abs(determinant) > 1e-3)) return false;
  meeting.by_first = {m.y / determinant, -m.x / determinant};
  meeting.by_second = {-n.y / determinant, n.x / determinant};
  meeting.corner = d * meeting.by_first + e * meeting.by_second;
  return true;
}

double along(const Side& side, Point corner) {
  return dot(corner - side.middle, side.along);
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
Refusal improve(const Source& source, const Lens& lens, const QuadFitOptions& options, bool is_last,
                QuadFit& fit) {
  MARKERVP_COUNT(source.effort.passes);
  if (!is_convex_clockwise(fit.ideal)) return Refusal::shape;
  const std::array<Side, 4> sides = sides_of(source, fit.ideal, fit.image);
  double transition = 0;
  std::array<Line, 4> lines{};
  fit.dark = fit.bright = fit.raggedness = 0;
  for (unsigned i = 0; i < 4; ++i) {
    // Behind the border's cell the code may begin.
    const double cell = sides[i].height / options.cells;
    if (!(cell >= least_cell)) return Refusal::shape;
    const double pixel = (std::abs(sides[i].outward.x) + std::abs(sides[i].outward.y)) / 2;
    const double reach = std::min(cell / 2, std::max(fit.reach, pixel) + slack);
    const double depth =
        is_last ? std::min(std::max(cell - 2 * reach, least_depth), most_depth) : least_depth;
    const Pass pass{reach, depth, is_last ? options.crossings : coarse_crossings, is_last};
    MARKERVP_COUNT(source.effort.sides);
    const Refusal refusal = SideFit(source, lens, sides, i, pass, options).fit(lines[i]);
    if (refusal != Refusal::none) return refusal;
    fit.dark += lines[i].dark / 4;
    fit.bright += lines[i].bright / 4;
    transition += lines[i].transition / 4;
    if (lines[i].scatter > fit.raggedness) fit.raggedness = lines[i].scatter;
  }
  std::array<Meeting, 4> corners{};
  for (unsigned i = 0; i < 4; ++i) {
    const unsigned before = (i + 3) % 4;
    MARKERVP_COUNT(source.effort.corners);
    if (!meet(sides[before], lines[before], sides[i], lines[i], corners[i])) return Refusal::shape;
    fit.ideal[i] = corners[i].corner;
    fit.image[i] = distort(lens, corners[i].corner);
    MARKERVP_ADD(source.effort.lens_steps, lens.is_pinhole() ? 0 : 1);
  }
  if (is_last) fill_covariance(sides, lines, corners, fit.covariance);
  if (!is_last) fit.reach = reach_in_deviations * std::sqrt(transition);
  return is_convex_clockwise(fit.ideal) ? Refusal::none : Refusal::shape;
}

/// No corner left its guess.
bool are_near(const Quad& corners, const Quad& guess) {
  for (unsigned i = 0; i < 4; ++i) {
    const Point move = corners[i] - guess[i];
    if (!(dot(move, move) <= most_move * most_move)) return false;
  }
  return true;
}

void find_quad(const Source& source, const Lens& lens, const Quad& guess,
               const QuadFitOptions& options, QuadFit& fit) {
  const FunctionScope scope(Function::quad_fit);
  work(Work::quads_fitted, 1);
  fit = {};
  fit.image = guess;
  for (unsigned i = 0; i < 4; ++i) {
    if (!undistort(lens, guess[i], fit.ideal[i])) fit.refusal = Refusal::shape;
  }
  fit.reach = first_reach;
  for (unsigned pass = 0; pass < coarse_passes && fit.refusal == Refusal::none; ++pass) {
    fit.refusal = improve(source, lens, options, false, fit);
    if (fit.refusal == Refusal::none && !are_near(fit.image, guess)) fit.refusal = Refusal::shape;
  }
  source.effort.tell(options.in_dma_memory);
}

void refine_quad(const Source& source, const Lens& lens, const QuadFitOptions& options,
                 QuadFit& fit) {
  const FunctionScope scope(Function::quad_fit);
  if (fit.refusal != Refusal::none) return;
  work(Work::quads_refined, 1);
  const Quad found = fit.image;
  fit.refusal = improve(source, lens, options, true, fit);
  if (fit.refusal == Refusal::none && !are_near(fit.image, found)) fit.refusal = Refusal::shape;
  if (fit.refusal == Refusal::none && fit.raggedness > options.maximum_raggedness) {
    fit.refusal = Refusal::ragged;
  }
  source.effort.tell(options.in_dma_memory);
}

}  // namespace

bool largest_quad(const Extremes& extremes, Quad& quad) {
  [[maybe_unused]] std::uint32_t tests = 0;
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
          if (!(area > largest)) continue;
          MARKERVP_COUNT(tests);
          if (is_convex_clockwise(q)) {
            largest = area;
            quad = q;
          }
        }
      }
    }
  }
  work(Work::quads_spanned, 1);
  work(Work::hulls_tested, tests);
  return largest > 0;
}

QuadFit find_quad(const GreyImage& image, const Lens& lens, const Quad& guess,
                  const QuadFitOptions& options) {
  Effort effort;
  QuadFit fit;
  find_quad(Source{image, nullptr, effort}, lens, guess, options, fit);
  return fit;
}

void refine_quad(const GreyImage& image, const Lens& lens, const QuadFitOptions& options,
                 QuadFit& fit) {
  Effort effort;
  refine_quad(Source{image, nullptr, effort}, lens, options, fit);
}

QuadFit fit_quad(const GreyImage& image, const Lens& lens, const Quad& guess,
                 const QuadFitOptions& options) {
  QuadFit fit = find_quad(image, lens, guess, options);
  refine_quad(image, lens, options, fit);
  return fit;
}

QuadFit fit_quad(const std::array<SideSupport, 4>& sides, const Lens& lens, const Quad& guess,
                 const QuadFitOptions& options) {
  QuadFit fit;
  for (const bool is_last : {false, true}) {
    Effort effort;
    const Source source{{}, &sides, effort};
    if (is_last) {
      refine_quad(source, lens, options, fit);
    } else {
      find_quad(source, lens, guess, options, fit);
    }
  }
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
