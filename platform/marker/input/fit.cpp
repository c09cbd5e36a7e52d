#include <marker/input/fit.h>

#include <vp/error.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace platform::input {

namespace {

bool same(ImageSize a, ImageSize b) {
  return a.width == b.width && a.height == b.height;
}

std::string text(ImageSize size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

/// Which part of an image is kept, and where it is in the frame.
struct Placement {
  cv::Rect part;
  cv::Rect place;
};

cv::Rect middle(ImageSize whole, ImageSize part) {
  return {(whole.width - part.width) / 2, (whole.height - part.height) / 2, part.width,
          part.height};
}

Placement placement(ImageSize size, ImageSize target, Fit fit) {
  if (fit == Fit::crop) return {middle(size, target), {0, 0, target.width, target.height}};
  const double factor = std::min(static_cast<double>(target.width) / size.width,
                                 static_cast<double>(target.height) / size.height);
  const auto scaled = [factor](int side, int most) {
    return std::clamp(static_cast<int>(std::lround(side * factor)), 1, most);
  };
  return {{0, 0, size.width, size.height},
          middle(target, {scaled(size.width, target.width), scaled(size.height, target.height)})};
}

/// Of the pixels brighter than the mean; of an image of one level that level.
std::uint8_t bright_level(const cv::Mat& image) {
  const double mean = cv::mean(image)[0];
  const cv::Mat bright = image >= mean;
  return cv::saturate_cast<std::uint8_t>(cv::mean(image, bright)[0]);
}

}  // namespace

void check_fit(const std::string& name, ImageSize size, ImageSize target, Fit fit) {
  if (std::max(size.width, size.height) > largest_side_px) {
    throw vp::InputError("'" + name + "' is " + text(size) + " px: an image has at most " +
                         std::to_string(largest_side_px) + " px a side");
  }
  if (same(size, target) || fit == Fit::scale) return;
  const std::string problem =
      "'" + name + "' is " + text(size) + " px, the platform takes " + text(target) + ": ";
  if (fit == Fit::none) throw vp::InputError(problem + "use --fit crop or --fit scale");
  if (size.width < target.width || size.height < target.height) {
    throw vp::InputError(problem + "too small to crop, use --fit scale");
  }
}

GreyImage fit_image(GreyImage image, ImageSize target, Fit fit) {
  const ImageSize size{image.width, image.height};
  if (same(size, target)) return image;
  const cv::Mat whole(image.height, image.width, CV_8UC1, image.pixels.data());
  const auto [part, place] = placement(size, target, fit);
  GreyImage fitted{target.width, target.height, {}};
  fitted.pixels.resize(static_cast<std::size_t>(target.width) *
                       static_cast<std::size_t>(target.height));
  cv::Mat result(target.height, target.width, CV_8UC1, fitted.pixels.data());
  // With one thread and the exact bilinear variant the pixels are the same on every host.
  cv::setNumThreads(1);
  if (place.size() != result.size()) result.setTo(bright_level(whole));
  cv::Mat inside = result(place);
  const bool grows = part.width < place.width || part.height < place.height;
  cv::resize(whole(part), inside, inside.size(), 0, 0,
             grows ? cv::INTER_LINEAR_EXACT : cv::INTER_AREA);
  return fitted;
}

Camera fit_camera(const Camera& camera, ImageSize target, Fit fit) {
  const ImageSize size{camera.width, camera.height};
  if (same(size, target)) return camera;
  const auto [part, place] = placement(size, target, fit);
  const double sx = static_cast<double>(place.width) / part.width;
  const double sy = static_cast<double>(place.height) / part.height;
  Camera fitted = camera;
  fitted.width = target.width;
  fitted.height = target.height;
  fitted.fx = camera.fx * sx;
  fitted.fy = camera.fy * sy;
  fitted.cx = place.x + (camera.cx - part.x) * sx;
  fitted.cy = place.y + (camera.cy - part.y) * sy;
  return fitted;
}

std::string fit_text(ImageSize size, ImageSize target, Fit fit) {
  if (same(size, target) || fit == Fit::none) return "";
  const auto [part, place] = placement(size, target, fit);
  const std::string images = "images of " + text(size) + " px ";
  if (fit == Fit::crop) {
    const double kept = static_cast<double>(part.area()) / (1.0 * size.width * size.height);
    return images + "are cropped to their middle " + text(target) +
           " px: " + std::to_string(std::lround(100 * (1 - kept))) + " % of each is cut off";
  }
  const ImageSize scaled{place.width, place.height};
  std::string result = images + "are scaled to " + text(scaled) + " px (" +
                       std::to_string(std::lround(100.0 * place.width / part.width)) + " %), whole";
  const int beside = target.width - place.width, above = target.height - place.height;
  if (beside > 0)
    result += ", with bars of " + std::to_string(beside) + " px in all at their sides";
  if (above > 0) result += ", with bars of " + std::to_string(above) + " px in all above and below";
  return result;
}

}  // namespace platform::input
