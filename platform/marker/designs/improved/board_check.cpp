#include <marker/designs/improved/board_check.h>

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace platform {

namespace {

using Homography = Eigen::Matrix3d;

bool is_alone(const BoardMarker& marker, const std::vector<BoardMarker>& all) {
  return std::count_if(all.begin(), all.end(),
                       [&](const BoardMarker& other) { return other.id == marker.id; }) == 1;
}

double mean_side(const BoardMarker& marker) {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const PixelPoint &a = marker.ideal_px[i], &b = marker.ideal_px[(i + 1) % 4];
    sum += std::hypot(a.x - b.x, a.y - b.y);
  }
  return sum / 4;
}

std::optional<marker::Places> places_of(const marker::Board& board, const BoardMarker& marker) {
  marker::Places places;
  if (!board.find(static_cast<std::uint32_t>(marker.id), places)) return std::nullopt;
  return places;
}

/// How far a place is seen from `ideal_px`, px.
PixelPoint offset(const Camera& camera, const Pose& pose, const marker::Place& place,
                  const PixelPoint& ideal_px) {
  const Eigen::Vector3d p = transform(pose, {place[0], place[1], place[2]});
  return {camera.fx * p.x() / p.z() + camera.cx - ideal_px.x,
          camera.fy * p.y() / p.z() + camera.cy - ideal_px.y};
}

/// Adds up distances between corners.
class Residual {
 public:
  void add(double x, double y) { squares_ += x * x + y * y; }
  void add_marker(double side) {
    sides_ += side;
    ++markers_;
  }
  double px() const { return markers_ == 0 ? 0 : std::sqrt(squares_ / (4.0 * markers_)); }
  double share() const { return markers_ == 0 ? 0 : px() * markers_ / sides_; }

 private:
  double squares_ = 0, sides_ = 0;
  std::size_t markers_ = 0;
};

}  // namespace

double reprojection_px(const Camera& camera, const Pose& pose, double side_m,
                       const std::array<PixelPoint, 4>& ideal_px) {
  const marker::Places places = marker::single_marker(side_m);
  double sum = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const PixelPoint off = offset(camera, pose, places[i], ideal_px[i]);
    sum += std::hypot(off.x, off.y);
  }
  return sum / 4;
}

std::string text_of_doubles(const marker::Board& board, const std::vector<BoardMarker>& markers) {
  std::set<int> ids;
  for (const BoardMarker& marker : markers) {
    if (!is_alone(marker, markers) && places_of(board, marker)) ids.insert(marker.id);
  }
  if (ids.empty()) return "";
  return fmt::format(
      "more than one marker of ID {}: which one is the board's is not known, so they do not count "
      "for its pose; is there one board in view?",
      fmt::join(ids, ", "));
}

BoardFit check_board(const marker::Board& board, const Camera& camera, const Pose& pose,
                     std::vector<BoardMarker>& markers) {
  BoardFit fit;
  Residual all;
  for (BoardMarker& marker : markers) {
    if (!is_alone(marker, markers)) continue;
    const auto places = places_of(board, marker);
    if (!places) ++fit.strangers;
    if (!places) continue;
    Residual own;
    for (std::size_t i = 0; i < 4; ++i) {
      const marker::Place& place = (*places)[i];
      const PixelPoint off = offset(camera, pose, place, marker.ideal_px[i]);
      own.add(off.x, off.y);
      all.add(off.x, off.y);
    }
    own.add_marker(mean_side(marker));
    all.add_marker(mean_side(marker));
    marker.residual_px = own.px();
  }
  fit.residual_px = all.px();
  fit.share = all.share();
  return fit;
}

