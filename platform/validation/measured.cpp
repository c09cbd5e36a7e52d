#include <validation/measured.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include <host/document.h>
#include <scene/catalogue.h>
#include <vp/error.h>

namespace platform::validation {

namespace {

/// The test that a scene belongs to; empty for other images.
std::string group_of(const std::string& scene) {
  for (const SceneGroup& group : scene_groups()) {
    const auto& names = group.scenes;
    if (std::find(names.begin(), names.end(), scene) != names.end()) return group.name;
  }
  return "";
}

double distance(const nlohmann::json& a, const nlohmann::json& b) {
  return std::hypot(a.at(0).get<double>() - b.at(0).get<double>(),
                    a.at(1).get<double>() - b.at(1).get<double>());
}

FoundTrue found_true(const nlohmann::json& marker) {
  FoundTrue found;
  const nlohmann::json& corners = marker.at("truth").at("corners_px");
  found.width_px =
      (distance(corners.at(0), corners.at(1)) + distance(corners.at(3), corners.at(2))) / 2;
  const nlohmann::json& error = marker.at("error");
  found.corner_px = error.at("corner_px");
  if (error.contains("translation_mm")) {
    found.translation_mm = error.at("translation_mm").get<double>();
    found.rotation_deg = error.at("rotation_deg").get<double>();
    found.iterations = marker.at("iterations");
  }
  return found;
}

Frame read_frame(const nlohmann::json& json) {
  Frame frame;
  frame.input = json.at("input");
  frame.group = group_of(frame.input);
  frame.threshold = json.at("threshold");
  const nlohmann::json& counts = json.at("counts");
  frame.corners = counts.at("corners");
  frame.blobs = counts.at("blobs");
  frame.candidates = counts.at("candidates");
  for (const nlohmann::json& marker : json.at("markers")) {
    if (marker.contains("truth")) frame.found = found_true(marker);
  }
  frame.markers = json.at("markers").dump();
  for (const auto& [name, us] : json.at("time_us").items()) frame.times_us[name] = us;
  return frame;
}

}  // namespace

Measurement mean_of(const std::vector<double>& values) {
  const double count = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  const double mean = sum / count;
  for (const double value : values) squares += (value - mean) * (value - mean);
  if (values.size() < 2) return {mean};
  return {mean, std::sqrt(squares / (count - 1))};
}

double Frame::ms(const std::string& stage) const {
  const auto time = times_us.find(stage);
  if (time == times_us.end()) {
    throw vp::InputError("frame '" + input + "' has no time of stage '" + stage + "'");
  }
  return time->second / 1000;
}

std::vector<const Frame*> Run::of(const std::vector<std::string>& groups) const {
  std::vector<const Frame*> selected;
  for (const Frame& frame : frames) {
    if (std::find(groups.begin(), groups.end(), frame.group) != groups.end()) {
      selected.push_back(&frame);
    }
  }
  return selected;
}

Run read_run(const std::filesystem::path& file) {
  try {
    Run run;
    run.root = host::read_json(file, "result", host::largest_result);
    run.system = run.root.at("system");
    run.profile = run.root.at("profile");
    run.fidelity = run.root.at("fidelity");
    run.design = run.root.at("design");
    run.configuration = run.root.at("configuration");
    for (const nlohmann::json& frame : run.root.at("frames")) run.frames.push_back(read_frame(frame));
    run.root.erase("frames");
    return run;
  } catch (const nlohmann::json::exception&) {
    throw vp::InputError("result '" + file.string() +
                         "' was changed or is damaged: run the validation again");
  }
}

void check_same_inputs(const Measured& measured) {
  const auto &one = measured.hybrid.frames, &other = measured.ps_only.frames;
  const bool same = std::equal(one.begin(), one.end(), other.begin(), other.end(),
                               [](const Frame& a, const Frame& b) { return a.input == b.input; });
  if (!same || one.empty()) {
    throw vp::InputError("the two systems did not run on the same images");
  }
}

}  // namespace platform::validation
