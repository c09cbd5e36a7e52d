#include <marker/code_book.h>
#include <marker/inner_edges.h>
#include <marker/optics_frame.h>
#include <marker/work.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace marker {
namespace {

/// Half of what is looked at of a cell's edge, share of a cell: its corners belong to others, too.
constexpr double half_edge = 0.25;
/// Cells must be this wide for a transition's reach, or their neighbours blur into it (measured);
/// below the second number nothing is left of the edge.
constexpr double clear_share = 1.1 / 0.3, least_share = 2.2;
/// Strips reach this much farther than a transition.
constexpr double margin = 1.1;
/// Fewer edges are not worth a number.
constexpr std::uint32_t least_edges = 6;
/// Edges farther than so many deviations from what half of them say are left out; of normal numbers
/// half are within 0.67 deviations.
constexpr double most_deviations = 2.5, deviation_of_median = 1.4826;
/// An edge so near to the far side that a shift hardly moves it says nothing.
constexpr double least_weight = 0.1;
constexpr std::uint32_t most_edges = 2 * (max_code_cells + 1) * max_code_cells;

/// An edge between two cells, as the marker's plane has it: half cells from the middle.
struct Edge {
  Point from, to;      ///< corners of the part that is looked at, cells from the top left corner
  bool is_upright;     ///< dark and bright lie beside each other
  bool dark_first;     ///< the dark cell is on the left, or above
  double from_middle;  ///< of the marker, in half sides; + if the dark cell is nearer to it
};

/// From a marker's plane, its sides of length 1, to where its four corners are seen (Heckbert
/// 1989).
class Plane {
 public:
  explicit Plane(const Quad& corners) : origin_(corners[0]) {
    const Point right = corners[1] - corners[2], down = corners[3] - corners[2];
    const Point rest = corners[0] - corners[1] + corners[2] - corners[3];
    const double area = right.x * down.y - down.x * right.y;
    g_ = (rest.x * down.y - down.x * rest.y) / area;
    h_ = (right.x * rest.y - rest.x * right.y) / area;
    across_ = corners[1] - corners[0] + g_ * corners[1];
    along_ = corners[3] - corners[0] + h_ * corners[3];
  }

  Point at(Point place) const {
    const double depth = g_ * place.x + h_ * place.y + 1;
    return 1 / depth * (place.x * across_ + place.y * along_ + origin_);
  }

 private:
  Point origin_, across_, along_;
  double g_, h_;
};

/// What one edge shows.
struct Offset {
  double weight;  ///< by how much of the shift it is off
  double px;      ///< towards bright from where the outline has it
};

class InnerEdges {
 public:
  InnerEdges(const CameraFrame& frame, const QuadFit& fit, const LightLevels& levels,
             std::uint64_t word, std::uint32_t cells)
      : frame_(frame), fit_(fit), levels_(levels), word_(word), cells_(cells), plane_(fit.ideal) {}

  InnerShift measure() {
    look_at_all(clear_share, clear_share);
    const bool is_vague = edges_ < least_edges;
    if (is_vague) {
      edges_ = 0;
      look_at_all(least_share, 0);
    }
    work(Work::inner_cells, cells_seen_);
    work(Work::inner_edges, edges_seen_);
    work(Work::inner_pixels, pixels_);
    work(Work::inner_strips, strips_);
    if (frame_.in_dma_memory) work(Work::crossings_dma, strips_);
    InnerShift found = solve();
    found.is_vague = is_vague;
    return found;
  }

 private:
  /// At edges of cells that are so wide across and along them, in reaches of a transition.
  void look_at_all(double share, double along) {
    share_ = share;
    along_ = along;
    for (std::uint32_t a = 0; a <= cells_; ++a) {
      for (std::uint32_t b = 1; b <= cells_; ++b) {
        look_at(b, a, false);
        look_at(a, b, true);
      }
    }
  }

  bool is_black(std::uint32_t row, std::uint32_t column) const {
    if (row == 0 || column == 0 || row > cells_ || column > cells_) return true;
    return word_ >> (cells_ * cells_ - 1 - ((row - 1) * cells_ + column - 1)) & 1u;
  }

  /// The edge below a cell, or on its right.
  void look_at(std::uint32_t row, std::uint32_t column, bool below) {
    MARKERVP_COUNT(cells_seen_);
    const bool dark_first = is_black(row, column);
    if (is_black(row + (below ? 1 : 0), column + (below ? 0 : 1)) == dark_first) return;
    const double across = (below ? row : column) + 1.0, along = (below ? column : row) + 0.5;
    const double half = (cells_ + 2) / 2.0;
    const double q = (across - half) / half;
    const Point from = below ? Point{along - half_edge, across} : Point{across, along - half_edge};
    const Point to = below ? Point{along + half_edge, across} : Point{across, along + half_edge};
    // With the dark first, bright is to the right, or below: away from the middle if q > 0.
    measure_edge({from, to, !below, dark_first, dark_first ? q : -q});
  }

  /// Where the picture shows a place, cells from the top left corner.
  Point see(Point place) const {
    return distort(frame_.optics->lens, plane_.at(1.0 / (cells_ + 2) * place));
  }

