#pragma once

#include <marker/camera.h>
#include <marker/geometry.h>

#include <array>
#include <cstdint>

namespace marker {

/// A point of a board, m: u right, v down, w away from the viewer.
using Place = std::array<double, 3>;

/// The corners of a square marker on its board, clockwise from the marker's own top left.
using Places = std::array<Place, 4>;

/// The only marker of a board whose origin is that marker's top left corner. `side` in m.
Places single_marker(double side);

/// Markers in rows and columns, `gap` apart; IDs count row by row. The origin is the top left
/// corner of the first one.
struct GridBoard {
  std::uint32_t columns, rows;
  double side, gap;        ///< m
  std::uint32_t first_id;  ///< of the top left marker

  /// False if the board has no such marker.
  bool find(std::uint32_t id, Places& places) const;
};

/// A chessboard with a marker in the middle of each white square; IDs count row by row. The origin
/// is the top left corner of the board.
struct CharucoBoard {
  std::uint32_t columns, rows;  ///< squares
  double square, side;          ///< m: of a square, and of a marker
  bool white_first;             ///< the top left square is white (OpenCV up to 4.6, even rows)

  /// False if the board has no such marker.
  bool find(std::uint32_t id, Places& places) const;
};

/// The covariance of corners each of which is off by `sigma` px in x and in y, independently.
std::array<double, 64> independent_corners(double sigma);

/// What makes a marker's eight coordinates independent, each of variance 1: the inverse of their
/// covariance's Cholesky factor, row by row up to the diagonal.
using CornerWeights = std::array<double, 36>;

/// `covariance`: px², row by row, in the order x0 y0 x1 … y3; as QuadFit has it.
CornerWeights weights_of(const std::array<double, 64>& covariance);

/// A marker that was found and identified.
struct SeenMarker {
  Places places;
  Quad corners;  ///< ideal px, in the order of `places`
  CornerWeights weights;
  /// How they move, px, with what all markers of the picture share (QuadFit::common), of which
  /// `weights` know nothing.
  std::array<double, 8> common;
};

/// Where the board is: X = R·U + T.
struct BoardPose {
  std::array<double, 9> rotation;     ///< R, row by row
  std::array<double, 3> translation;  ///< T, m
  /// Of a small turn about the camera's axes, rad, followed by T, m; 6 × 6, row by row.
  std::array<double, 36> covariance;
  double chi_squared;  ///< of the corners; expected: their 8 coordinates a marker, less 6
};

struct BoardPoses {
  bool valid;  ///< false: the corners admit no pose
  BoardPose best;
  /// What the other of the two solutions that a plane has became; `best` again if both led there.
  /// Where its chi_squared is not much larger, the corners do not tell which is true; where it is
  /// some thousand times as large, it is as it was before any step.
  BoardPose other;
};

/// IPPE (Collins and Bartoli 2014) on the largest marker gives two poses; the better one is refined
/// by Gauss–Newton on the corners of all markers, weighted by their covariances, and so is the
/// other, unless it is far worse. What all markers share moves no weight, since it would leave a
/// marker's size unused: it widens the covariance, and the corners are expected to show it.
BoardPoses estimate_board_pose(const SeenMarker* markers, std::uint32_t count,
                               const Camera& camera);

}  // namespace marker
