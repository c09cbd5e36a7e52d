#include <fmt/format.h>

#include <cmath>

#include <marker/poses/pose_selection.h>
#include <marker/poses/pose_text.h>
#include <marker/poses/ros_text.h>
#include <marker/report/marker_json.h>
#include <result/result_json.h>
#include <result/table.h>
#include <nlohmann/json.hpp>

namespace platform::poses {

namespace {

using Json = nlohmann::ordered_json;
using Warnings = std::vector<std::string>;

constexpr int places = 9;  ///< of m and of quaternions, as result.json has them
constexpr int px_places = 6;
constexpr int second_places = 9;
constexpr double us_per_s = 1e6;

const std::vector<std::string> csv_head{
    "frame", "input",   "time_s",  "convention", "family",    "id",          "side_m", "x_m",
    "y_m",   "z_m",     "qx",      "qy",         "qz",        "qw",          "sx_m",   "sy_m",
    "sz_m",  "srx_rad", "sry_rad", "srz_rad",    "corrected", "residual_px", "u0_px",  "v0_px",
    "u1_px", "v1_px",   "u2_px",   "v2_px",      "u3_px",     "v3_px"};

/// Fields of a line of CSV; empty ones for what is not known.
class CsvFields {
 public:
  void add(const std::string& text) { fields_.push_back(text); }
  void add(double value, int decimals) {
    fields_.push_back(result::csv_number(result::rounded(value, decimals)));
  }
  void skip(std::size_t count) { fields_.resize(fields_.size() + count); }
  const std::vector<std::string>& all() const { return fields_; }

 private:
  std::vector<std::string> fields_;
};

void add_pose(const FoundPose& found, CsvFields& line) {
  if (!found.pose) return line.skip(13);
  for (const double metres : found.pose->translation) line.add(metres, places);
  for (const double part : quaternion_of(found.pose->rotation)) line.add(part, places);
  if (!found.covariance) return line.skip(6);
  for (std::size_t i = 0; i < 6; ++i)
    line.add(fmt::format("{:.5e}", std::sqrt((*found.covariance)[i * 7])));
}

std::string csv_row(const PoseFrame& frame, const FoundPose& found, const TextOptions& options) {
  CsvFields line;
  line.add(std::to_string(frame.index));
  line.add(frame.input);
  if (frame.taken_us) {
    line.add(*frame.taken_us / us_per_s, second_places);
  } else {
    line.skip(1);
  }
  line.add(options.convention->name);
  line.add(found.family);
  line.add(found.name);
  if (found.is_board()) {
    line.skip(1);
  } else {
    line.add(found.side_m, places);
  }
  add_pose(found, line);
  line.add(found.corrected ? std::to_string(*found.corrected) : "");
  if (found.residual_px) {
    line.add(*found.residual_px, px_places);
  } else {
    line.skip(1);
  }
  if (found.is_board()) line.skip(8);
  for (std::size_t i = 0; i < 4 && !found.is_board(); ++i) {
    line.add(found.corners_px[i].x, px_places);
    line.add(found.corners_px[i].y, px_places);
  }
  return result::csv_line(line.all());
}

std::string csv(const std::vector<PoseFrame>& frames, const TextOptions& options, Warnings&) {
  std::string text = result::csv_line(csv_head);
  for (const PoseFrame& frame : frames) {
    for (const FoundPose& found : found_in(frame, options)) text += csv_row(frame, found, options);
  }
  return text;
}

Json rounded(const double* values, std::size_t count) {
  Json array = Json::array();
  for (std::size_t i = 0; i < count; ++i) array.push_back(result::rounded(values[i], places));
  return array;
}

Json to_json(const FoundPose& found) {
  Json json;
  if (!found.is_board()) {
    json["family"] = found.family;
    json["id"] = std::stoi(found.name);
    json["side_m"] = found.side_m;
    json["corners_px"] = corners_json(found.corners_px);
  }
  if (found.corrected) json["corrected"] = *found.corrected;
  if (found.residual_px) json["residual_px"] = *found.residual_px;
  if (!found.pose) return json;
  json["position_m"] = rounded(found.pose->translation.data(), 3);
  json["orientation_xyzw"] = rounded(quaternion_of(found.pose->rotation).data(), 4);
  if (found.covariance) json["covariance"] = covariance_json(*found.covariance);
  return json;
}

std::string json_lines(const std::vector<PoseFrame>& frames, const TextOptions& options,
                       Warnings&) {
  std::string text;
  for (const PoseFrame& frame : frames) {
    Json json;
    json["frame"] = frame.index;
    json["input"] = frame.input;
    if (frame.taken_us) json["time_s"] = result::rounded(*frame.taken_us / us_per_s, second_places);
    json["convention"] = options.convention->name;
    json["markers"] = Json::array();
    for (const FoundPose& found : found_in(frame, options)) {
      if (found.is_board()) {
        json["board"] = to_json(found);
      } else {
        json["markers"].push_back(to_json(found));
      }
    }
    text += json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  }
  return text;
}

std::string tum(const std::vector<PoseFrame>& frames, const TextOptions& options,
                Warnings& warnings) {
  require_one_name(frames, options, "tum");
  std::string text =
      fmt::format("# timestamp tx ty tz qx qy qz qw ({})\n", options.convention->name);
  for (const PoseFrame& frame : frames) {
    for (const FoundPose& found : placed_in(frame, options, warnings)) {
      const std::uint64_t ns = taken_ns(frame);
      const auto q = quaternion_of(found.pose->rotation);
      const auto& t = found.pose->translation;
      text +=
          fmt::format("{}.{:09} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n", ns / ns_per_s,
                      ns % ns_per_s, t.x(), t.y(), t.z(), q[0], q[1], q[2], q[3]);
    }
  }
  return text;
}

}  // namespace

const std::vector<Format>& formats() {
  static const std::vector<Format> all{
      {"csv", "a line a marker", csv},
      {"json", "a line of JSON a frame", json_lines},
      {"tum", "a trajectory, as evo and Kalibr read it: timestamp tx ty tz qx qy qz qw", tum},
      {"pose", "ROS 2: geometry_msgs/PoseWithCovarianceStamped of one marker", ros_pose},
      {"transforms", "ROS 2: tf2_msgs/TFMessage, geometry_msgs/TransformStamped of each marker",
       ros_transforms},
      {"detections", "ROS 2: vision_msgs/Detection3DArray", ros_detections}};
  return all;
}

std::string poses_text(const Format& format, const std::vector<PoseFrame>& frames,
                       const TextOptions& options, Warnings& warnings) {
  check_name(frames, options);
  return format.write(frames, options, warnings);
}

}  // namespace platform::poses
