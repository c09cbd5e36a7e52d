#include <algorithm>

#include <marker/input/frame_source.h>
#include <marker/input/image_file.h>
#include <marker/input/image_sequence.h>
#include <marker/input/media.h>
#include <marker/input/pgm_stream.h>
#include <marker/input/standard_input.h>
#include <marker/scene/pose.h>
#include <marker/scene/renderer.h>
#include <marker/scene/scene.h>
#include <vp/error.h>
#include <vp/text.h>

#include <cctype>
#include <cmath>
#include <filesystem>
#include <set>

namespace platform::input {

bool InputFrame::settles_after(const facts::UnitInput* before) const {
  const auto* last = dynamic_cast<const InputFrame*>(before);
  const bool is_behind_still = last && last->kind == InputItem::Kind::image;
  if (kind != InputItem::Kind::image && !(kind == InputItem::Kind::scene && is_behind_still))
    return false;
  return !last || last->image.pixels != image.pixels;
}

Camera camera_of(const InputOptions& options, ImageSize size) {
  return options.camera ? camera_for(*options.camera, size)
                        : Camera::for_resolution(size.width, size.height);
}

namespace {

namespace fs = std::filesystem;

/// Names by which a folder's images are known: those of the formats in ImageHeader.
const std::set<std::string>& image_extensions() {
  static const std::set<std::string> extensions{".bmp", ".dib", ".jp2",  ".jpe", ".jpeg",
                                                ".jpg", ".pbm", ".pgm",  ".png", ".pnm",
                                                ".ppm", ".tif", ".tiff", ".webp"};
  return extensions;
}

std::string file_name(const std::string& path) {
  return fs::path(path).filename().string();
}

bool has_image_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return image_extensions().count(extension) > 0;
}

[[noreturn]] void refuse_unknown(const std::string& input) {
  std::vector<std::string> names = scene_names();
  for (const SceneGroup& group : scene_groups()) names.push_back(group.name);
  const std::string nearest = vp::nearest_match(input, names);
  throw vp::InputError("no scene, image, folder or video named '" + input + "': " +
                       (nearest.empty() ? "" : "did you mean the scene '" + nearest + "'? ") +
                       "'markervp scenes' lists the scenes");
}

const SceneGroup* find_group(const std::string& name) {
  for (const SceneGroup& group : scene_groups()) {
    if (group.name == name) return &group;
  }
  return nullptr;
}

class Lister {
 public:
  explicit Lister(const InputOptions& options) : options_(options) {}

  void add(const std::string& input) {
    if (is_scene(input)) return add_scene(input);
    if (const SceneGroup* group = find_group(input)) {
      for (const std::string& scene : group->scenes) add_scene(scene);
      return;
    }
    if (input == standard_input_name) return add_file(standard_input_file());
    std::error_code error;
    const fs::file_status status = fs::status(input, error);
    const bool is_missing = status.type() == fs::file_type::not_found;
    if (is_missing && is_sequence(input)) return add_sequence(input);
    if (is_missing) refuse_unknown(input);
    if (fs::is_directory(status)) return add_folder(input);
    add_file(input);
  }

  std::vector<InputItem> take() { return std::move(items_); }

 private:
  void add_scene(const std::string& name) {
    camera_of(options_, options_.size);
    items_.push_back({InputItem::Kind::scene, name, name});
  }

  void add_file(const std::string& path) {
    if (!add_image(path)) add_video(path);
  }

  bool add_image(const std::string& path) {
    if (is_pgm_stream(path)) return false;
    const std::optional<ImageSize> found = inspect_image(path);
    if (!found) return false;
    check(path, *found);
    items_.push_back({InputItem::Kind::image, path, file_name(path)});
    return true;
  }

