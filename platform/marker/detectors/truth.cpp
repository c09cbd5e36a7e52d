#include <marker/detectors/truth.h>

#include <host/document.h>
#include <marker/report/marker_json.h>
#include <vp/error.h>

namespace platform::detectors {

using result::Json;

namespace {

constexpr int schema = 1;

Json to_json(const TrueMarker& marker) {
  Json json;
  json["id"] = marker.id;
  if (marker.corners_px) json["corners_px"] = corners_json(*marker.corners_px);
  if (marker.pose) json["pose"] = pose_json(*marker.pose);
  return json;
}

TrueMarker marker_from(const Json& json) {
  TrueMarker marker;
  marker.id = json.at("id").get<int>();
  if (json.contains("corners_px")) marker.corners_px = corners_from(json.at("corners_px"));
  if (json.contains("pose")) {
    marker.pose = pose_from(json.at("pose"));
    validate(*marker.pose);
  }
  return marker;
}

}  // namespace

std::array<PixelPoint, 4> corners_from(const Json& json) {
  std::array<PixelPoint, 4> corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = {json.at(i).at(0).get<double>(), json.at(i).at(1).get<double>()};
  return corners;
}

Pose pose_from(const Json& json) {
  Pose pose;
  for (int row = 0; row < 3; ++row) {
    const auto at = static_cast<std::size_t>(row);
    for (int column = 0; column < 3; ++column) {
      pose.rotation(row, column) =
          json.at("rotation").at(at).at(static_cast<std::size_t>(column)).get<double>();
    }
    pose.translation[row] = json.at("translation_m").at(at).get<double>();
  }
  return pose;
}

Truth Truth::read(const std::filesystem::path& file) {
  const Json json = host::read_json<Json>(file, "truth");
  const auto refuse = [&](const std::string& why) {
    throw vp::InputError("truth '" + file.string() + "': " + why);
  };
  if (!json.is_object() || json.value("schema", Json()) != schema)
    refuse("it needs \"schema\": " + std::to_string(schema) + " (docs/detectors.md)");
  Truth truth;
  std::string image;
  try {
    if (json.contains("ids")) truth.ids_ = json.at("ids").get<std::set<int>>();
    const Json none = Json::object();
    const Json& images = json.contains("images") ? json.at("images") : none;
    for (const auto& [name, markers] : images.items()) {
      image = name;
      std::vector<TrueMarker>& list = truth.images_[name];
      for (const Json& marker : markers) list.push_back(marker_from(marker));
    }
  } catch (const Json::exception&) {
    refuse((image.empty() ? "\"ids\" and \"images\"" : "image \"" + image + "\"") +
           ": a number is missing or of the wrong type");
  } catch (const vp::InputError& error) {
    refuse("image \"" + image + "\": " + error.what());
  }
  return truth;
}

Truth Truth::of_folder(const std::filesystem::path& folder) {
  std::error_code ignored;
  const std::filesystem::path file = folder / file_name;
  return std::filesystem::exists(file, ignored) ? read(file) : Truth();
}

void Truth::add(const std::string& image, const Scene& scene) {
  images_[image] = *truth_of(scene).markers;
}

ImageTruth Truth::of(const std::string& image) const {
  const auto found = images_.find(image);
  if (found == images_.end()) return {{}, ids_};
  return {found->second, {}};
}

std::string Truth::json() const {
  std::string text = "{\"schema\": " + std::to_string(schema);
  if (ids_) text += ",\n \"ids\": " + Json(*ids_).dump();
  text += ",\n \"images\": {";
  const char* separator = "\n  ";
  for (const auto& [image, markers] : images_) {
    Json list = Json::array();
    for (const TrueMarker& marker : markers) list.push_back(to_json(marker));
    text += separator + Json(image).dump() + ": " + list.dump();
    separator = ",\n  ";
  }
  return text + "}}\n";
}

ImageTruth truth_of(const Scene& scene) {
  std::vector<TrueMarker> markers;
  for (const GroundTruth& truth : ground_truths(scene)) {
    markers.push_back({truth.marker_id, truth.corners_px, {}});
    if (truth.is_usual) markers.back().pose = truth.pose;
  }
  return {markers, {}};
}

}  // namespace platform::detectors
