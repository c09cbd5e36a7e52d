#include <marker/picture/canvas.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace platform::picture {

namespace {

/// OpenCV draws with whole numbers of 2^-shift px; the centre of its first pixel is (0, 0).
constexpr int shift = 4;
constexpr double fraction = 1 << shift;
/// Far outside any picture, and safe in OpenCV's fixed-point arithmetic.
constexpr double farthest_px = 1e5;
/// Dark margin on each side of a line that must be seen on any ground.
constexpr int halo = 1;
constexpr int font = cv::FONT_HERSHEY_SIMPLEX;
constexpr double arrow_head_px = 11;
constexpr double arrow_head_slope = 0.5;

cv::Point fixed_point(cv::Point2d p) {
  const auto bounded = [](double v) { return std::clamp(v, -farthest_px, farthest_px); };
  return {static_cast<int>(std::lround(bounded(p.x) * fraction)),
          static_cast<int>(std::lround(bounded(p.y) * fraction))};
}

std::string ascii(const std::string& text) {
  std::string result = text;
  for (char& c : result) {
    if (c < 0x20 || c > 0x7E) c = '?';
  }
  return result;
}

int stroke(double size) {
  return size >= 0.8 ? 2 : 1;
}

}  // namespace

cv::Point2d Canvas::in_picture(PixelPoint point) const {
  return {point.x * enlargement_ - pixel_centre, point.y * enlargement_ - pixel_centre};
}

cv::Point Canvas::fixed(PixelPoint point) const {
  return fixed_point(in_picture(point));
}

void Canvas::line(PixelPoint from, PixelPoint to, const cv::Scalar& colour, int width) {
  cv::line(target_, fixed(from), fixed(to), colour, width, cv::LINE_AA, shift);
}

void Canvas::arrow(PixelPoint from, PixelPoint to, const cv::Scalar& colour, int width) {
  const cv::Point2d tail = in_picture(from);
  const cv::Point2d tip = in_picture(to);
  const double length = std::hypot(tip.x - tail.x, tip.y - tail.y);
  if (length < 1) return;
  const cv::Point2d along = (tip - tail) / length;
  const cv::Point2d across(-along.y, along.x);
  const double head = std::min(arrow_head_px, length / 2);
  const cv::Point2d neck = tip - along * head;
  const std::vector<cv::Point> triangle{fixed_point(tip),
                                        fixed_point(neck + across * head * arrow_head_slope),
                                        fixed_point(neck - across * head * arrow_head_slope)};
  for (const bool dark : {true, false}) {
    const cv::Scalar& ink = dark ? palette::ink : colour;
    const int margin = dark ? 2 * halo : 0;
    cv::line(target_, fixed_point(tail), fixed_point(neck), ink, width + margin, cv::LINE_AA,
             shift);
    if (dark) cv::polylines(target_, triangle, true, ink, 1 + margin, cv::LINE_AA, shift);
    cv::fillConvexPoly(target_, triangle, ink, cv::LINE_AA, shift);
  }
}

void Canvas::outline(const std::vector<PixelPoint>& corners, const cv::Scalar& colour, int width) {
  std::vector<cv::Point> points;
  points.reserve(corners.size());
  for (const PixelPoint& corner : corners) points.push_back(fixed(corner));
  if (width > 1) {
    cv::polylines(target_, points, true, palette::ink, width + 2 * halo, cv::LINE_AA, shift);
  }
  cv::polylines(target_, points, true, colour, width, cv::LINE_AA, shift);
}

void Canvas::box(int left, int top, int right, int bottom, const cv::Scalar& colour) {
  const cv::Point first(left * enlargement_ - 1, top * enlargement_ - 1);
  cv::rectangle(target_, first, {right * enlargement_, bottom * enlargement_}, colour, 1);
}

void Canvas::triangle(PixelPoint centre, int dx, int dy, const cv::Scalar& colour, double size) {
  const cv::Point2d middle = in_picture(centre);
  const cv::Point2d along(dx, dy);
  const cv::Point2d across(-dy, dx);
  const auto shape = [&](double scale) {
    return std::vector<cv::Point>{fixed_point(middle + along * scale),
                                  fixed_point(middle - (along - across) * scale * 0.75),
                                  fixed_point(middle - (along + across) * scale * 0.75)};
  };
  cv::fillConvexPoly(target_, shape(size + 1.5 * halo), palette::ink, cv::LINE_AA, shift);
  cv::fillConvexPoly(target_, shape(size), colour, cv::LINE_AA, shift);
}

void Canvas::dot(PixelPoint centre, const cv::Scalar& colour, double radius) {
  const auto size = [](double px) { return static_cast<int>(std::lround(px * fraction)); };
  cv::circle(target_, fixed(centre), size(radius + halo), palette::ink, cv::FILLED, cv::LINE_AA,
             shift);
  cv::circle(target_, fixed(centre), size(radius), colour, cv::FILLED, cv::LINE_AA, shift);
}

void Canvas::label(PixelPoint centre, const std::string& text, const cv::Scalar& colour,
                   double size) {
  int baseline = 0;
  const cv::Size box = cv::getTextSize(ascii(text), font, size, stroke(size), &baseline);
  const int margin = std::max(3, box.height / 3);
  const cv::Size ground(box.width + 2 * margin, box.height + 2 * margin);
  const cv::Point2d middle = in_picture(centre);
  const int right = std::max(0, target_.cols - ground.width);
  const int bottom = std::max(0, target_.rows - ground.height);
  const cv::Point corner(
      std::clamp(static_cast<int>(std::lround(middle.x)) - ground.width / 2, 0, right),
      std::clamp(static_cast<int>(std::lround(middle.y)) - ground.height / 2, 0, bottom));
  const cv::Rect inside = cv::Rect(corner, ground) & cv::Rect({0, 0}, target_.size());
  cv::Mat area = target_(inside);
  constexpr double ground_weight = 0.75;
  cv::addWeighted(area, 1 - ground_weight, cv::Mat(area.size(), area.type(), palette::ink),
                  ground_weight, 0, area);
  draw_text(target_, {corner.x + margin, corner.y + margin + box.height}, text, colour, size);
}

void draw_text(cv::Mat& target, cv::Point origin, const std::string& text, const cv::Scalar& colour,
               double size) {
  cv::putText(target, ascii(text), origin, font, size, colour, stroke(size), cv::LINE_AA);
}

int text_width(const std::string& text, double size) {
  int baseline = 0;
  return cv::getTextSize(ascii(text), font, size, stroke(size), &baseline).width;
}

}  // namespace platform::picture
