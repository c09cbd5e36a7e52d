#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include <scene/camera.h>

namespace platform::picture {

/// From the corner of a pixel to its centre, px.
constexpr double pixel_centre = 0.5;

/// Draws smooth lines and text on an RGB picture of an enlarged image. Points are image
/// coordinates, px, in which the centre of the first pixel is (0.5, 0.5); widths and sizes are px
/// of the picture.
class Canvas {
 public:
  Canvas(cv::Mat& target, int enlargement) : target_(target), enlargement_(enlargement) {}

  void line(PixelPoint from, PixelPoint to, const cv::Scalar& colour, int width);
  void arrow(PixelPoint from, PixelPoint to, const cv::Scalar& colour, int width);
  void outline(const std::vector<PixelPoint>& corners, const cv::Scalar& colour, int width);
  /// A thin upright frame around whole pixels: left and top are the first inside, right and bottom
  /// the first beyond.
  void box(int left, int top, int right, int bottom, const cv::Scalar& colour);
  /// A triangle around `centre` whose tip points along (dx, dy), a unit step.
  void triangle(PixelPoint centre, int dx, int dy, const cv::Scalar& colour, double size);
  void dot(PixelPoint centre, const cv::Scalar& colour, double radius);
  /// Text on a dark ground, its middle at `centre`, moved so that it stays inside the picture.
  void label(PixelPoint centre, const std::string& text, const cv::Scalar& colour, double size);

 private:
  cv::Point fixed(PixelPoint point) const;
  cv::Point2d in_picture(PixelPoint point) const;

  cv::Mat& target_;
  int enlargement_;
};

/// Text with its left end of the baseline at `origin`, px of the picture. Characters beyond ASCII
/// are drawn as '?'.
void draw_text(cv::Mat& target, cv::Point origin, const std::string& text, const cv::Scalar& colour,
               double size);
int text_width(const std::string& text, double size);

}  // namespace platform::picture
