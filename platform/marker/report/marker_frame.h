#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <facts/result.h>
#include <marker/feature_set.h>
#include <marker/scene/pose.h>
#include <marker/scene/scene.h>

/// What the marker designs find in a frame, as plain values.

namespace platform {

/// How well a pose is known: covariance of a small turn about the camera's axes, rad, followed by
/// its translation, m; 6 × 6, row by row.
using PoseCovariance = std::array<double, 36>;

/// How a pose moves along and about the camera's axes, where a filter follows it.
struct PoseMotion {
  std::uint32_t frames = 0;  ///< of which the pose is made; 1: it begins anew
  std::array<double, 3> velocity_m_s{};
  std::array<double, 3> turn_rate_rad_s{};
};

/// A marker that the software identified.
struct FoundMarker {
  int id = 0;
  int rotation = 0;                      ///< quarter turns clockwise from upright, 0 to 3
  std::array<PixelPoint, 4> corners_px;  ///< clockwise from the marker's own top left
  double side_m = marker_side_m;         ///< of its black square, as the program takes it to be
  bool has_pose = true;  ///< false: the corners admit none, or it is one of a board's
  Pose pose;
  // Of the pose, where the program tells them.
  std::optional<double> reprojection_px;  ///< mean distance of the corners from their projections
  std::optional<std::uint32_t> iterations;
  std::optional<std::uint32_t> corrected = {};   ///< cells of its code that were wrong
  std::optional<std::uint32_t> code_cells = {};  ///< of its code, where no name of it tells
  std::optional<PoseCovariance> covariance;
  std::optional<PoseMotion> motion = {};
  /// Of a board's marker: how far its corners are from where the board has them, px, root of the
  /// mean square.
  std::optional<double> residual_px = {};
};

/// How the grey levels of a frame were taken for light.
struct ResponseUse {
  std::string origin;   ///< "given", "found" or "unknown"
  double exponent = 0;  ///< light is this power of the level; 0: levels were taken for light, or a
                        ///< table says
};

/// The pose of several markers with known places to each other.
struct FoundBoard {
  std::uint32_t markers = 0;  ///< of which the pose was made
  Pose pose;
  PoseCovariance covariance{};
  std::optional<PoseMotion> motion = {};
  std::optional<double> residual_px = {};  ///< the same of all its markers
  /// Why the markers cannot be those of this board, so that its pose is wrong; empty: they fit.
  std::string misfit = {};
  std::vector<std::string> layouts = {};  ///< of a misfit: boards that the markers fit
};

/// What a picture shows besides the marker. Not part of result.json.
struct Features {
  std::vector<marker::Corner> corners;
  std::vector<marker::BoundingBox> blobs;
  /// Corners of each candidate as pixel indices, clockwise from the top left.
  std::vector<std::array<PixelPoint, 4>> candidates;
};

/// What the marker application says of a frame.
class MarkerFrame : public facts::UnitExtra {
 public:
  /// Simulated time: the middle of the exposure, or when the work on the image began.
  std::optional<std::uint64_t> taken_ps;
  /// Grey level at which this frame was made binary; none: each pixel had one of its own.
  std::optional<std::uint32_t> threshold;
  std::vector<FoundMarker> markers;
  std::optional<FoundBoard> board;         ///< where the program looks for one, and sees it
  std::optional<ResponseUse> response;     ///< none: levels are known to be light
  std::optional<GroundTruth> truth;        ///< of the scene's marker, where known
  std::vector<GroundTruth> further_truth;  ///< of the other markers in the scene
  Camera camera;                           ///< that took the image
  Features features;

  std::string heading() const override;
  std::vector<std::pair<std::string, std::string>> lines() const override;
  std::string counts_text() const override;
  void add_members(Place place, Json& json) const override;
  void add_samples(const Sample& sample) const override;
  std::optional<std::string> misfit() const override;
};

/// The frame's; it gets one if it has none.
MarkerFrame& marker_frame(facts::UnitReport& frame);
/// The frame's; an empty one if it has none.
const MarkerFrame& marker_frame(const facts::UnitReport& frame);

/// What the marker designs do.
const facts::Work& marker_work();

/// Takes camera and truth from the frame's input.
void take_truth(facts::UnitReport& frame);

/// Sets what the frame counts for: markers found, a wrong one, the scene's own overlooked.
void judge(facts::UnitReport& frame);

/// Distance of a found marker from the truth.
struct MarkerError {
  double corner_px = 0;       ///< mean distance of the four corners
  double translation_mm = 0;  ///< distance of the translations
  double rotation_deg = 0;    ///< angle of the rotation between the two
};

/// Translation and rotation are meaningless unless has_pose_error().
MarkerError measure_error(const FoundMarker& found, const GroundTruth& truth);

/// False: the marker has no pose, or none that could be right, for it is larger or smaller than the
/// program knows.
bool has_pose_error(const FoundMarker& found, const GroundTruth& truth);

/// The truth of this marker: of those with its ID the one that is nearest. Null if the scene has
/// none, or is not known.
const GroundTruth* truth_of(const MarkerFrame& frame, const FoundMarker& found);

/// For a marker that the scene does not have: "another marker: the scene has 0 and 9 more".
std::string another_marker_text(const MarkerFrame& frame);

}  // namespace platform