  void add_sequence(const std::string& path) {
    const ImageSequence sequence = find_sequence(path);
    const std::size_t first = items_.size();
    add_images(sequence.files);
    for (std::size_t i = first; i < items_.size(); ++i) items_[i].in_sequence = true;
    if (!sequence.gap.empty())
      items_[first].oddity = "'" + sequence.gap + "' is missing in '" + path + "'";
  }

  void add_video(const std::string& path) {
    const std::optional<GreyImage> first = open_video(path)->next();
    if (!first) throw vp::InputError("video '" + path + "' has no frames that can be read");
    check(path, {first->width, first->height});
    items_.push_back({InputItem::Kind::video, path, file_name(path)});
  }

  void add_folder(const std::string& path) {
    std::error_code error;
    std::vector<std::string> images;
    fs::directory_iterator entry(path, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
      const std::string name = entry->path().filename().string();
      if (name[0] != '.' && has_image_extension(name)) images.push_back(entry->path().string());
    }
    if (error) throw vp::InputError("folder '" + path + "' cannot be read: " + error.message());
    if (images.empty()) throw vp::InputError("folder '" + path + "' has no images");
    std::sort(images.begin(), images.end(), natural_less);
    add_images(images);
  }

  void add_images(const std::vector<std::string>& images) {
    for (const std::string& image : images) {
      if (!add_image(image)) throw vp::InputError("image '" + image + "' is damaged or no image");
    }
  }

  /// Throws if an image of this size cannot be used.
  void check(const std::string& path, ImageSize size) const {
    check_fit(path, size, options_.size, options_.fit);
    camera_of(options_, size);
  }

  const InputOptions& options_;
  std::vector<InputItem> items_;
};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// The run of digits at `at`, without leading zeros; moves `at` past it.
std::string_view number_at(const std::string& text, std::size_t& at) {
  while (at < text.size() && text[at] == '0') ++at;
  const std::size_t first = at;
  while (at < text.size() && is_digit(text[at])) ++at;
  return std::string_view(text).substr(first, at - first);
}

}  // namespace

std::vector<InputItem> list_inputs(const std::vector<std::string>& inputs,
                                   const InputOptions& options) {
  Lister lister(options);
  for (const std::string& input : inputs) lister.add(input);
  return lister.take();
}

bool natural_less(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const std::string_view x = number_at(a, i);
      const std::string_view y = number_at(b, j);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else if (a[i] != b[j]) {
      return static_cast<unsigned char>(a[i]) < static_cast<unsigned char>(b[j]);
    } else {
      ++i;
      ++j;
    }
  }
  if (i < a.size() || j < b.size()) return i == a.size();
  return a < b;  // equal but for leading zeros
}

namespace {

/// The camera that draws scenes: it has no lens, and its levels are light.
Camera scene_camera(const InputOptions& options) {
  Camera camera = camera_of(options, options.size);
  camera.distortion = {};
  camera.lens_model = marker::LensModel::brown_conrady;
  camera.response = {true, nullptr};
  return camera;
}

std::vector<SharedFrame>& kept() {
  static std::vector<SharedFrame> frames;
  return frames;
}

bool same(const Camera& a, const Camera& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy &&
         a.cx == b.cx && a.cy == b.cy;
}

SharedFrame share(InputFrame frame) {
  return std::make_shared<const InputFrame>(std::move(frame));
}

/// Of levels that are not light a program knows what the camera file says, or nothing.
SharedFrame render_scene(const InputItem& item, const InputOptions& options) {
  Camera camera = scene_camera(options);
  const Scene scene = make_scene(item.source, camera);
  if (!scene.response.empty()) camera.response = camera_of(options, options.size).response;
  std::vector<GroundTruth> truths = ground_truths(scene);
  const GroundTruth own = truths.front();
  truths.erase(truths.begin());
  return share({item.name, render(scene), camera, own, std::move(truths)});
}

std::size_t kept_bytes() {
  std::size_t bytes = 0;
  for (const SharedFrame& frame : kept()) bytes += frame->image.pixels.size();
  return bytes;
}

}  // namespace