namespace {

/// A layout that is tried, in units of a square (of a grid: of marker and gap).
struct Candidate {
  marker::Board::Kind kind;
  std::uint32_t columns;
  bool white_first;
  double ratio;  ///< side of a marker, of a square
};

constexpr std::uint32_t most_columns = 30;
constexpr std::uint32_t any_rows = 1000;
/// A residual that no other ratio needs to be tried for.
constexpr double good_share = 0.02;

marker::Board board_of(const Candidate& candidate, const marker::Board& asked) {
  marker::Board board;
  board.kind = candidate.kind;
  board.grid = {candidate.columns, any_rows, candidate.ratio, 1 - candidate.ratio,
                asked.kind == marker::Board::Kind::grid ? asked.grid.first_id : 0};
  board.charuco = {candidate.columns, any_rows, 1, candidate.ratio, candidate.white_first};
  return board;
}

/// The least-squares homography from the board's plane to the picture; the residual says whether
/// there is one. Coordinates are scaled first, so that the squares weigh alike (Hartley 1997).
class PlaneFit {
 public:
  /// The share of a side by which the corners are elsewhere; infinite if a marker is not on it.
  double share(const marker::Board& board, const std::vector<BoardMarker>& markers) {
    Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
    std::vector<marker::Places> places;
    for (const BoardMarker& marker : markers) {
      const auto found = places_of(board, marker);
      if (!found) return std::numeric_limits<double>::infinity();
      places.push_back(*found);
    }
    const double unit = std::max(extent(places), 1e-9);
    for (std::size_t m = 0; m < markers.size(); ++m) {
      for (std::size_t i = 0; i < 4; ++i) {
        const double u = places[m][i][0] / unit, v = places[m][i][1] / unit;
        const double x = markers[m].ideal_px[i].x / px_unit, y = markers[m].ideal_px[i].y / px_unit;
        Eigen::Matrix<double, 2, 9> rows;
        rows << u, v, 1, 0, 0, 0, -x * u, -x * v, -x, 0, 0, 0, u, v, 1, -y * u, -y * v, -y;
        normal += rows.transpose() * rows;
      }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(normal);
    const Eigen::Matrix<double, 9, 1> h = solver.eigenvectors().col(0);
    Residual residual;
    for (std::size_t m = 0; m < markers.size(); ++m) {
      for (std::size_t i = 0; i < 4; ++i) {
        const double u = places[m][i][0] / unit, v = places[m][i][1] / unit;
        const double w = h[6] * u + h[7] * v + h[8];
        residual.add(px_unit * (h[0] * u + h[1] * v + h[2]) / w - markers[m].ideal_px[i].x,
                     px_unit * (h[3] * u + h[4] * v + h[5]) / w - markers[m].ideal_px[i].y);
      }
      residual.add_marker(mean_side(markers[m]));
    }
    return residual.share();
  }

 private:
  static constexpr double px_unit = 500;

  static double extent(const std::vector<marker::Places>& places) {
    double most = 0;
    for (const marker::Places& each : places)
      for (const marker::Place& place : each) most = std::max({most, place[0], place[1]});
    return most;
  }
};

std::vector<Candidate> candidates(double ratio) {
  using Kind = marker::Board::Kind;
  std::vector<Candidate> list;
  for (std::uint32_t columns = 1; columns <= most_columns; ++columns) {
    for (const bool white_first : {false, true})
      list.push_back({Kind::charuco, columns, white_first, ratio});
    list.push_back({Kind::grid, columns, false, ratio});
  }
  return list;
}

double ratio_of(const marker::Board& board) {
  if (board.kind == marker::Board::Kind::grid)
    return board.grid.side / (board.grid.side + board.grid.gap);
  return board.charuco.side / board.charuco.square;
}

std::uint32_t rows_needed(const Candidate& candidate, const marker::Board& asked,
                          const std::vector<BoardMarker>& markers) {
  const marker::Board board = board_of(candidate, asked);
  double last = 0;
  for (const BoardMarker& marker : markers)
    if (const auto places = places_of(board, marker)) last = std::max(last, (*places)[0][1]);
  return static_cast<std::uint32_t>(last) + 1;
}

std::string text(const Candidate& candidate, const marker::Board& asked,
                 const std::vector<BoardMarker>& markers) {
  const bool is_grid = candidate.kind == marker::Board::Kind::grid;
  std::string text = fmt::format("sw.board={} sw.board_columns={} sw.board_rows={} (or more)",
                                 is_grid ? "grid" : "charuco", candidate.columns,
                                 rows_needed(candidate, asked, markers));
  const double square = asked.marker_side / candidate.ratio;
  if (is_grid) return text + fmt::format(" sw.board_gap={:.3g}m", square - asked.marker_side);
  return text + fmt::format(" sw.board_white_first={} sw.board_square={:.3g}m",
                            candidate.white_first ? 1 : 0, square);
}

struct Scored {
  Candidate candidate;
  double share;
};

/// With the ratio that fits best, tried in steps; the one that was asked for where that is as good.
Scored best_ratio(const Candidate& of, const marker::Board& asked,
                  const std::vector<BoardMarker>& markers) {
  PlaneFit plane;
  Scored best{of, plane.share(board_of(of, asked), markers)};
  if (best.share <= good_share || std::isinf(best.share)) return best;
  for (int percent = 30; percent <= 98; ++percent) {
    Candidate candidate = of;
    candidate.ratio = percent / 100.0;
    const double share = plane.share(board_of(candidate, asked), markers);
    if (share < best.share) best = {candidate, share};
  }
  return best;
}

}  // namespace

std::vector<std::string> fitting_layouts(const marker::Board& board,
                                         const std::vector<BoardMarker>& markers) {
  std::vector<BoardMarker> unique;
  for (const BoardMarker& marker : markers)
    if (is_alone(marker, markers)) unique.push_back(marker);
  if (unique.size() < 2) return {};
  std::vector<Scored> fits;
  for (const Candidate& candidate : candidates(ratio_of(board))) {
    const Scored scored = best_ratio(candidate, board, unique);
    if (scored.share <= BoardFit::most_share / 2) fits.push_back(scored);
  }
  std::stable_sort(fits.begin(), fits.end(),
                   [](const Scored& a, const Scored& b) { return a.share < b.share; });
  std::vector<std::string> texts;
  constexpr std::size_t most = 3;
  for (const Scored& fit : fits) {
    if (texts.size() == most || fit.share > 2 * fits.front().share + 0.005) break;
    texts.push_back(text(fit.candidate, board, unique));
  }
  return texts;
}

}  // namespace platform
