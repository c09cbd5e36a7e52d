#include <input/kept_scenes.h>

#include <deque>

#include <input/input_list.h>
#include <scene/catalogue.h>
#include <scene/renderer.h>

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

}  // namespace platform::input