void keep_scenes(const std::vector<std::string>& inputs, const InputOptions& options,
                 std::size_t most_bytes) {
  const std::vector<std::string> asked = inputs.empty() ? std::vector<std::string>{"demo"} : inputs;
  for (const InputItem& item : list_inputs(asked, options)) {
    if (item.kind != InputItem::Kind::scene) continue;
    const Camera camera = scene_camera(options);
    if (kept_scene(item.source, camera)) continue;
    if (kept_bytes() >= most_bytes) return;
    kept().push_back(render_scene(item, options));
  }
}

SharedFrame kept_scene(const std::string& name, const Camera& camera) {
  for (const SharedFrame& frame : kept()) {
    if (frame->name == name && same(frame->camera, camera)) return frame;
  }
  return nullptr;
}

namespace {

/// Frames of a list no longer than this are kept when it repeats: 20 MB at 640x480.
constexpr std::size_t kept_frames = 64;

class ListedFrames : public FrameSource {
 public:
  ListedFrames(std::vector<InputItem> items, const InputOptions& options)
      : items_(std::move(items)), options_(options) {
    const bool repeats = options_.repeat > 1 && items_.size() <= kept_frames;
    if (repeats) kept_.resize(items_.size());
    for (const InputItem& item : items_) warn(item.oddity);
    warn_of_camera();
  }

  SharedFrame next() override {
    while (given_ < options_.limit.value_or(UINT64_MAX) && round_ < options_.repeat) {
      if (SharedFrame frame = from_current_item()) {
        ++given_;
        return frame;
      }
    }
    return nullptr;
  }

  std::optional<std::uint64_t> size() const override {
    if (has(InputItem::Kind::video)) return std::nullopt;
    const std::uint64_t all = items_.size() * options_.repeat;
    return std::min(all, options_.limit.value_or(all));
  }

  const std::vector<std::string>& warnings() const override { return warnings_; }
  const std::vector<std::string>& notes() const override { return notes_; }

 private:
  bool has(InputItem::Kind kind) const {
    return std::any_of(items_.begin(), items_.end(),
                       [kind](const InputItem& item) { return item.kind == kind; });
  }

  static void add_once(std::vector<std::string>& list, const std::string& text) {
    if (!text.empty() && std::find(list.begin(), list.end(), text) == list.end())
      list.push_back(text);
  }
  void warn(const std::string& text) { add_once(warnings_, text); }
  void note(const std::string& text) { add_once(notes_, text); }

  void warn_of_camera() {
    const bool pictures = has(InputItem::Kind::image) || has(InputItem::Kind::video);
    if (pictures && !options_.camera) {
      warn("no --camera: poses assume the thesis' camera (focal length 381.36 px at 640 px width)");
    }
    if (!options_.camera) return;
    const std::string file = "camera file '" + options_.camera->name + "' ";
    for (const std::string& oddity : options_.camera->oddities) warn(file + oddity);
    if (has(InputItem::Kind::scene)) tell_of_scenes(file);
    if (!pictures) return;
    if (!options_.camera->has_size)
      note(file + "says no image size: it is taken to be for images as large as these");
    if (!has_distortion(*options_.camera)) return;
    if (!options_.corrects_lens) {
      warn(file +
           "has lens distortion, which this design does not correct: poses are off towards the "
           "edges");
    } else if (const auto reach = lens_reach_px(*options_.camera, options_.size)) {
      const bool is_fisheye = options_.camera->lens_model == marker::LensModel::equidistant;
      warn(file +
           (is_fisheye ? "sees farther than 75 degrees off its axis, or folds back"
                       : "has lens distortion that folds back") +
           ": no marker is found beyond " + std::to_string(static_cast<int>(*reach)) +
           " px from the middle; calibrate with points up to the corners");
    }
  }

