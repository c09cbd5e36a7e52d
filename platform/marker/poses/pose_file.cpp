#include <marker/poses/pose_file.h>

#include <filesystem>
#include <utility>

#include <host/document.h>
#include <vp/error.h>
#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace platform::poses {

namespace {

using Json = nlohmann::ordered_json;

Pose pose_of(const Json& json) {
  Pose pose;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      pose.rotation(row, column) = json.at("rotation").at(row).at(column).get<double>();
    pose.translation[row] = json.at("translation_m").at(row).get<double>();
  }
  validate(pose);
  return pose;
}

/// What a marker and a board have in common.
void take_pose(const Json& json, FoundPose& found) {
  if (!json.contains("pose")) return;
  found.pose = pose_of(json["pose"]);
  if (!json.contains("covariance")) return;
  found.covariance.emplace();
  for (std::size_t i = 0; i < found.covariance->size(); ++i)
    (*found.covariance)[i] = json["covariance"].at(i / 6).at(i % 6).get<double>();
}

FoundPose marker_of(const Json& json, const std::string& family) {
  FoundPose found{std::to_string(json.at("id").get<int>()), family,
                  json.at("side_m").get<double>()};
  for (std::size_t i = 0; i < found.corners_px.size(); ++i) {
    const Json& corner = json.at("corners_px").at(i);
    found.corners_px[i] = {corner.at(0).get<double>(), corner.at(1).get<double>()};
  }
  take_pose(json, found);
  for (const char* residual : {"reprojection_px", "residual_px"}) {
    if (json.contains(residual)) found.residual_px = json[residual].get<double>();
  }
  if (json.contains("corrected")) found.corrected = json["corrected"].get<unsigned>();
  if (json.contains("code_cells")) found.code_cells = json["code_cells"].get<unsigned>();
  return found;
}

PoseFrame frame_of(const Json& json, const std::string& family) {
  PoseFrame frame{json.value("input", ""), json.at("index").get<std::uint64_t>()};
  if (json.contains("taken_us")) frame.taken_us = json["taken_us"].get<double>();
  for (const Json& marker : json.at("markers")) frame.found.push_back(marker_of(marker, family));
  if (json.contains("board")) {
    FoundPose& board = frame.found.emplace_back();
    board.name = "board";
    take_pose(json["board"], board);
  }
  return frame;
}

}  // namespace

std::vector<PoseFrame> read_poses(const std::string& path) {
  std::error_code ignored;
  const std::string file = std::filesystem::is_directory(path, ignored)
                               ? (std::filesystem::path(path) / "result.json").string()
                               : path;
  const Json json = host::read_json<Json>(file, "result", host::largest_result);
  std::vector<PoseFrame> frames;
  try {
    // The thesis' programs know one dictionary only.
    const Json& configuration = json.at("configuration");
    const std::string own = configuration.value("sw.dictionary_file", "");
    const std::string family = own.empty() ? configuration.value("sw.dictionary", "4x4_250")
                                           : std::filesystem::path(own).stem().string();
    for (const Json& frame : json.at("frames")) frames.push_back(frame_of(frame, family));
  } catch (const Json::exception&) {
    throw vp::InputError("'" + file +
                         "' is no result.json of a design that finds markers, or of an "
                         "earlier version: run it again");
  }
  return frames;
}

}  // namespace platform::poses
