#include <scene/view_geometry.h>

#include <Eigen/Geometry>

namespace platform {

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
