#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include <marker/scene/pose.h>

/// Colours that people with any colour vision can tell apart (Okabe and Ito 2008), as red, green,
/// blue.
namespace platform::picture::palette {

inline const cv::Scalar orange{230, 159, 0};
inline const cv::Scalar sky_blue{86, 180, 233};
inline const cv::Scalar bluish_green{0, 158, 115};
inline const cv::Scalar yellow{240, 228, 66};
inline const cv::Scalar blue{0, 114, 178};
inline const cv::Scalar vermilion{213, 94, 0};
inline const cv::Scalar reddish_purple{204, 121, 167};

inline const cv::Scalar ink{18, 20, 26};
inline const cv::Scalar strip{24, 27, 34};
inline const cv::Scalar text{236, 238, 242};
inline const cv::Scalar faint_text{160, 166, 178};

}  // namespace platform::picture::palette

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
