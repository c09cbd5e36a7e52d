#include <picture/annotate.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <picture/canvas.h>
#include <picture/palette.h>
#include <picture/strip.h>

namespace platform::picture {

namespace {

constexpr int usual_width = 1280;
constexpr double corner_size = 4.5;
constexpr double near_plane_m = 0.01;
/// The image is drawn a little paler and darker than it is, so that colours stand out.
constexpr double contrast = 0.80;
constexpr double brightness = 16;

PixelPoint centre_of(double column, double row) {
  return {column + pixel_centre, row + pixel_centre};
}

struct Heading {
  int dx, dy;
  const cv::Scalar& colour;
};

Heading heading(marker::Direction direction) {
  switch (direction) {
    case marker::Direction::north:
      return {0, -1, palette::sky_blue};
    case marker::Direction::south:
      return {0, 1, palette::orange};
    case marker::Direction::east:
      return {1, 0, palette::bluish_green};
    default:
      return {-1, 0, palette::vermillion};
  }
}

void draw_features(Canvas& canvas, const report::Features& features) {
  for (const marker::BoundingBox& box : features.blobs) {
    canvas.box(box.sx, box.sy, box.ex + 1, box.ey + 1, palette::reddish_purple);
  }
  for (const auto& corners : features.candidates) {
    std::vector<PixelPoint> points;
    for (const PixelPoint& corner : corners) points.push_back(centre_of(corner.x, corner.y));
    canvas.outline(points, palette::blue, 2);
  }
  for (const marker::Corner& corner : features.corners) {
    const Heading to = heading(corner.direction);
    canvas.triangle(centre_of(corner.x, corner.y), to.dx, to.dy, to.colour, corner_size);
  }
}

/// Arrows of half the marker's side from its own top left corner; w points away from the viewer.
void draw_axes(Canvas& canvas, const Camera& camera, const Pose& pose) {
  constexpr double length = marker_side_m / 2;
  struct Axis {
    const char* name;
    Eigen::Vector3d end;
    const cv::Scalar& colour;
  };
  const std::array<Axis, 3> axes{{{"w", {0, 0, length}, palette::blue},
                                  {"v", {0, length, 0}, palette::bluish_green},
                                  {"u", {length, 0, 0}, palette::vermillion}}};
  const Eigen::Vector3d origin = transform(pose, {0, 0, 0});
  if (origin[2] < near_plane_m) return;
  for (const Axis& axis : axes) {
    const Eigen::Vector3d end = transform(pose, axis.end);
    if (end[2] < near_plane_m) continue;
    const PixelPoint from = project(camera, origin);
    const PixelPoint to = project(camera, end);
    canvas.arrow(from, to, axis.colour, 3);
    const PixelPoint name{from.x + (to.x - from.x) * 1.12, from.y + (to.y - from.y) * 1.12};
    canvas.label(name, axis.name, palette::text, 0.45);
  }
}

PixelPoint outwards(PixelPoint middle, PixelPoint corner, double px) {
  const double dx = corner.x - middle.x;
  const double dy = corner.y - middle.y;
  const double length = std::max(1.0, std::sqrt(dx * dx + dy * dy));
  return {corner.x + dx / length * px, corner.y + dy / length * px};
}

void draw_marker(Canvas& canvas, const report::FoundMarker& found, const Camera& camera) {
  const auto& corners = found.corners_px;
  PixelPoint middle;
  double top = corners[0].y;
  for (const PixelPoint& corner : corners) {
    middle.x += corner.x / 4;
    middle.y += corner.y / 4;
    top = std::min(top, corner.y);
  }
  canvas.outline({corners.begin(), corners.end()}, palette::yellow, 3);
  if (found.has_pose) draw_axes(canvas, camera, found.pose);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    canvas.dot(corners[i], palette::yellow, i == 0 ? 6 : 4);
    canvas.label(outwards(middle, corners[i], 9), std::to_string(i + 1), palette::yellow, 0.45);
  }
  canvas.label({middle.x, top - 22}, fmt::format("ID {}", found.id), palette::yellow, 0.8);
}

void draw_image(const GreyImage& image, int enlargement, cv::Mat target) {
  // OpenCV's type has no const view of somebody else's pixels; they are only read.
  const cv::Mat grey(image.height, image.width, CV_8UC1,
                     const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat paler;
  grey.convertTo(paler, CV_8U, contrast, brightness);
  cv::Mat enlarged;
  cv::resize(paler, enlarged, {}, enlargement, enlargement, cv::INTER_NEAREST);
  cv::cvtColor(enlarged, target, cv::COLOR_GRAY2RGB);
}

}  // namespace

Picture annotate(const GreyImage& image, const report::FrameReport& frame) {
  cv::setNumThreads(1);  // a pool of threads costs more than it gives here
  const int enlargement = std::max(1, usual_width / image.width);
  const int rows = image.height * enlargement;
  Picture picture{image.width * enlargement, rows + strip_height, {}};
  picture.rgb.resize(static_cast<std::size_t>(picture.width) *
                     static_cast<std::size_t>(picture.height) * 3);
  cv::Mat whole(picture.height, picture.width, CV_8UC3, picture.rgb.data());
  cv::Mat view = whole.rowRange(0, rows);
  draw_image(image, enlargement, view);
  Canvas canvas(view, enlargement);
  draw_features(canvas, frame.features);
  for (const report::FoundMarker& found : frame.markers) draw_marker(canvas, found, frame.camera);
  cv::Mat strip = whole.rowRange(rows, picture.height);
  draw_strip(strip, frame);
  return picture;
}

std::string picture_name(const report::FrameReport& frame) {
  // Names of files have at most 255 bytes, and more is added to this one.
  constexpr std::size_t longest_stem = 200;
  std::string stem = frame.input.substr(0, frame.input.rfind('.'));
  const std::size_t number = frame.input.rfind('#');  // of a video's picture
  if (number != std::string::npos && number > stem.size()) stem += frame.input.substr(number);
  if (frame.truth) stem = frame.input;  // a scene: "z1.0" has no extension
  stem.resize(std::min(stem.size(), longest_stem));
  for (char& c : stem) {
    const bool usual =
        std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.' || c == '_';
    if (!usual) c = '_';
  }
  return fmt::format("{:04}_{}.png", frame.index, stem);
}

}  // namespace platform::picture
