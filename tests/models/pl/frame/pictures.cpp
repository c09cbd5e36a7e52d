#include "pictures.h"

#include <marker/scene/renderer.h>
#include <marker/scene/scene.h>

using harness::Image;
using harness::Random;

namespace {

constexpr std::uint8_t dark = 20, bright = 200;

template <class Level>
Image draw(const pl::Geometry& g, Level level) {
  Image image;
  image.reserve(g.pixels());
  for (std::uint32_t y = 0; y < g.height; ++y) {
    for (std::uint32_t x = 0; x < g.width; ++x) {
      image.push_back(static_cast<std::uint8_t>(level(x, y)));
    }
  }
  return image;
}

}  // namespace

Image dots(const pl::Geometry& g, std::uint32_t share, std::uint64_t seed) {
  Random random(seed);
  return draw(g, [&](auto, auto) { return random.below(1000) < share ? dark : bright; });
}

Image checkerboard(const pl::Geometry& g) {
  return draw(g, [](auto x, auto y) { return (x + y) % 2 == 0 ? dark : bright; });
}

std::vector<Picture> patterns(const pl::Geometry& g) {
  const int width = static_cast<int>(g.width), height = static_cast<int>(g.height);
  Random random(7);
  std::vector<Picture> pictures{
      {"noise", g, harness::noise(width, height, 2)},
      {"rectangles", g, harness::rectangles(width, height, 60, 3)},
      {"stripes", g,
       draw(g,
            [](auto x, auto y) {
              return x % 4 == 0 && y >= x / 4 % 8 && y % 40 < 20 + x / 4 % 5 ? dark : bright;
            })},
      {"checkerboard", g, checkerboard(g)},
      {"columns", g, draw(g, [](auto x, auto) { return x % 2 == 0 ? dark : bright; })},
      {"combs", g,
       draw(g, [](auto x, auto y) { return y % 9 == 8 || x % 5 == y / 9 % 5 ? dark : bright; })},
      {"slopes", g, draw(g, [](auto x, auto y) { return (x + 3 * y) % 61 < 20 ? dark : bright; })},
      {"zigzag", g,
       draw(g, [](auto x,
                  auto y) { return (x + (y % 16 < 8 ? y : 16 - y)) % 11 < 3 ? dark : bright; })},
      {"dark", g, draw(g, [](auto, auto) { return 0; })},
      {"bright", g, draw(g, [](auto, auto) { return 255; })},
      {"levels", g, draw(g, [](auto x, auto y) { return x * 3 + y * 5; })},
      {"extremes", g, draw(g, [&](auto, auto) { return random.below(4) == 0 ? 0 : 255; })},
  };
  for (std::uint32_t share : {5u, 30u, 80u, 150u, 400u, 900u}) {
    pictures.push_back({"dots" + std::to_string(share), g, dots(g, share, share)});
  }
  return pictures;
}

std::vector<Picture> scenes() {
  std::vector<Picture> pictures;
  for (const char* name : {"demo", "roll30", "squares15", "yaw60", "z4.5"}) {
    const platform::GreyImage image = platform::render(platform::make_scene(name));
    pictures.push_back({name, {}, image.pixels});
  }
  return pictures;
}

std::vector<pl::Geometry> small_sizes() {
  return {{32, 32}, {32, 512}, {64, 16}, {96, 32}, {128, 24}, {160, 32}, {992, 32}, {1024, 16}};
}
