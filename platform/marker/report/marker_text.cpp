#include <marker/report/marker_text.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <result/console.h>
#include <vp/text.h>

namespace platform {

namespace {

constexpr double degrees_per_radian = 57.29577951308232;

std::string degrees(double radians) {
  return vp::format_fixed(radians * degrees_per_radian, 1);
}

/// With so many places; with two more if fewer than two digits were left of it.
std::string error_figure(double value, int places) {
  const bool little = value > 0 && value * std::pow(10, places) < 10;
  return vp::format_fixed(value, little ? places + 2 : places);
}

std::string pose_error_text(double translation_mm, double rotation_deg) {
  return "   translation " + error_figure(translation_mm, 1) + " mm   rotation " +
         error_figure(rotation_deg, 2) + " deg";
}

}  // namespace

std::string angles_text(const Eigen::Matrix3d& r) {
  return "pitch " + degrees(std::atan2(r(2, 1), r(2, 2))) + " yaw " +
         degrees(std::asin(std::clamp(-r(2, 0), -1.0, 1.0))) + " roll " +
         degrees(std::atan2(r(1, 0), r(0, 0))) + " deg";
}

std::string error_text(const FoundMarker& found, const GroundTruth& truth) {
  const MarkerError error = measure_error(found, truth);
  std::string text = "corner " + error_figure(error.corner_px, 2) + " px";
  if (!has_pose_error(found, truth)) return text;
  return text + pose_error_text(error.translation_mm, error.rotation_deg);
}

namespace {

std::string orientation(int quarter_turns) {
  if (quarter_turns == 0) return "upright";
  return fmt::format("turned {} deg clockwise", 90 * quarter_turns);
}

std::string corners_text(const std::array<PixelPoint, 4>& corners) {
  std::string text;
  for (const PixelPoint& corner : corners) {
    text += fmt::format("{}({:.2f}, {:.2f})", text.empty() ? "" : "  ", corner.x, corner.y);
  }
  return text;
}

std::string pose_text(const Pose& pose) {
  const auto metres = [&](std::size_t axis) { return vp::format_fixed(pose.translation[axis], 3); };
  return fmt::format("t ({}, {}, {}) m   {}", metres(0), metres(1), metres(2),
                     angles_text(pose.rotation));
}

std::string fit_text(const FoundMarker& found) {
  std::string text;
  if (found.iterations) text += "   " + result::counted(*found.iterations, "iteration");
  if (found.reprojection_px) text += fmt::format(" to {:.2f} px", *found.reprojection_px);
  return text;
}

using Lines = std::vector<std::pair<std::string, std::string>>;

void add_marker(Lines& lines, const MarkerFrame& frame, const FoundMarker& found) {
  lines.emplace_back("corners px", corners_text(found.corners_px));
  if (found.residual_px) {
    lines.emplace_back("on board", fmt::format("{:.2f} px from its place", *found.residual_px));
  } else if (!frame.board || found.has_pose) {
    lines.emplace_back("pose", found.has_pose
                                   ? pose_text(found.pose) + fit_text(found)
                                   : "none: the corners admit none, or it is one of a board's");
  }
  if (const GroundTruth* truth = truth_of(frame, found)) {
    lines.emplace_back("error", error_text(found, *truth));
  } else if (frame.truth) {
    lines.emplace_back("error", another_marker_text(frame));
  }
}

std::string board_text(const FoundBoard& board) {
  if (!board.misfit.empty()) return "refused: " + board.misfit;
  std::string text = result::counted(board.markers, "marker") + "   " + pose_text(board.pose);
  if (board.residual_px) text += fmt::format("   {:.2f} px from their places", *board.residual_px);
  return text;
}

}  // namespace

std::string MarkerFrame::heading() const {
  if (markers.empty()) return "no marker";
  std::vector<std::string> texts;
  for (const FoundMarker& found : markers)
    texts.push_back(fmt::format("marker {}, {}", found.id, orientation(found.rotation)));
  return vp::join(texts, "; ");
}

Lines MarkerFrame::lines() const {
  Lines lines;
  for (const FoundMarker& found : markers) add_marker(lines, *this, found);
  if (board) lines.emplace_back("board", board_text(*board));
  return lines;
}

std::string MarkerFrame::counts_text() const {
  return threshold ? "threshold " + std::to_string(*threshold) : "";
}

std::vector<std::string> marker_summary(const facts::Summary& summary) {
  const facts::Statistic& corner_px = summary.samples("corner_px");
  if (corner_px.count() == 0) return {};
  return {"error    corner " + error_figure(corner_px.mean(), 2) + " px" +
          pose_error_text(summary.samples("translation_mm").mean(),
                          summary.samples("rotation_deg").mean()) +
          "   (mean over " + result::counted(corner_px.count(), "marker") + ")"};
}

}  // namespace platform
