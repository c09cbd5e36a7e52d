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
/// Cells must be this wide and high for a transition's reach, or the blur of the border and the
/// code moves the outline, too, from which edges are measured (measured). Down to the second number
/// an edge still tells something.
constexpr double clear_share = 2.2, least_share = 1.2;
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

/// What a blur of deviation 1 carries over a boundary, summed from z on: φ(z) − z·Q(z), at z = 0,
/// 1/8, … 4, where it ends.
constexpr double spill_steps = 8, spill_end = 4;
constexpr std::array<double, 33> spill_table = {
    0.39894, 0.33955, 0.28634, 0.23917, 0.19780, 0.16192, 0.13117, 0.10512, 0.08332,
    0.06530, 0.05059, 0.03873, 0.02931, 0.02191, 0.01617, 0.01179, 0.00849, 0.00604,
    0.00423, 0.00293, 0.00200, 0.00135, 0.00090, 0.00059, 0.00038, 0.00024, 0.00015,
    0.00010, 0.00006, 0.00004, 0.00002, 0.00001, 0.00001};

double spill(double z) {
  if (z < 0) return spill(-z) - z;
  const double place = z * spill_steps;
  if (!(place < spill_steps * spill_end)) return 0;
  const auto at = static_cast<std::uint32_t>(place);
  return spill_table[at] + (place - at) * (spill_table[at + 1] - spill_table[at]);
}

/// Parts of a strip for which the blur of the cells around is found.
constexpr std::uint32_t parts = 6;

/// An edge between two cells, as the marker's plane has it: half cells from the middle.
struct Edge {
  Point from, to;      ///< corners of the part that is looked at, cells from the top left corner
  bool is_upright;     ///< dark and bright lie beside each other
  bool dark_first;     ///< the dark cell is on the left, or above
  double from_middle;  ///< of the marker, in half sides; + if the dark cell is nearer to it
  std::uint32_t row, column;  ///< of the cell on its left, or above
};

/// Cells and strips at an edge, deviations of a transition.
struct Bend {
  double wide, high;  ///< of a cell, across the edge and along it
  double drift;       ///< of a strip along the edge against the cells', for a way across it
};

