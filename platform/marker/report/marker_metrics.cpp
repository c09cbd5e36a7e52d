#include <marker/report/marker_metrics.h>

#include <marker/report/marker_frame.h>
#include <result/metrics.h>

#include <algorithm>

namespace platform {

namespace {

using result::Json;
using Found = result::UnitMetrics::Found;

/// Calls found("NAME.PART", value) for each number of an object, found(NAME, value) for a number.
void find_numbers(const std::string& name, const Json& json, const Found& found) {
  if (json.is_number()) found(name, json.get<double>());
  if (!json.is_object()) return;
  for (const auto& [part, value] : json.items()) {
    if (value.is_number()) found(name + "." + part, value.get<double>());
  }
}

bool take(const std::string& name, const Json& value, const Found& found) {
  if (name == "scene_marker" || name == "further_scene_markers" || name == "taken_us") return true;
  if (name != "markers") return false;
  found("markers", static_cast<double>(value.size()));
  for (const Json& marker : value) {
    for (const char* figure : {"error", "reprojection_px", "iterations"}) {
      if (marker.contains(figure)) find_numbers(figure, marker[figure], found);
    }
  }
  return true;
}

bool has_marker(const Json& frame, const Json& id) {
  const auto markers = frame.find("markers");
  return markers != frame.end() &&
         std::any_of(markers->begin(), markers->end(),
                     [&](const Json& marker) { return marker.value("id", Json()) == id; });
}

void rates(const Json& frame, const Found& found) {
  if (frame.contains("scene_marker"))
    found("detection_rate", has_marker(frame, frame["scene_marker"]) ? 1 : 0);
}

std::vector<facts::Figure> marker_figures() {
  using facts::Better;
  std::vector<facts::Figure> figures = marker_work().declared();
  const std::vector<facts::Figure> own{
      {"summary.detection_rate", "1",
       "share of the scenes whose marker was found, with its ID; 1: all", Better::more},
      {"frames.markers", "1", "markers found"},
      {"frames.threshold", "1",
       "grey level at which the image was made binary, if all its pixels had the same"},
      {"frames.error.corner_px", "px", "distance of the marker's corners from the truth",
       Better::less, "Corner error"},
      {"frames.error.translation_mm", "mm", "distance of the marker's place from the truth",
       Better::less, "Translation error"},
      {"frames.error.rotation_deg", "°", "angle of the marker's rotation from the truth",
       Better::less, "Rotation error"},
      {"frames.reprojection_px", "px", "distance of the corners from those of the pose",
       Better::less},
      {"frames.iterations", "1", "iterations of the pose", Better::less}};
  figures.insert(figures.end(), own.begin(), own.end());
  return figures;
}

}  // namespace

bool register_marker_metrics() {
  static const result::UnitMetrics metrics(take, rates, marker_figures());
  return true;
}

}  // namespace platform
