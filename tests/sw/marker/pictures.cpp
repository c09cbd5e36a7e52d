#include "pictures.h"

#include <blob_stream.h>
#include <marker/scene/pose.h>
#include <marker/scene/renderer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace pictures {
namespace {

/// The eight directions of marker::Extremes.
constexpr std::array<std::array<int, 2>, 8> directions = {
    {{0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}}};

using marker::Pixel;

class Blobs {
 public:
  Blobs(const marker::GreyImage& image, std::uint8_t threshold)
      : image_(image), dark_(std::size_t{image.width} * image.height) {
    for (std::size_t i = 0; i < dark_.size(); ++i) dark_[i] = image.pixels[i] <= threshold;
  }

  bool is_dark(Pixel p) const { return dark_[index(p)]; }

  /// Takes the blob of a dark pixel out of the picture.
  marker::Extremes take(Pixel start) {
    marker::Extremes extremes;
    extremes.fill(start);
    waiting_ = {start};
    dark_[index(start)] = false;
    while (!waiting_.empty()) {
      const Pixel p = waiting_.back();
      waiting_.pop_back();
      extend(extremes, p);
      for (int y = std::max(p.y - 1, 0); y <= std::min(p.y + 1, height() - 1); ++y) {
        for (int x = std::max(p.x - 1, 0); x <= std::min(p.x + 1, width() - 1); ++x) {
          if (!is_dark({x, y})) continue;
          dark_[index({x, y})] = false;
          waiting_.push_back({x, y});
        }
      }
    }
    return extremes;
  }

 private:
  int width() const { return static_cast<int>(image_.width); }
  int height() const { return static_cast<int>(image_.height); }
  std::size_t index(Pixel p) const { return static_cast<std::size_t>(p.y * width() + p.x); }

  static void extend(marker::Extremes& extremes, Pixel p) {
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const auto [dx, dy] = directions[i];
      Pixel& best = extremes[i];
      if (dx * p.x + dy * p.y > dx * best.x + dy * best.y) best = p;
    }
  }

  const marker::GreyImage& image_;
  std::vector<bool> dark_;
  std::vector<Pixel> waiting_;
};

/// Light between the pixels of a picture: bilinear.
double light_at(const std::vector<double>& light, const platform::Camera& camera,
                marker::Point point) {
  const double x = std::clamp(point.x - 0.5, 0.0, camera.width - 1.001);
  const double y = std::clamp(point.y - 0.5, 0.0, camera.height - 1.001);
  const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
  const double fx = x - static_cast<double>(column), fy = y - static_cast<double>(row);
  const auto width = static_cast<std::size_t>(camera.width);
  const double* const at = &light[row * width + column];
  return (1 - fy) * ((1 - fx) * at[0] + fx * at[1]) +
         fy * ((1 - fx) * at[width] + fx * at[width + 1]);
}

}  // namespace

marker::GreyImage view(const platform::GreyImage& picture) {
  return {picture.pixels.data(), static_cast<std::uint32_t>(picture.width),
          static_cast<std::uint32_t>(picture.height)};
}

marker::Lens lens_of(const platform::Camera& camera) {
  return {{camera.fx, camera.fy, camera.cx, camera.cy}};
}

platform::GreyImage render_through(const platform::Scene& scene, const marker::Lens& lens) {
  constexpr int finer = 4, samples = 8;
  platform::Scene fine = scene;
  fine.camera = {scene.camera.width * finer, scene.camera.height * finer, scene.camera.fx * finer,
                 scene.camera.fy * finer,    scene.camera.cx * finer,     scene.camera.cy * finer};
  const std::vector<double> light = platform::render_light(fine);
  platform::GreyImage picture{scene.camera.width, scene.camera.height, {}};
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      double sum = 0;
      for (int i = 0; i < samples * samples; ++i) {
        const marker::Point seen{x + (i % samples + 0.5) / samples,
                                 y + (i / samples + 0.5) / samples};
        marker::Point ideal{};
        if (!marker::undistort(lens, seen, ideal)) continue;
        sum += light_at(light, fine.camera, {ideal.x * finer, ideal.y * finer});
      }
      const double level = sum / (samples * samples) * 255;
      picture.pixels.push_back(static_cast<std::uint8_t>(std::clamp(level + 0.5, 0.0, 255.0)));
    }
  }
  return picture;
}

std::vector<marker::Extremes> find_blobs(const marker::GreyImage& picture, std::uint8_t threshold,
                                         std::uint32_t minimum_side) {
  Blobs blobs(picture, threshold);
  std::vector<marker::Extremes> found;
  const auto side = static_cast<int>(minimum_side);
  for (int y = 0; y < static_cast<int>(picture.height); ++y) {
    for (int x = 0; x < static_cast<int>(picture.width); ++x) {
      if (!blobs.is_dark({x, y})) continue;
      const marker::Extremes e = blobs.take({x, y});
      if (e[2].x - e[6].x >= side && e[4].y - e[0].y >= side) found.push_back(e);
    }
  }
  return found;
}

std::vector<std::uint32_t> words_of(const std::vector<marker::Extremes>& blobs) {
  std::vector<std::uint32_t> words;
  for (const marker::Extremes& blob : blobs) {
    for (const Pixel p : blob) {
      words.push_back(
          blob_stream::point(static_cast<std::uint32_t>(p.x), static_cast<std::uint32_t>(p.y)));
    }
  }
  return words;
}

platform::Scene ten_markers() {
  platform::Scene scene;
  scene.pose.rotation = platform::rotation_y(12) * platform::rotation_z(4);
  scene.pose.translation = {-1.2, -0.5, 2.8};
  scene.blur_sigma_px = 0.4;
  for (int id = 1; id < 10; ++id) {
    scene.squares.push_back(
        {id % 5 * 0.56, id / 5 * 0.56, platform::marker_side_m, platform::marker_word(id)});
  }
  return scene;
}

Found find_marker(const platform::Scene& scene, const marker::GreyImage& picture,
                  const marker::Lens& lens) {
  const auto truth = platform::project_marker(scene.camera, scene.pose);
  for (const marker::Extremes& blob : find_blobs(picture)) {
    marker::Quad guess{};
    if (!marker::largest_quad(blob, guess)) continue;
    const marker::QuadFit fit = marker::fit_quad({picture, lens}, guess, {});
    if (fit.refusal != marker::Refusal::none) continue;
    for (unsigned turns = 0; turns < 4; ++turns) {
      const Found found{true, marker::counted_from(fit, turns), 0};
      double sum = 0, worst = 0;
      for (unsigned i = 0; i < 4; ++i) {
        const double off =
            std::hypot(found.fit.ideal[i].x - truth[i].x, found.fit.ideal[i].y - truth[i].y);
        sum += off;
        worst = std::max(worst, off);
      }
      if (worst < 2) return {true, found.fit, sum / 4};
    }
  }
  return {};
}

std::vector<platform::Scene> poses_of_the_thesis() {
  std::vector<platform::Scene> scenes;
  for (const platform::SceneGroup& group : platform::scene_groups()) {
    if (group.section.rfind("5.2.2", 0) != 0 && group.section.rfind("5.2.3", 0) != 0) continue;
    for (const std::string& name : group.scenes) scenes.push_back(platform::make_scene(name));
  }
  return scenes;
}

}  // namespace pictures