/// How far strips reach from an edge, px across it, mean.
struct Window {
  double dark, bright;
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
    look_at_all(clear_share);
    const bool is_vague = edges_ < least_edges;
    if (is_vague) {
      edges_ = 0;
      look_at_all(least_share);
    }
    work(Work::inner_cells, cells_seen_);
    work(Work::inner_edges, edges_seen_);
    work(Work::inner_pixels, pixels_);
    work(Work::inner_strips, strips_);
    work(Work::inner_blurs, blurs_);
    if (frame_.in_dma_memory) work(Work::crossings_dma, strips_);
    InnerShift found = solve();
    found.is_vague = is_vague;
    return found;
  }

 private:
  /// At edges of cells that are so wide and high, in reaches of a transition.
  void look_at_all(double share) {
    share_ = share;
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
    measure_edge({from, to, !below, dark_first, dark_first ? q : -q, row, column});
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
    if (!(std::abs(way) > share_ * reach && length > 2 * half_edge * share_ * reach)) return;
    const bool by_rows = std::abs(span.y) >= std::abs(span.x);
    const double steepness = std::abs(by_rows ? across.x : across.y);
    const double per_step = by_rows ? cell.x : cell.y;
    // In the order of the picture's pixels.
    const bool dark_first = (per_step > 0) == edge.dark_first;
    double sum = 0;
    std::uint32_t count = 0;
    Window window{};
    const double begin = by_rows ? std::min(from.y, to.y) : std::min(from.x, to.x);
    const double end = by_rows ? std::max(from.y, to.y) : std::max(from.x, to.x);
    for (double line = std::ceil(begin - 0.5); line + 0.5 <= end; line += 1) {
      const double share = (line + 0.5 - (by_rows ? from.y : from.x)) / (by_rows ? span.y : span.x);
      const Point at = from + share * span;
      double off = 0;
      if (!measure_strip(by_rows, line, by_rows ? at.x : at.y, margin * reach / steepness,
                         dark_first, off, window)) {
        return;
      }
      sum += off * steepness;
      ++count;
    }
    if (count == 0 || edges_ == most_edges) return;
    window.dark *= steepness / count;
    window.bright *= steepness / count;
    const double blurred = blurred_by(edge, window, bend_of(span, cell, by_rows));
    offsets_[edges_++] = {1 - edge.from_middle, sum / count - blurred};
  }

  /// How cells lie to the strips across one of their edges.
  Bend bend_of(Point span, Point cell, bool by_rows) const {
    const double deviation = fit_.reach / reach_in_deviations;
    const double length = std::sqrt(dot(span, span));
    const Point d = 1 / length * span;
    const double across = cell.x * d.y - cell.y * d.x;
    const double slant = std::abs(across) / std::sqrt(dot(cell, cell));
    const double strip = by_rows ? d.x / d.y : -d.y / d.x;
    Bend bend{};
    bend.wide = std::abs(across) / deviation;
    bend.high = length / (2 * half_edge) * slant / deviation;
    bend.drift = (strip - dot(cell, d) / across) * slant * (across > 0 ? 1 : -1);
    return bend;
  }

  /// The light of a cell, between dark and bright: what is around the marker is bright.
  double light_of(std::uint32_t from_row, std::uint32_t from_column, std::int32_t rows,
                  std::int32_t columns) const {
    const std::int32_t row = static_cast<std::int32_t>(from_row) + rows;
    const std::int32_t column = static_cast<std::int32_t>(from_column) + columns;
    const auto last = static_cast<std::int32_t>(cells_ + 1);
    if (row < 0 || column < 0 || row > last || column > last) return 1;
    return is_black(static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(column)) ? 0 : 1;
  }

  /// By how much the blur of the cells around an edge moves it towards bright, px: what six parts
  /// of a strip show, and what they would show of two cells without end.
  double blurred_by(const Edge& edge, const Window& window, const Bend& bend) {
    const double deviation = fit_.reach / reach_in_deviations;
    const std::int32_t out = edge.dark_first ? 1 : -1;
    const double drift = bend.drift * out;
    const double dark = window.dark / deviation, bright = window.bright / deviation;
    const double farthest = std::max(dark, bright);
    const double beyond = (0.5 - half_edge) * bend.high - std::abs(drift) * farthest;
    if (std::min(bend.wide - farthest, beyond) > spill_end) return 0;
    MARKERVP_COUNT(blurs_);
    std::array<std::array<double, 4>, 3> light;  // beside, of the edge itself, beside; dark first
    for (std::int32_t beside = -1; beside <= 1; ++beside) {
      for (std::int32_t step = 0; step < 4; ++step) {
        const std::int32_t across = (edge.dark_first ? 0 : 1) + (step - 1) * out;
        light[static_cast<std::size_t>(beside) + 1][static_cast<std::size_t>(step)] =
            edge.is_upright ? light_of(edge.row, edge.column, beside, across)
                            : light_of(edge.row, edge.column, across, beside);
      }
    }
    const double part = (dark + bright) / parts;
    std::array<double, 3> before = covered(-dark, bend.wide);
    double shift = 0;
    for (std::uint32_t i = 0; i < parts; ++i) {
      const double from = -dark + i * part, lateral = drift * (from + part / 2);
      const std::array<double, 3> until = covered(from + part, bend.wide);
      const double ahead = beside(bend.high, lateral), behind = beside(bend.high, -lateral);
      double seen = part * mixed(light, 0, ahead, behind);
      for (std::uint32_t k = 0; k < 3; ++k) {
        seen += (until[k] - before[k]) *
                (mixed(light, k + 1, ahead, behind) - mixed(light, k, ahead, behind));
      }
      shift += until[1] - before[1] - seen;
      before = until;
    }
    return deviation * shift;
  }

  /// Of boundaries a cell before the edge, there, and behind it: how much lies behind each, up to a
  /// place, blurred.
  static std::array<double, 3> covered(double place, double wide) {
    return {spill(-place - wide), spill(-place), spill(wide - place)};
  }

  /// The share of the next cell along an edge in the strips of its middle, so far aside.
  static double beside(double high, double lateral) {
    const double half = half_edge * high, far = high / 2 - lateral;
    return (spill(far - half) - spill(far + half)) / (2 * half);
  }

  static double mixed(const std::array<std::array<double, 4>, 3>& light, std::uint32_t step,
                      double ahead, double behind) {
    return behind * light[0][step] + (1 - ahead - behind) * light[1][step] + ahead * light[2][step];
  }

  /// How far the edge in one strip is from `middle` towards bright, px along it.
  bool measure_strip(bool by_rows, double line, double middle, double half, bool dark_first,
                     double& off, Window& window) {
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
    window.dark += dark_first ? middle - begin : end - middle;
    window.bright += dark_first ? end - middle : middle - begin;
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
  std::uint32_t cells_seen_ = 0, edges_seen_ = 0, strips_ = 0, pixels_ = 0, blurs_ = 0;  ///< work
  double share_ = clear_share;
};

}  // namespace

InnerShift measure_inner_edges(const CameraFrame& frame, const QuadFit& fit,
                               const LightLevels& levels, std::uint64_t word, std::uint32_t cells) {
  const FunctionScope scope(Function::cell_reading);
  return InnerEdges(frame, fit, levels, word, cells).measure();
}

}  // namespace marker
