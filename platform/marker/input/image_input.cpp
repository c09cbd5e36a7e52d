#include <marker/input/image_input.h>

#include <host/digest.h>
#include <marker/input/camera_file.h>
#include <marker/scene/scene.h>
#include <vp/error.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <utility>

namespace platform::input {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* images_kind = "images";
constexpr const char* lens_word = " corrects_lens";

}  // namespace

facts::InputNeed image_need(ImageSize size, bool corrects_lens) {
  const auto bytes = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  const std::string shape = std::to_string(size.width) + "x" + std::to_string(size.height);
  return {images_kind, bytes, shape + (corrects_lens ? lens_word : "")};
}

ImageSize image_size(const facts::InputNeed& need) {
  ImageSize size;
  const bool is_size = need.kind == images_kind &&
                       std::sscanf(need.shape.c_str(), "%dx%d", &size.width, &size.height) == 2;
  if (!is_size) throw vp::InputError("this design takes no images");
  return size;
}

void describe_camera(const facts::UnitInput& input, hal_frame& frame) {
  const auto* image = dynamic_cast<const InputFrame*>(&input);
  if (!image) return;
  const Camera& camera = image->camera;
  frame.fx = camera.fx;
  frame.fy = camera.fy;
  frame.cx = camera.cx;
  frame.cy = camera.cy;
  static_assert(sizeof camera.distortion == sizeof frame.distortion);
  std::copy(camera.distortion.begin(), camera.distortion.end(), frame.distortion);
  frame.lens_model = static_cast<std::uint32_t>(camera.lens_model);
  frame.light = camera.response.light ? camera.response.light->data() : nullptr;
  frame.response = frame.light != nullptr      ? HAL_RESPONSE_TABLE
                   : camera.response.is_linear ? HAL_RESPONSE_LINEAR
                                               : HAL_RESPONSE_UNKNOWN;
}

InputOptions image_options(const study::InputRequest& request) {
  InputOptions options;
  options.size = image_size(request.need);
  options.corrects_lens = request.need.shape.find(lens_word) != std::string::npos;
  const auto fit = request.settings.find("fit");
  if (fit != request.settings.end()) options.fit = fit->second == "crop" ? Fit::crop : Fit::scale;
  const auto camera = request.settings.find("camera");
  if (camera != request.settings.end()) options.camera = read_camera_file(camera->second);
  options.repeat = request.repeat;
  options.limit = request.limit;
  return options;
}

namespace {

/// Frames as a run takes them.
class Images : public facts::InputSource {
 public:
  explicit Images(std::unique_ptr<FrameSource> frames) : frames_(std::move(frames)) {}

  facts::SharedInput next() override { return frames_->next(); }
  std::optional<std::uint64_t> size() const override { return frames_->size(); }
  const std::vector<std::string>& warnings() const override { return frames_->warnings(); }
  const std::vector<std::string>& notes() const override { return frames_->notes(); }

 private:
  std::unique_ptr<FrameSource> frames_;
};

std::unique_ptr<facts::InputSource> open_images(const study::InputRequest& request) {
  return std::make_unique<Images>(open_inputs(request.names, image_options(request)));
}

Json scene_json(const Scene& scene) {
  Json json;
  json["marker"] = scene.marker_id;
  json["camera"] = {scene.camera.fx, scene.camera.fy, scene.camera.cx, scene.camera.cy};
  json["rotation"] = Json::array();
  for (const auto& row : scene.pose.rotation.rowwise()) {
    json["rotation"].push_back(std::vector<double>(row.begin(), row.end()));
  }
  json["translation"] =
      std::vector<double>(scene.pose.translation.begin(), scene.pose.translation.end());
  json["squares"] = Json::array();
  for (const Square& square : scene.squares)
    json["squares"].push_back({square.u, square.v, square.side, square.word});
  const Brightness& light = scene.brightness;
  json["brightness"] = {light.black, light.border,  light.wall,
                        light.floor, light.ceiling, light.side_walls};
  json["room"] = {scene.room.wall_w, scene.room.floor_v, scene.room.ceiling_v, scene.room.side_u};
  const Motion& motion = scene.motion;
  json["motion"] = {motion.velocity.x(), motion.velocity.y(), motion.velocity.z(),
                    motion.spin_deg_per_s, scene.time_s};
  json["shutter"] = {scene.shutter.exposure_s, scene.shutter.readout_s};
  json["vignetting"] = scene.vignetting;
  json["noise"] = scene.noise_sigma;
  json["blur"] = scene.blur_sigma_px;
  json["seed"] = scene.seed;
  // What scenes of earlier versions do not have changes none of their hashes.
  if (!scene.response.empty()) json["response"] = scene.response;
  if (scene.hidden > 0) json["hidden"] = scene.hidden;
  if (scene.jpeg > 0) json["jpeg"] = scene.jpeg;
  return json;
}

Json contents(const study::InputRequest& request) {
  const InputOptions options = image_options(request);
  const std::vector<std::string> asked =
      request.names.empty() ? std::vector<std::string>{"demo"} : request.names;
  Json json = Json::array();
  for (const InputItem& item : list_inputs(asked, options)) {
    Json entry;
    entry["name"] = item.name;
    if (item.kind == InputItem::Kind::scene) {
      const Scene scene = make_scene(item.source, camera_of(options, options.size));
      entry["scene"] = host::content_hash(scene_json(scene).dump());
    } else {
      entry["file"] = host::file_hash(item.source);
    }
    json.push_back(entry);
  }
  const auto camera = request.settings.find("camera");
  if (camera != request.settings.end())
    json.push_back({{"camera", host::file_hash(camera->second)}});
  return json;
}

void warm_up(const study::InputRequest& request, std::size_t most_bytes) {
  keep_scenes(request.names, image_options(request), most_bytes);
}

/// Every combination of conditions becomes an input: "demo@distance=2 m,noise=0.02".
std::vector<std::string> combinations(const study::InputKind::Lists& conditions) {
  constexpr std::size_t most_scenes = 10'000;
  std::string base = "front0";
  std::vector<std::string> scenes{""};
  for (const auto& [key, values] : conditions) {
    if (key == "base") {
      if (values.size() != 1) throw vp::InputError("'base' is one scene");
      base = values.front();
      continue;
    }
    std::vector<std::string> longer;
    for (const std::string& scene : scenes) {
      for (const std::string& value : values)
        longer.push_back(scene + (scene.empty() ? "" : ",") + key + "=" + value);
    }
    if (longer.size() > most_scenes)
      throw vp::InputError("'scenes' has more than 10000 combinations");
    scenes = std::move(longer);
  }
  for (std::string& scene : scenes) scene = scene.empty() ? base : base + "@" + scene;
  return scenes;
}

std::vector<std::string> all_names() {
  std::vector<std::string> names = scene_names();
  for (const SceneGroup& group : scene_groups()) names.push_back(group.name);
  return names;
}

}  // namespace

const study::InputKind& image_input() {
  static const study::InputKind kind = [] {
    study::InputKind images;
    images.name = images_kind;
    images.what = "scenes, images, folders, videos";
    images.settings = {{"camera", "FILE", "camera calibration (OpenCV or ROS)", true},
                       {"fit", "crop|scale", "make images of another size fit"}};
    images.open = open_images;
    images.contents = contents;
    images.warm_up = warm_up;
    images.names = all_names;
    images.key = "scenes";
    images.expand = combinations;
    return images;
  }();
  return kind;
}

}  // namespace platform::input
