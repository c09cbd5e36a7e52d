#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <marker/marker_detector.h>
#include <marker/scene/pose.h>

namespace platform {

/// A marker as a frame shows it.
struct BoardMarker {
  int id = 0;
  std::array<PixelPoint, 4> ideal_px;  ///< clockwise from its own top left, freed from the lens
  std::optional<double> residual_px;   ///< set by check_board()
};

/// Whether markers can be those of a board.
struct BoardFit {
  double residual_px = 0;     ///< root of the mean square over the corners of the markers on it
  double share = 0;           ///< of the mean side of these markers
  std::size_t strangers = 0;  ///< seen once, and not on the board
  /// False: it is another board.
  bool is_good() const { return share <= most_share || residual_px <= least_px; }
  /// It may be another board with sizes that are a little different, or a lens is not calibrated.
  bool is_odd() const { return share > usual_share && residual_px > least_px; }

  /// A board of another layout has corners by a good part of a side elsewhere. Photographs of a
  /// board whose camera is calibrated come to 1 to 2 %; squares taken to be 3 % too small to 3.3 %.
  static constexpr double most_share = 0.12;
  static constexpr double usual_share = 0.03;
  static constexpr double least_px = 0.5;
};

/// How far the corners of a marker are from where its pose has them, px, mean.
double reprojection_px(const Camera& camera, const Pose& pose, double side_m,
                       const std::array<PixelPoint, 4>& ideal_px);

/// How far the corners are from where the board has them, seen by `camera` at `pose`; sets each
/// marker's residual. Markers of an ID that is seen twice count for nothing.
BoardFit check_board(const marker::Board& board, const Camera& camera, const Pose& pose,
                     std::vector<BoardMarker>& markers);

/// What to tell of the board's markers that are seen more than once, which count for nothing: two
/// boards may be in view. Empty if each is seen once.
std::string text_of_doubles(const marker::Board& board, const std::vector<BoardMarker>& markers);

/// The boards, as settings of the program, that all these markers fit: of those that fit about as
/// well as the best, a few, the simplest first. None if fewer than two markers are seen, which fit
/// any. `board` says the size of a marker.
std::vector<std::string> fitting_layouts(const marker::Board& board,
                                         const std::vector<BoardMarker>& markers);

}  // namespace platform
