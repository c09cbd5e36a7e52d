#include <marker/outline.h>
#include <marker/work.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace marker {
namespace {

/// Room for an outline, px: that of a marker as high as the picture, with something at it.
constexpr std::uint32_t most_points = 4096;
/// Of the pixels of a part, so many say what dark and bright are: the thirtieth and the tenth from
/// either end. Narrow markers have few pixels that are dark all over (measured).
constexpr std::uint32_t most_samples = 1024;
constexpr std::uint32_t dark_tail = 30, bright_tail = 10;
/// Grey levels between the two, or there is no edge.
constexpr std::uint32_t least_contrast = 5;
/// An outline is cut into pieces that are straight to so many px, or this share of its length
/// (measured).
constexpr double straight = 1.5, straight_share = 0.01;
/// The longest pieces are looked at, and none shorter than this, px.
constexpr std::uint32_t most_pieces = 12;
constexpr double least_piece = 5;
/// A piece's ends may belong to a corner: the line goes through the rest.
constexpr double inner_share = 0.8;
/// Neighbouring sides turn by 15° at least: the sine.
constexpr double least_turn = 0.26;
/// A piece covers this share of its side, and reaches this far beyond its corners (measured).
constexpr double least_cover = 0.3, most_overhang = 0.25;
/// A shorter side is no marker's, px: six cells of the smallest size.
constexpr double least_side = 9;

struct Step {
  std::int16_t x, y;
};

/// Clockwise, y down, from the right.
constexpr std::array<Step, 8> steps = {
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// A straight piece of the outline.
struct Piece {
  std::uint32_t begin, size;  ///< points
  Point middle, along;        ///< of the line through it
  double from, to;            ///< where its ends are, from the middle
};

class Outline {
 public:
  explicit Outline(const CameraFrame& frame) : image_(frame.image), part_(frame.part) {}

  OutlineQuads find(Pixel start) {
    OutlineQuads found{};
    if (find_threshold() && follow(start)) {
      cut();
      choose(found);
    }
    work(Work::outlines, 1);
    work(Work::outline_samples, samples_);
    work(Work::outline_looks, looks_);
    work(Work::outline_points, count_);
    work(Work::outline_distances, distances_);
    work(Work::outline_fitted, fitted_);
    work(Work::outline_meets, meets_);
    work(Work::outline_covers, covers_);
    return found;
  }

 private:
  std::uint8_t pixel(std::int32_t x, std::int32_t y) const {
    return image_.pixels[static_cast<std::size_t>(y) * image_.width + static_cast<std::size_t>(x)];
  }
  bool is_dark(std::int32_t x, std::int32_t y) {
    MARKERVP_COUNT(looks_);
    const bool inside =
        x >= static_cast<std::int32_t>(part_.left) && y >= static_cast<std::int32_t>(part_.top) &&
        x < static_cast<std::int32_t>(part_.right) && y < static_cast<std::int32_t>(part_.bottom);
    return inside && pixel(x, y) <= threshold_;
  }

  bool find_threshold() {
    std::array<std::uint32_t, 256> histogram{};
    const std::uint32_t width = part_.right - part_.left, height = part_.bottom - part_.top;
    std::uint32_t step = 1;
    while (width / step * (height / step) > most_samples) ++step;
    for (std::uint32_t y = part_.top; y < part_.bottom; y += step) {
      for (std::uint32_t x = part_.left; x < part_.right; x += step) {
        ++histogram[pixel(static_cast<std::int32_t>(x), static_cast<std::int32_t>(y))];
        ++samples_;
      }
    }
    const std::uint32_t darkest = samples_ / dark_tail, brightest = samples_ / bright_tail;
    std::uint32_t dark = 0, bright = 255, below = 0, above = 0;
    while ((below += histogram[dark]) < darkest) ++dark;
    while ((above += histogram[bright]) < brightest) --bright;
    threshold_ = (dark + bright) / 2;
    return bright > dark && bright - dark >= least_contrast;
  }

  /// Keeps what is dark on the right. False: there is no outline, or no room for it.
  bool follow(Pixel start) {
    // An extreme may be an edge's pixel that is bright here.
    std::int32_t x = start.x, y = start.y;
    constexpr std::int32_t deepest = 3;
    for (std::int32_t i = 0; i < deepest && !is_dark(x, y); ++i) ++y;
    if (!is_dark(x, y)) return false;
    while (is_dark(x, y - 1)) --y;
    const Step first{static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)};
    Step at = first;
    unsigned came = 2;  // the way to it: from above, which is bright
    unsigned first_left = 8;
    do {
      if (count_ == most_points) return false;
      points_[count_++] = at;
      unsigned turn = (came + 5) % 8, tries = 0;  // the first that may be dark: left behind
      while (tries < 8 && !is_dark(at.x + steps[turn].x, at.y + steps[turn].y)) {
        turn = (turn + 1) % 8;
        ++tries;
      }
      if (tries == 8) return false;  // a single pixel
      // The first point is left a second time the same way: the outline is whole.
      if (at.x == first.x && at.y == first.y) {
        if (first_left == turn) {
          --count_;
          break;
        }
        if (first_left == 8) first_left = turn;
      }
      came = turn;
      at = {static_cast<std::int16_t>(at.x + steps[turn].x),
            static_cast<std::int16_t>(at.y + steps[turn].y)};
    } while (true);
    return count_ > 4 * static_cast<std::uint32_t>(least_piece);
  }

  Point point(std::uint32_t i) const {
    const Step p = points_[i % count_];
    return {p.x + 0.5, p.y + 0.5};
  }

  /// Of the points between two of them, the one farthest from the chord.
  std::uint32_t farthest(std::uint32_t begin, std::uint32_t end, double& most) {
    const Point a = point(begin), chord = point(end) - a;
    const double length = std::sqrt(dot(chord, chord));
    std::uint32_t which = begin;
    most = 0;
    for (std::uint32_t i = begin + 1; i < end; ++i) {
      const Point off = point(i) - a;
      const double way = length > 0 ? std::abs(off.x * chord.y - off.y * chord.x) / length
                                    : std::sqrt(dot(off, off));
      if (way > most) {
        most = way;
        which = i;
      }
    }
    MARKERVP_ADD(distances_, end - begin);
    return which;
  }

  /// Into pieces that are straight (Douglas and Peucker), from two points that are far apart.
  void cut() {
    const double allowed = std::max(straight, straight_share * count_);
    double most = 0;
    // The whole outline, from the first point to itself.
    const std::uint32_t opposite = farthest(0, count_, most);
    struct Span {
      std::uint32_t begin, end;
    };
    constexpr std::uint32_t deepest = 64;
    std::array<Span, deepest> waiting;
    std::uint32_t spans = 0;
    waiting[spans++] = {opposite, count_};
    waiting[spans++] = {0, opposite};
    while (spans > 0) {
      const Span span = waiting[--spans];
      const std::uint32_t middle = farthest(span.begin, span.end, most);
      if (most <= allowed || spans + 2 > deepest) {
        add_piece(span.begin, span.end - span.begin);
      } else {
        waiting[spans++] = {middle, span.end};
        waiting[spans++] = {span.begin, middle};
      }
    }
  }

  /// Keeps the longest, in the order of the outline.
  void add_piece(std::uint32_t begin, std::uint32_t size) {
    if (size < least_piece) return;
    if (pieces_ == most_pieces) {
      std::uint32_t shortest = 0;
      for (std::uint32_t i = 1; i < pieces_; ++i) {
        if (piece_[i].size < piece_[shortest].size) shortest = i;
      }
      if (piece_[shortest].size >= size) return;
      std::copy(piece_.begin() + shortest + 1, piece_.begin() + pieces_, piece_.begin() + shortest);
      --pieces_;
    }
    piece_[pieces_++] = line_of(begin, size);
  }

  /// The line through the inner points, by the main axis of their scatter.
  Piece line_of(std::uint32_t begin, std::uint32_t size) {
    const auto skipped = static_cast<std::uint32_t>(size * (1 - inner_share) / 2);
    const std::uint32_t first = begin + skipped, last = begin + size - skipped;
    double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    for (std::uint32_t i = first; i <= last; ++i) {
      const Point off = point(i) - point(first);
      x += off.x;
      y += off.y;
      xx += off.x * off.x;
      xy += off.x * off.y;
      yy += off.y * off.y;
    }
    MARKERVP_ADD(fitted_, last - first + 1);
    const double n = last - first + 1;
    xx -= x * x / n;
    xy -= x * y / n;
    yy -= y * y / n;
    const double half = (xx - yy) / 2, root = std::sqrt(half * half + xy * xy);
    // The axis of the greater eigenvalue, by its longer form.
    Point along = half > 0 ? Point{half + root, xy} : Point{xy, root - half};
    const Point chord = point(begin + size) - point(begin);
    const double length = std::sqrt(dot(along, along));
    along = length > 0 ? (dot(along, chord) < 0 ? -1 / length : 1 / length) * along : Point{1, 0};
    // The edge runs where the pixels end, half a pixel before their middles, of a slanting line in
    // the mean.
    const double ahead = std::max(std::abs(along.x), std::abs(along.y)) / 2;
    const Point edge = point(first) + Point{x / n, y / n} + ahead * Point{along.y, -along.x};
    Piece piece{begin, size, edge, along, 0, 0};
    piece.from = dot(point(begin) - piece.middle, along);
    piece.to = dot(point(begin + size) - piece.middle, along);
    return piece;
  }

  /// Where the lines of two pieces meet, if the second turns clockwise from the first.
  bool meet(const Piece& a, const Piece& b, Point& corner) {
    MARKERVP_COUNT(meets_);
    const double turn = a.along.x * b.along.y - a.along.y * b.along.x;
    if (!(turn > least_turn)) return false;
    const Point between = b.middle - a.middle;
    const double way = (between.x * b.along.y - between.y * b.along.x) / turn;
    corner = a.middle + way * a.along;
    return true;
  }

  /// How much of the side between two corners a piece covers; below 0: it is not that side's.
  static double cover(const Piece& piece, Point from, Point to) {
    const double begin = dot(from - piece.middle, piece.along);
    const double end = dot(to - piece.middle, piece.along), side = end - begin;
    if (!(side >= least_side)) return -1;
    if (begin - piece.from > most_overhang * side || piece.to - end > most_overhang * side)
      return -1;
    const double covered = std::min(end, piece.to) - std::max(begin, piece.from);
    return covered >= least_cover * side ? std::min(covered / side, 1.0) : -1;
  }

  void choose(OutlineQuads& found) {
    std::array<double, OutlineQuads::most> scores{};
    for (std::uint32_t a = 0; a < pieces_; ++a)
      for (std::uint32_t b = a + 1; b < pieces_; ++b)
        for (std::uint32_t c = b + 1; c < pieces_; ++c)
          for (std::uint32_t d = c + 1; d < pieces_; ++d) weigh({a, b, c, d}, found, scores);
  }

  void weigh(const std::array<std::uint32_t, 4>& which, OutlineQuads& found,
             std::array<double, OutlineQuads::most>& scores) {
    Quad quad{};
    double score = 0;
    for (unsigned i = 0; i < 4; ++i) {
      if (!meet(piece_[which[(i + 3) % 4]], piece_[which[i]], quad[i])) return;
    }
    MARKERVP_COUNT(covers_);
    for (unsigned i = 0; i < 4; ++i) {
      const double covered = cover(piece_[which[i]], quad[i], quad[(i + 1) % 4]);
      if (covered < 0) return;
      score += covered;
    }
    if (!is_convex_clockwise(quad)) return;
    std::uint32_t place = found.count < OutlineQuads::most ? found.count++ : OutlineQuads::most - 1;
    if (place + 1 == OutlineQuads::most && scores[place] >= score) return;
    for (; place > 0 && scores[place - 1] < score; --place) {
      scores[place] = scores[place - 1];
      found.quads[place] = found.quads[place - 1];
    }
    scores[place] = score;
    found.quads[place] = quad;
  }

  const GreyImage& image_;
  const Box part_;
  std::uint32_t threshold_ = 0;
  std::array<Step, most_points> points_;
  std::uint32_t count_ = 0;
  std::array<Piece, most_pieces> piece_;
  std::uint32_t pieces_ = 0;
  std::uint32_t samples_ = 0;
  std::uint32_t looks_ = 0, distances_ = 0, fitted_ = 0, meets_ = 0, covers_ = 0;  ///< work
};

}  // namespace

OutlineQuads quads_of_outline(const CameraFrame& frame, Pixel start) {
  const FunctionScope scope(Function::quad_fit);
  return Outline(frame).find(start);
}

}  // namespace marker
