#include <algorithm>
#include <deque>

#include <input/frame_source.h>
#include <input/input_list.h>
#include <input/media.h>
#include <scene/renderer.h>
#include <scene/scene.h>
#include <vp/error.h>

namespace platform::input {

namespace {

std::deque<InputFrame>& kept() {
  static std::deque<InputFrame> frames;
  return frames;
}

bool same(const Camera& a, const Camera& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy &&
         a.cx == b.cx && a.cy == b.cy;
}

std::size_t kept_bytes() {
  std::size_t bytes = 0;
  for (const InputFrame& frame : kept()) bytes += frame.image.pixels.size();
  return bytes;
}

}  // namespace

void keep_scenes(const std::vector<std::string>& inputs, const InputOptions& options,
                 std::size_t most_bytes) {
  const std::vector<std::string> asked = inputs.empty() ? std::vector<std::string>{"demo"} : inputs;
  for (const InputItem& item : list_inputs(asked, options)) {
    if (item.kind != InputItem::Kind::scene) continue;
    const Camera camera = camera_of(options, options.size);
    if (kept_scene(item.source, camera) != nullptr) continue;
    if (kept_bytes() >= most_bytes) return;
    const Scene scene = make_scene(item.source, camera);
    kept().push_back({item.name, render(scene), camera, ground_truth(scene)});
  }
}

const InputFrame* kept_scene(const std::string& name, const Camera& camera) {
  for (const InputFrame& frame : kept()) {
    if (frame.name == name && same(frame.camera, camera)) return &frame;
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
    warn_of_camera();
  }

  std::optional<InputFrame> next() override {
    while (given_ < options_.limit.value_or(UINT64_MAX) && round_ < options_.repeat) {
      if (std::optional<InputFrame> frame = from_current_item()) {
        ++given_;
        return frame;
      }
    }
    return std::nullopt;
  }

  std::optional<std::uint64_t> size() const override {
    if (has(InputItem::Kind::video)) return std::nullopt;
    const std::uint64_t all = items_.size() * options_.repeat;
    return std::min(all, options_.limit.value_or(all));
  }

  const std::vector<std::string>& warnings() const override { return warnings_; }

 private:
  bool has(InputItem::Kind kind) const {
    return std::any_of(items_.begin(), items_.end(),
                       [kind](const InputItem& item) { return item.kind == kind; });
  }

  void warn(const std::string& text) {
    if (std::find(warnings_.begin(), warnings_.end(), text) == warnings_.end()) {
      warnings_.push_back(text);
    }
  }

  void warn_of_camera() {
    const bool pictures = has(InputItem::Kind::image) || has(InputItem::Kind::video);
    if (pictures && !options_.camera) {
      warn("no --camera: poses assume the thesis' camera (focal length 381.36 px at 640 px width)");
    }
    if (pictures && options_.camera && has_distortion(*options_.camera)) {
      warn("camera file '" + options_.camera->name +
           "' has lens distortion, which the system does not correct: poses are off towards the "
           "edges");
    }
  }

  /// The next frame of the item whose turn it is; nothing when it has no more, and the next item's
  /// turn has come.
  std::optional<InputFrame> from_current_item() {
    const InputItem& item = items_[position_];
    if (item.kind == InputItem::Kind::video) {
      std::optional<InputFrame> frame = video_frame(item);
      if (!frame) advance();
      return frame;
    }
    InputFrame frame = kept_or_made(item);
    advance();
    return frame;
  }

  void advance() {
    if (++position_ < items_.size()) return;
    position_ = 0;
    ++round_;
  }

  InputFrame kept_or_made(const InputItem& item) {
    if (kept_.empty()) return make(item);
    std::optional<InputFrame>& kept = kept_[position_];
    if (!kept) kept = make(item);
    return *kept;
  }

  InputFrame make(const InputItem& item) {
    if (item.kind == InputItem::Kind::scene) return scene_frame(item);
    std::optional<GreyImage> image = read_image(item.source);
    if (!image)
      throw vp::InputError("image '" + item.source + "' has changed and is none any more");
    return fitted(item, item.name, *std::move(image));
  }

  InputFrame scene_frame(const InputItem& item) {
    const Camera camera = camera_of(options_, options_.size);
    if (const InputFrame* kept = kept_scene(item.source, camera)) return *kept;
    const Scene scene = make_scene(item.source, camera);
    return {item.name, render(scene), camera, ground_truth(scene)};
  }

  std::optional<InputFrame> video_frame(const InputItem& item) {
    if (!video_) {
      video_ = open_video(item.source);
      video_frames_ = 0;
    }
    std::optional<GreyImage> image = video_->next();
    if (!image) {
      end_video(item);
      return std::nullopt;
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

  InputFrame fitted(const InputItem& item, const std::string& name, GreyImage image) {
    const ImageSize size{image.width, image.height};
    check_fit(item.source, size, options_.size, options_.fit);
    const Camera camera = camera_of(options_, size);
    return {name, fit_image(std::move(image), options_.size, options_.fit),
            fit_camera(camera, options_.size, options_.fit), std::nullopt};
  }

  std::vector<InputItem> items_;
  InputOptions options_;
  std::vector<std::optional<InputFrame>> kept_;  ///< by position; empty unless the list repeats
  std::vector<std::string> warnings_;
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
