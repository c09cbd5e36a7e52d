#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <marker/report/marker_frame.h>

/// How others describe a marker. The camera's frame is the same for all of them: x right, y down, z
/// forward (REP 103 of ROS calls it an optical frame).
namespace platform::poses {

/// Where a marker's frame is, in which order its corners come, and where the picture begins.
struct Convention {
  const char* name;         ///< "opencv"
  bool in_middle;           ///< the frame is in the marker's middle, not in its top left corner
  bool is_z_out;            ///< x right, y up, z to the viewer; else x right, y down, z away
  bool from_bottom_left;    ///< corners from there, counter-clockwise; else from the top left,
                            ///< clockwise
  double first_centre_px;   ///< both coordinates of the first pixel's centre
  bool turns_apriltag;      ///< AprilTag's families are upright as its own library has them
  const char* description;  ///< one line
};

/// The product's own, OpenCV's, AprilTag 3's, and that of ROS' nodes.
const std::vector<Convention>& conventions();

/// A marker, or a board, as result.json or another convention has it.
struct FoundPose {
  std::string name;    ///< "7"; "board"
  std::string family;  ///< "4x4_250"; empty: of a board
  double side_m = 0;   ///< of a marker
  std::array<PixelPoint, 4> corners_px{};
  std::optional<Pose> pose = {};
  /// result.json: of a small turn about the camera's axes, rad, followed by the translation, m; by
  /// a convention: of the translation, followed by the turn, as ROS has it.
  std::optional<PoseCovariance> covariance = {};
  /// How far the corners are from where their pose, or that of their board, has them.
  std::optional<double> residual_px = {};
  std::optional<unsigned> corrected = {};   ///< wrong cells of its code
  std::optional<unsigned> code_cells = {};  ///< of its code, where the family's name does not tell

  bool is_board() const { return family.empty(); }
};

/// The same marker, as result.json has it, if its side is another one: distances and what is unsure
/// of them are in proportion.
FoundPose with_side(const FoundPose& found, double side_m);

/// From result.json to a convention. A board keeps its frame: top left corner, x right, y down, z
/// away, as OpenCV has it from 4.7 on.
FoundPose in_convention(const Convention& convention, const FoundPose& found);

}  // namespace platform::poses