  void measure_edge(const Edge& edge) {
    MARKERVP_COUNT(edges_seen_);
    const Point step = edge.is_upright ? Point{1, 0} : Point{0, 1};
    const Point from = see(edge.from), to = see(edge.to), beyond = see(edge.from + step);
    const Point span = to - from, cell = beyond - from;
    const double length = std::sqrt(dot(span, span));
    if (!(length > 0 && edge.from_middle < 1 - least_weight)) return;
    const Point across{span.y / length, -span.x / length};  // towards the next cell, or from it
    const double way = dot(cell, across), reach = fit_.reach;
    if (!(std::abs(way) > share_ * reach && length > 2 * half_edge * along_ * reach)) return;
    const bool by_rows = std::abs(span.y) >= std::abs(span.x);
    const double steepness = std::abs(by_rows ? across.x : across.y);
    const double per_step = by_rows ? cell.x : cell.y;
    // In the order of the picture's pixels.
    const bool dark_first = (per_step > 0) == edge.dark_first;
    double sum = 0;
    std::uint32_t count = 0;
    const double begin = by_rows ? std::min(from.y, to.y) : std::min(from.x, to.x);
    const double end = by_rows ? std::max(from.y, to.y) : std::max(from.x, to.x);
    for (double line = std::ceil(begin - 0.5); line + 0.5 <= end; line += 1) {
      const double share = (line + 0.5 - (by_rows ? from.y : from.x)) / (by_rows ? span.y : span.x);
      const Point at = from + share * span;
      double off = 0;
      if (!measure_strip(by_rows, line, by_rows ? at.x : at.y, margin * reach / steepness,
                         dark_first, off)) {
        return;
      }
      sum += off * steepness;
      ++count;
    }
    if (count == 0 || edges_ == most_edges) return;
    offsets_[edges_++] = {1 - edge.from_middle, sum / count};
  }

  /// How far the edge in one strip is from `middle` towards bright, px along it.
  bool measure_strip(bool by_rows, double line, double middle, double half, bool dark_first,
                     double& off) {
    const Box& part = frame_.part;
    const double first = std::floor(middle - half), last = std::floor(middle + half) + 1;
    const double least = by_rows ? part.left : part.top, most = by_rows ? part.right : part.bottom;
    const double least_line = by_rows ? part.top : part.left;
    const double end_line = by_rows ? part.bottom : part.right;
    if (!(first >= least && last <= most && line >= least_line && line < end_line)) return false;
    const auto begin = static_cast<std::uint32_t>(first), end = static_cast<std::uint32_t>(last);
    const auto which = static_cast<std::uint32_t>(line);
    const std::uint32_t width = frame_.image.width;
    const std::uint8_t* pixel =
        frame_.image.pixels + (by_rows ? which * width + begin : begin * width + which);
    std::uint32_t sum = 0;
    for (std::uint32_t i = begin; i < end; ++i, pixel += by_rows ? 1 : width) {
      sum += frame_.optics->light[*pixel];
    }
    MARKERVP_COUNT(strips_);
    MARKERVP_ADD(pixels_, end - begin);
    const double size = end - begin;
    const double dark = (levels_.bright * size - sum) / (levels_.bright - levels_.dark);
    off = dark_first ? begin + dark - middle : middle - (end - dark);
    return std::abs(off) < half;
  }

  /// Least squares: an edge is off by shift · weight towards the dark. Blurred cells pull some
  /// edges far to one side, and more than they push to the other, so what is far from the median is
  /// left out first.
  InnerShift solve() {
    InnerShift found{};
    if (edges_ < least_edges) return found;
    std::array<double, most_edges> shifts, far;
    for (std::uint32_t i = 0; i < edges_; ++i) shifts[i] = -offsets_[i].px / offsets_[i].weight;
    const double middle = median_of(shifts);
    for (std::uint32_t i = 0; i < edges_; ++i)
      far[i] = std::abs(offsets_[i].px + middle * offsets_[i].weight);
    const double most = most_deviations * deviation_of_median * median_of(far);
    double product = 0, square = 0;
    std::uint32_t kept = 0;
    for (std::uint32_t i = 0; i < edges_; ++i) {
      const Offset edge = offsets_[i];
      if (std::abs(edge.px + middle * edge.weight) > most) continue;
      offsets_[kept++] = edge;
      product += edge.weight * edge.px;
      square += edge.weight * edge.weight;
    }
    if (kept < 2 || !(square > 0)) return found;
    found.edges = edges_;
    found.shift = -product / square;
    double left = 0;
    for (std::uint32_t i = 0; i < kept; ++i) {
      const double rest = offsets_[i].px + found.shift * offsets_[i].weight;
      left += rest * rest;
    }
    found.variance = left / (kept - 1) / square;
    found.deviation = fit_.reach / reach_in_deviations;
    return found;
  }

  /// Of as many numbers as there are edges.
  double median_of(std::array<double, most_edges> numbers) const {
    const auto end = numbers.begin() + edges_, middle = numbers.begin() + edges_ / 2;
    std::nth_element(numbers.begin(), middle, end);
    return *middle;
  }

  const CameraFrame& frame_;
  const QuadFit& fit_;
  const LightLevels& levels_;
  const std::uint64_t word_;
  const std::uint32_t cells_;
  const Plane plane_;
  std::array<Offset, most_edges> offsets_;
  std::uint32_t edges_ = 0;
  std::uint32_t cells_seen_ = 0, edges_seen_ = 0, strips_ = 0, pixels_ = 0;  ///< work
  double share_ = clear_share, along_ = clear_share;
};

}  // namespace

InnerShift measure_inner_edges(const CameraFrame& frame, const QuadFit& fit,
                               const LightLevels& levels, std::uint64_t word, std::uint32_t cells) {
  const FunctionScope scope(Function::cell_reading);
  return InnerEdges(frame, fit, levels, word, cells).measure();
}

}  // namespace marker