  void tell_of_scenes(const std::string& file) {
    note("scenes are drawn as " + file + "says, not as the thesis' camera sees them");
    if (has_distortion(*options_.camera))
      warn(file + "has lens distortion, which scenes are drawn without");
  }

  /// The next frame of the item whose turn it is; none when it has no more, and the next item's
  /// turn has come.
  SharedFrame from_current_item() {
    const InputItem& item = items_[position_];
    if (item.kind == InputItem::Kind::video) {
      SharedFrame frame = video_frame(item);
      if (!frame) advance();
      return frame;
    }
    SharedFrame frame = kept_or_made(item);
    advance();
    return frame;
  }

  void advance() {
    if (++position_ < items_.size()) return;
    position_ = 0;
    ++round_;
  }

  SharedFrame kept_or_made(const InputItem& item) {
    if (kept_.empty()) return make(item);
    SharedFrame& kept = kept_[position_];
    if (!kept) kept = make(item);
    return kept;
  }

  SharedFrame make(const InputItem& item) {
    if (item.kind == InputItem::Kind::scene) return scene_frame(item);
    std::optional<GreyImage> image = read_image(item.source);
    if (!image)
      throw vp::InputError("image '" + item.source + "' has changed and is no image any more");
    return fitted(item, item.name, *std::move(image));
  }

  SharedFrame scene_frame(const InputItem& item) {
    if (SharedFrame kept = kept_scene(item.source, scene_camera(options_))) return kept;
    return render_scene(item, options_);
  }

  SharedFrame video_frame(const InputItem& item) {
    if (!video_) {
      video_ = open_video(item.source);
      video_frames_ = 0;
    }
    std::optional<GreyImage> image = video_->next();
    if (!image) {
      end_video(item);
      return nullptr;
    }
    const std::string name = item.name + "#" + std::to_string(video_frames_++);
    return fitted(item, name, *std::move(image));
  }

  void end_video(const InputItem& item) {
    const std::uint64_t promised = video_->promised_frames();
    video_.reset();
    if (video_frames_ == 0)
      throw vp::InputError("video '" + item.source + "' has no frames that can be read");
    if (video_frames_ < promised) {
      warn("video '" + item.name + "' ends after " + std::to_string(video_frames_) + " of " +
           std::to_string(promised) + " frames: truncated, or its header is wrong");
    }
  }

  SharedFrame fitted(const InputItem& item, const std::string& name, GreyImage image) {
    const ImageSize size{image.width, image.height};
    check_fit(item.source, size, options_.size, options_.fit);
    const Camera camera = camera_of(options_, size);
    if (options_.camera && is_off_centre(camera)) {
      warn("camera file '" + options_.camera->name +
           "' has its principal point far from the middle of images of " +
           std::to_string(size.width) + "x" + std::to_string(size.height) +
           " px: is it for another size?");
    }
    note(fit_text(size, options_.size, options_.fit));
    return share({name,
                  fit_image(std::move(image), options_.size, options_.fit),
                  fit_camera(camera, options_.size, options_.fit),
                  std::nullopt,
                  {},
                  item.in_sequence ? InputItem::Kind::video : item.kind});
  }

  std::vector<InputItem> items_;
  InputOptions options_;
  std::vector<SharedFrame> kept_;  ///< by position; empty unless the list repeats
  std::vector<std::string> warnings_, notes_;
  std::size_t position_ = 0;
  std::uint64_t round_ = 0;
  std::uint64_t given_ = 0;
  std::unique_ptr<VideoStream> video_;
  std::uint64_t video_frames_ = 0;  ///< of the open video
};

}  // namespace

std::unique_ptr<FrameSource> open_inputs(const std::vector<std::string>& inputs,
                                         const InputOptions& options) {
  const std::vector<std::string> asked = inputs.empty() ? std::vector<std::string>{"demo"} : inputs;
  return std::make_unique<ListedFrames>(list_inputs(asked, options), options);
}

}  // namespace platform::input
