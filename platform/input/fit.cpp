#include <input/fit.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <scene/camera.h>
#include <vp/error.h>

namespace platform::input {

namespace {

bool same(ImageSize a, ImageSize b) {
  return a.width == b.width && a.height == b.height;
}

std::string text(ImageSize size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

/// The part of the image that is kept.
cv::Rect kept_part(ImageSize size, ImageSize target, Fit fit) {
  ImageSize part = target;
  if (fit == Fit::scale) {
    const double aspect = static_cast<double>(target.width) / target.height;
    part.width = std::clamp(static_cast<int>(std::lround(size.height * aspect)), 1, size.width);
    part.height = std::clamp(static_cast<int>(std::lround(size.width / aspect)), 1, size.height);
  }
  return {(size.width - part.width) / 2, (size.height - part.height) / 2, part.width, part.height};
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
  const cv::Rect part = kept_part(size, target, fit);
  GreyImage fitted{target.width, target.height, {}};
  fitted.pixels.resize(static_cast<std::size_t>(target.width) *
                       static_cast<std::size_t>(target.height));
  cv::Mat result(target.height, target.width, CV_8UC1, fitted.pixels.data());
  const bool grows = part.width < target.width || part.height < target.height;
  // With one thread and the exact bilinear variant the pixels are the same on every host.
  cv::setNumThreads(1);
  cv::resize(whole(part), result, result.size(), 0, 0,
             grows ? cv::INTER_LINEAR_EXACT : cv::INTER_AREA);
  return fitted;
}

Camera fit_camera(const Camera& camera, ImageSize target, Fit fit) {
  const ImageSize size{camera.width, camera.height};
  if (same(size, target)) return camera;
  const cv::Rect part = kept_part(size, target, fit);
  const double sx = static_cast<double>(target.width) / part.width;
  const double sy = static_cast<double>(target.height) / part.height;
  return {target.width,
          target.height,
          camera.fx * sx,
          camera.fy * sy,
          (camera.cx - part.x) * sx,
          (camera.cy - part.y) * sy};
}

}  // namespace platform::input
