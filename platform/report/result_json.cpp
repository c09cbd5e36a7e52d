#include <report/result_json.h>

#include <charconv>
#include <cstdlib>

#include <report/design_json.h>
#include <report/error_measure.h>
#include <vp/text.h>

namespace platform::report {

namespace {

constexpr int px_places = 6;
constexpr int rotation_places = 9;
constexpr int metre_places = 9;
constexpr int mm_places = 6;
constexpr int degree_places = 6;
constexpr int us_places = 6;
constexpr int fps_places = 6;
constexpr int second_places = 3;

Json corners_json(const std::array<PixelPoint, 4>& corners) {
  Json array = Json::array();
  for (const PixelPoint& corner : corners) {
    array.push_back({rounded(corner.x, px_places), rounded(corner.y, px_places)});
  }
  return array;
}

Json pose_json(const Pose& pose) {
  Json rotation = Json::array();
  for (const auto& row : pose.rotation.rowwise()) {
    Json values = Json::array();
    for (const double value : row) values.push_back(rounded(value, rotation_places));
    rotation.push_back(values);
  }
  Json translation = Json::array();
  for (const double value : pose.translation) translation.push_back(rounded(value, metre_places));
  Json json;
  json["rotation"] = rotation;
  json["translation_m"] = translation;
  return json;
}

Json error_json(const FoundMarker& found, const GroundTruth& truth) {
  const MarkerError error = measure_error(found, truth);
  Json json;
  json["corner_px"] = rounded(error.corner_px, px_places);
  if (!found.has_pose) return json;
  json["translation_mm"] = rounded(error.translation_mm, mm_places);
  json["rotation_deg"] = rounded(error.rotation_deg, degree_places);
  return json;
}

Json marker_json(const FrameReport& frame, const FoundMarker& found) {
  Json json;
  json["id"] = found.id;
  json["rotation"] = found.rotation;
  json["corners_px"] = corners_json(found.corners_px);
  if (found.has_pose) {
    json["pose"] = pose_json(found.pose);
    json["reprojection_px"] = rounded(found.reprojection_px, px_places);
    json["iterations"] = found.iterations;
  }
  if (const GroundTruth* truth = truth_of(frame, found)) {
    json["truth"]["corners_px"] = corners_json(truth->corners_px);
    json["truth"]["pose"] = pose_json(truth->pose);
    json["error"] = error_json(found, *truth);
  }
  return json;
}

Json counts_json(const Counts& counts) {
  Json json;
  json["corners"] = counts.corners;
  json["blobs"] = counts.blobs;
  json["feature_words"] = counts.feature_words;
  json["candidates"] = counts.candidates;
  json["feature_overflow"] = counts.feature_overflow;
  json["label_overflow"] = counts.label_overflow;
  json["bridge_overflow"] = counts.bridge_overflow;
  json["crossing_overflow"] = counts.crossing_overflow;
  json["software_overflow"] = counts.software_overflow;
  json["malformed"] = counts.malformed;
  return json;
}

}  // namespace

double rounded(double value, int places) {
  const std::string text = vp::format_fixed(value, places);
  double result = 0;
  std::from_chars(text.data(), text.data() + text.size(), result);
  return result;
}

Json to_json(const FrameReport& frame) {
  Json json;
  json["input"] = frame.input;
  json["index"] = frame.index;
  json["threshold"] = frame.threshold;
  if (!frame.delivered()) json["gave_up"] = frame.gave_up;
  if (frame.truth) json["scene_marker"] = frame.truth->marker_id;
  json["counts"] = counts_json(frame.counts);
  json["markers"] = Json::array();
  for (const FoundMarker& found : frame.markers)
    json["markers"].push_back(marker_json(frame, found));
  json["time_us"] = Json::object();
  for (const StageTime& time : frame.times) {
    json["time_us"][time.name] = rounded(static_cast<double>(time.ps) / ps_per_us, us_places);
  }
  if (!frame.energy.empty()) json["energy_mj"] = energy_json(frame.energy);
  if (!frame.warnings.empty()) json["warnings"] = frame.warnings;
  return json;
}

Json to_json(const Summary& summary) {
  Json json;
  json["frames"] = summary.frames();
  json["delivered"] = summary.delivered();
  json["detected"] = summary.detected();
  if (summary.fps().count() > 0) {
    json["fps"]["mean"] = rounded(summary.mean_fps(), fps_places);
    json["fps"]["min"] = rounded(summary.fps().min(), fps_places);
    json["fps"]["max"] = rounded(summary.fps().max(), fps_places);
    json["latency_us"]["mean"] = rounded(summary.latency_us().mean(), us_places);
    json["latency_us"]["max"] = rounded(summary.latency_us().max(), us_places);
  }
  return json;
}

Json stages_json(const Summary& summary) {
  Json json = Json::array();
  for (const Summary::Stage& stage : summary.stages()) {
    Json entry;
    entry["name"] = stage.name;
    if (!stage.part_of.empty()) entry["part_of"] = stage.part_of;
    json.push_back(entry);
  }
  return json;
}

Json to_json(const ProgramEnd& end) {
  Json json;
  json["exit_code"] = end.exit_code;
  json["time_us"] = rounded(static_cast<double>(end.ps) / ps_per_us, us_places);
  return json;
}

Json to_json(const Provenance& provenance) {
  Json json;
  json["program"] = provenance.program;
  json["version"] = provenance.version;
  if (!provenance.revision.empty()) json["revision"] = provenance.revision;
  json["configuration_hash"] = provenance.configuration_hash;
  json["command_line"] = provenance.command_line;
  json["host"] = provenance.host;
  json["date"] = provenance.date;
  json["wall_time_s"] = rounded(provenance.wall_time_s, second_places);
  for (const auto& [name, value] : provenance.details) json[name] = value;
  return json;
}

}  // namespace platform::report
