#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include <scene/view_geometry.h>

namespace platform {

namespace {

/// `value` rounded to an int inside 0 to width, whatever its size.
int clamp_to_row(double value, int width) {
  return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(width)));
}

}  // namespace

PixelPiece::PixelPiece(int x, int y) {
  x_ = {static_cast<double>(x), x + 1.0, x + 1.0, static_cast<double>(x)};
  y_ = {static_cast<double>(y), static_cast<double>(y), y + 1.0, y + 1.0};
}

void PixelPiece::clip(const HalfPlane& edge) {
  std::array<double, most_vertices> x{};
  std::array<double, most_vertices> y{};
  std::size_t size = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    const std::size_t next = i + 1 == size_ ? 0 : i + 1;
    const double here = edge.at(x_[i], y_[i]);
    const double there = edge.at(x_[next], y_[next]);
    if (here >= 0 && size < most_vertices) {
      x[size] = x_[i];
      y[size++] = y_[i];
    }
    if ((here >= 0) != (there >= 0) && size < most_vertices) {
      const double share = here / (here - there);
      x[size] = x_[i] + share * (x_[next] - x_[i]);
      y[size++] = y_[i] + share * (y_[next] - y_[i]);
    }
  }
  x_ = x;
  y_ = y;
  size_ = size;
}

void PixelPiece::clip(const ConvexRegion& region) {
  for (const HalfPlane& edge : region) {
    if (size_ == 0) return;
    clip(edge);
  }
}

double PixelPiece::area() const {
  double twice = 0;
  for (std::size_t i = 2; i < size_; ++i) {
    twice += (x_[i - 1] - x_[0]) * (y_[i] - y_[0]) - (x_[i] - x_[0]) * (y_[i - 1] - y_[0]);
  }
  return twice / 2;
}

PixelSpan touched_pixels(const ConvexRegion& region, int y, int width) {
  PixelSpan span{0, width};
  for (const HalfPlane& edge : region) {
    const double best = edge.b * (edge.b > 0 ? y + 1.0 : y) + edge.c;
    if (edge.a > 0) {
      span.first = std::max(span.first, clamp_to_row(std::floor(-best / edge.a), width));
    } else if (edge.a < 0) {
      span.last = std::min(span.last, clamp_to_row(std::ceil(-best / edge.a), width));
    } else if (best <= 0) {
      return {0, 0};
    }
  }
  return span.first < span.last ? span : PixelSpan{0, 0};
}

PixelSpan inner_pixels(const ConvexRegion& region, int y, int width) {
  PixelSpan span{0, width};
  for (const HalfPlane& edge : region) {
    const double worst = edge.b * (edge.b > 0 ? y : y + 1.0) + edge.c;
    if (edge.a > 0) {
      span.first = std::max(span.first, clamp_to_row(std::ceil(-worst / edge.a), width));
    } else if (edge.a < 0) {
      span.last = std::min(span.last, clamp_to_row(std::floor(-worst / edge.a), width));
    } else if (worst < 0) {
      return {0, 0};
    }
  }
  return span.first < span.last ? span : PixelSpan{0, 0};
}

namespace {

/// The plane through the camera's centre with this normal (camera frame) is a line in the image.
/// Its normal side is inside; scaled so that the value is a distance in px.
HalfPlane image_line(const Camera& camera, const Eigen::Vector3d& normal) {
  HalfPlane line{normal.x() / camera.fx, normal.y() / camera.fy, 0};
  line.c = normal.z() - line.a * camera.cx - line.b * camera.cy;
  const double length = Eigen::Vector2d(line.a, line.b).norm();
  if (length > 0) {
    line.a /= length;
    line.b /= length;
    line.c /= length;
  }
  return line;
}

HalfPlane opposite(const HalfPlane& line) {
  return {-line.a, -line.b, -line.c};
}

}  // namespace

ConvexRegion rectangle_region(const Camera& camera, const Pose& pose,
                              const PlaneRectangle& rectangle) {
  const std::array<Eigen::Vector3d, 4> corners{{
      transform(pose, {rectangle.u0, rectangle.v0, 0}),
      transform(pose, {rectangle.u1, rectangle.v0, 0}),
      transform(pose, {rectangle.u1, rectangle.v1, 0}),
      transform(pose, {rectangle.u0, rectangle.v1, 0}),
  }};
  ConvexRegion region;
  for (std::size_t i = 0; i < 4; ++i) {
    region.push_back(image_line(camera, corners[i].cross(corners[(i + 1) % 4])));
  }
  return region;
}

std::array<RoomFace, room_faces> room_regions(const Scene& scene) {
  const Room& room = scene.room;
  const std::array<Eigen::Vector3d, 4> wall_corners{{
      transform(scene.pose, {-room.side_u, room.ceiling_v, room.wall_w}),
      transform(scene.pose, {room.side_u, room.ceiling_v, room.wall_w}),
      transform(scene.pose, {room.side_u, room.floor_v, room.wall_w}),
      transform(scene.pose, {-room.side_u, room.floor_v, room.wall_w}),
  }};
  const Eigen::Vector3d into_room = scene.pose.rotation.col(2);
  std::array<HalfPlane, 4> wall_edges;  // top, right, bottom, left; the wall is inside
  std::array<HalfPlane, 4> room_edges;  // from each wall corner towards the camera
  for (std::size_t i = 0; i < 4; ++i) {
    wall_edges[i] = image_line(scene.camera, wall_corners[i].cross(wall_corners[(i + 1) % 4]));
    room_edges[i] = image_line(scene.camera, wall_corners[i].cross(into_room));
  }
  const Brightness& light = scene.brightness;
  const std::array<double, 4> levels{light.ceiling, light.side_walls, light.floor,
                                     light.side_walls};
  std::array<RoomFace, room_faces> faces;
  faces[0] = {ConvexRegion(wall_edges.begin(), wall_edges.end()), light.wall};
  for (std::size_t i = 0; i < 4; ++i) {
    // A face lies between its two long edges and in front of the wall.
    faces[i + 1] = {{opposite(wall_edges[i]), opposite(room_edges[i]), room_edges[(i + 1) % 4]},
                    levels[i]};
  }
  return faces;
}

}  // namespace platform
