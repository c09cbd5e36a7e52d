#include "pictures.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include <marker/scene/renderer.h>
#include <marker/scene/scene.h>

namespace integration {

namespace {

constexpr double lens_blur_px = 0.7;
constexpr double noise_levels = 4;

/// 1 in the middle, a fifth brighter on the right and darker on the left.
cv::Mat light_from_the_right(cv::Size size) {
  cv::Mat light(size, CV_32F);
  for (int x = 0; x < size.width; ++x) light.col(x).setTo(0.8 + 0.4 * x / size.width);
  return light;
}

}  // namespace

cv::Mat scene_picture(const std::string& scene, int width, int height) {
  const platform::GreyImage image =
      render(platform::make_scene(scene, platform::Camera::for_resolution(width, height)));
  return cv::Mat(height, width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data())).clone();
}

cv::Mat photograph(const std::string& scene) {
  cv::Mat grey;
  scene_picture(scene).convertTo(grey, CV_32F);
  grey = grey.mul(light_from_the_right(grey.size()));
  cv::GaussianBlur(grey, grey, cv::Size(), lens_blur_px);
  cv::Mat colour;
  cv::merge(std::vector<cv::Mat>{grey * 0.8, grey * 1.0, grey * 1.05}, colour);
  cv::Mat noise(colour.size(), colour.type());
  cv::RNG(7).fill(noise, cv::RNG::NORMAL, 0, noise_levels);
  colour += noise;
  colour.convertTo(colour, CV_8UC3);
  return colour;
}

cv::Mat empty_wall() {
  cv::Mat wall = light_from_the_right({640, 480}) * 150;
  wall.convertTo(wall, CV_8U);
  return wall;
}

void write_picture(const std::string& path, const cv::Mat& picture) {
  if (!cv::imwrite(path, picture)) throw std::runtime_error("cannot write " + path);
}

}  // namespace integration
