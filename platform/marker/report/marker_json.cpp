#include <marker/report/marker_json.h>

#include <marker/report/marker_frame.h>
#include <result/result_json.h>

#include <charconv>

namespace platform {

namespace {

using Json = nlohmann::ordered_json;

constexpr int us_places = 6;
constexpr int px_places = 6;
constexpr int rotation_places = 9;
constexpr int metre_places = 9;
constexpr int mm_places = 6;
constexpr int degree_places = 6;
constexpr int exponent_places = 4;

}  // namespace

Json corners_json(const std::array<PixelPoint, 4>& corners) {
  Json array = Json::array();
  for (const PixelPoint& corner : corners) {
    array.push_back({result::rounded(corner.x, px_places), result::rounded(corner.y, px_places)});
  }
  return array;
}

Json pose_json(const Pose& pose) {
  Json rotation = Json::array();
  for (const auto& row : pose.rotation.rowwise()) {
    Json values = Json::array();
    for (const double value : row) values.push_back(result::rounded(value, rotation_places));
    rotation.push_back(values);
  }
  Json translation = Json::array();
  for (const double value : pose.translation)
    translation.push_back(result::rounded(value, metre_places));
  Json json;
  json["rotation"] = rotation;
  json["translation_m"] = translation;
  return json;
}

namespace {

/// To six digits: the smallest of them are 10⁻¹² times the largest.
double six_digits(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, 5);
  double result = 0;
  std::from_chars(text, end.ptr, result);
  return result;
}

}  // namespace

Json covariance_json(const PoseCovariance& covariance) {
  Json rows = Json::array();
  for (std::size_t row = 0; row < 6; ++row) {
    Json values = Json::array();
    for (std::size_t column = 0; column < 6; ++column)
      values.push_back(six_digits(covariance[row * 6 + column]));
    rows.push_back(values);
  }
  return rows;
}

namespace {

Json motion_json(const PoseMotion& motion) {
  Json json = {{"frames", motion.frames}};
  for (const double value : motion.velocity_m_s) json["velocity_m_s"].push_back(six_digits(value));
  for (const double value : motion.turn_rate_rad_s)
    json["turn_rate_rad_s"].push_back(six_digits(value));
  return json;
}

Json board_json(const FoundBoard& board) {
  Json json = {{"markers", board.markers}};
  if (board.residual_px) json["residual_px"] = result::rounded(*board.residual_px, px_places);
  if (!board.misfit.empty()) {
    json["refused"] = board.misfit;
    json["layouts"] = board.layouts;
    return json;
  }
  json["pose"] = pose_json(board.pose);
  json["covariance"] = covariance_json(board.covariance);
  if (board.motion) json["motion"] = motion_json(*board.motion);
  return json;
}

Json error_json(const FoundMarker& found, const GroundTruth& truth) {
  const MarkerError error = measure_error(found, truth);
  Json json;
  json["corner_px"] = result::rounded(error.corner_px, px_places);
  if (!has_pose_error(found, truth)) return json;
  json["translation_mm"] = result::rounded(error.translation_mm, mm_places);
  json["rotation_deg"] = result::rounded(error.rotation_deg, degree_places);
  return json;
}

Json marker_json(const MarkerFrame& frame, const FoundMarker& found) {
  Json json;
  json["id"] = found.id;
  json["rotation"] = found.rotation;
  json["side_m"] = found.side_m;
  if (found.corrected) json["corrected"] = *found.corrected;
  if (found.code_cells) json["code_cells"] = *found.code_cells;
  json["corners_px"] = corners_json(found.corners_px);
  if (found.has_pose) {
    json["pose"] = pose_json(found.pose);
    if (found.reprojection_px)
      json["reprojection_px"] = result::rounded(*found.reprojection_px, px_places);
    if (found.iterations) json["iterations"] = *found.iterations;
    if (found.covariance) json["covariance"] = covariance_json(*found.covariance);
    if (found.motion) json["motion"] = motion_json(*found.motion);
  }
  if (found.residual_px) json["residual_px"] = result::rounded(*found.residual_px, px_places);
  if (const GroundTruth* truth = truth_of(frame, found)) {
    json["truth"]["corners_px"] = corners_json(truth->corners_px);
    if (truth->is_usual) json["truth"]["pose"] = pose_json(truth->pose);
    json["error"] = error_json(found, *truth);
  }
  return json;
}

}  // namespace

void MarkerFrame::add_members(Place place, Json& json) const {
  switch (place) {
    case Place::behind_index:
      if (taken_ps)
        json["taken_us"] =
            result::rounded(static_cast<double>(*taken_ps) / facts::ps_per_us, us_places);
      if (threshold) json["threshold"] = *threshold;
      return;
    case Place::before_counts:
      if (truth) json["scene_marker"] = truth->marker_id;
      for (const GroundTruth& other : further_truth)
        json["further_scene_markers"].push_back(other.marker_id);
      return;
    case Place::behind_counts:
      json["markers"] = Json::array();
      for (const FoundMarker& found : markers) json["markers"].push_back(marker_json(*this, found));
      if (board) json["board"] = board_json(*board);
      if (response) {
        json["response"]["origin"] = response->origin;
        if (response->exponent > 0)
          json["response"]["exponent"] = result::rounded(response->exponent, exponent_places);
      }
      return;
  }
}

}  // namespace platform
