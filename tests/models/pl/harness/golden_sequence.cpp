#include "golden_sequence.h"

#include <marker/scene/renderer.h>
#include <marker/scene/scene.h>

namespace harness {

namespace {

constexpr int width = 640, height = 480;

GoldenFrame scene(const std::string& name) {
  return {name, true, platform::render(platform::make_scene(name)).pixels};
}

}  // namespace

std::vector<GoldenFrame> golden_sequence() {
  return {
      scene("demo"),
      scene("roll30"),
      scene("squares15"),
      {"rectangles", false, rectangles(width, height, 400, 1)},
      {"noise", false, noise(width, height, 2)},
      {"stripes", false, stripes(width, height)},
      {"cut_blobs", false, blobs_at_the_end(width, height, 16, 16)},
  };
}

}  // namespace harness
