#include <algorithm>

#include <marker/scene/camera_effects.h>
#include <marker/scene/portable_math.h>
#include <marker/scene/renderer.h>
#include <marker/scene/scene.h>
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

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

namespace {

/// Gaussian blur, in place, of a picture of width x height values; beyond the border its outermost
/// value continues. The kernel ends at four deviations. `sigma` in px; 0 changes nothing.
void gaussian_blur(std::vector<double>& picture, int width, int height, double sigma);

/// Weights of offsets -radius to +radius; their sum is 1.
std::vector<double> gaussian_kernel(double sigma) {
  const int radius = static_cast<int>(std::ceil(4 * sigma));
  std::vector<double> kernel;
  double sum = 0;
  for (int offset = -radius; offset <= radius; ++offset) {
    const double scaled = offset / sigma;
    kernel.push_back(portable_exp_negative(-scaled * scaled / 2));
    sum += kernel.back();
  }
  for (double& weight : kernel) weight /= sum;
  return kernel;
}

/// Blurs `count` values that stand `stride` apart. `line` is scratch.
void blur_line(double* values, int count, std::size_t stride, const std::vector<double>& kernel,
               std::vector<double>& line) {
  const int radius = static_cast<int>(kernel.size() / 2);
  line.clear();
  for (int i = -radius; i < count + radius; ++i) {
    line.push_back(values[static_cast<std::size_t>(std::clamp(i, 0, count - 1)) * stride]);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < kernel.size(); ++k) sum += kernel[k] * line[i + k];
    values[i * stride] = sum;
  }
}

void gaussian_blur(std::vector<double>& picture, int width, int height, double sigma) {
  if (sigma <= 0) return;
  const std::vector<double> kernel = gaussian_kernel(sigma);
  const auto row_length = static_cast<std::size_t>(width);
  std::vector<double> line;
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    blur_line(picture.data() + y * row_length, width, 1, kernel, line);
  }
  for (std::size_t x = 0; x < row_length; ++x) {
    blur_line(picture.data() + x, height, row_length, kernel, line);
  }
}

}  // namespace

namespace {

/// Below this the blur cannot be seen in 8 bits, and the kernel has no width.
constexpr double smallest_blur_px = 0.05;
constexpr double full_scale = 255.0;

/// A marker has 6x6 cells; the outer ring is black.
constexpr int cells_per_side = 6;

struct Rows {
  int begin, end;
};

/// Paints surfaces into some rows of the picture, in the order room, borders, black squares, white
/// cells. Squares do not hide one another, so what each adds to a pixel is its brightness minus
/// what it covers, times the covered area.
class Painter {
 public:
  Painter(const Scene& scene, Rows rows)
      : scene_(scene),
        rows_(rows),
        width_(scene.camera.width),
        faces_(room_regions(scene)),
        light_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(rows.end - rows.begin)),
        face_(light_.size(), mixed) {}

  std::vector<double> paint() {
    paint_room();
    paint_square({0, 0, marker_side_m, marker_word(scene_.marker_id)});
    for (const Square& square : scene_.squares) paint_square(square);
    return std::move(light_);
  }

 private:
  static constexpr std::uint8_t mixed = std::numeric_limits<std::uint8_t>::max();

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - rows_.begin) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  /// Calls inner(x, y) for pixels wholly inside the region and edge(x, y, piece) for those it
  /// shares with another.
  template <typename Inner, typename Edge>
  void visit(const ConvexRegion& region, Inner inner, Edge edge) const {
    const auto edges = [&](int y, int first, int last) {
      for (int x = first; x < last; ++x) {
        PixelPiece piece(x, y);
        piece.clip(region);
        edge(x, y, piece);
      }
    };
    for (int y = rows_.begin; y < rows_.end; ++y) {
      const PixelSpan touched = touched_pixels(region, y, width_);
      const PixelSpan inside = inner_pixels(region, y, width_);
      if (inside.first == inside.last) {
        edges(y, touched.first, touched.last);
        continue;
      }
      edges(y, touched.first, inside.first);
      for (int x = inside.first; x < inside.last; ++x) inner(x, y);
      edges(y, inside.last, touched.last);
    }
  }

  void paint_room() {
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      const double level = faces_[i].level;
      visit(
          faces_[i].region,
          [&](int x, int y) {
            light_[index(x, y)] = level;
            face_[index(x, y)] = static_cast<std::uint8_t>(i);
          },
          [&](int x, int y, const PixelPiece& piece) {
            light_[index(x, y)] += level * piece.area();
          });
    }
  }

  /// Light of the room behind a piece of a pixel, times its area.
  double room_behind(int x, int y, const PixelPiece& piece) const {
    const std::uint8_t face = face_[index(x, y)];
    if (face != mixed) return faces_[face].level * piece.area();
    double sum = 0;
    for (const RoomFace& candidate : faces_) {
      PixelPiece part = piece;
      part.clip(candidate.region);
      sum += candidate.level * part.area();
    }
    return sum;
  }

  void paint_border(const PlaneRectangle& outer) {
    const double level = scene_.brightness.border;
    visit(
        rectangle_region(scene_.camera, scene_.pose, outer),
        [&](int x, int y) { light_[index(x, y)] = level; },
        [&](int x, int y, const PixelPiece& piece) {
          light_[index(x, y)] += level * piece.area() - room_behind(x, y, piece);
        });
  }

  /// Changes the brightness of an area that has one.
  void repaint(const PlaneRectangle& area, double from, double to) {
    visit(
        rectangle_region(scene_.camera, scene_.pose, area),
        [&](int x, int y) { light_[index(x, y)] += to - from; },
        [&](int x, int y, const PixelPiece& piece) {
          light_[index(x, y)] += (to - from) * piece.area();
        });
  }

  void paint_square(const Square& square) {
    const double border = square.side * border_fraction;
    paint_border({square.u - border, square.v - border, square.u + square.side + border,
                  square.v + square.side + border});
    const double white = scene_.brightness.border;
    const double black = scene_.brightness.black;
    repaint({square.u, square.v, square.u + square.side, square.v + square.side}, white, black);
    const double cell = square.side / cells_per_side;
    for (int row = 0; row < 4; ++row) {
      const double v = square.v + (row + 1) * cell;
      for (int column = 0; column < 4; ++column) {
        if (is_black(square.word, row, column)) continue;
        const int first = column;
        while (column + 1 < 4 && !is_black(square.word, row, column + 1)) ++column;
        repaint({square.u + (first + 1) * cell, v, square.u + (column + 2) * cell, v + cell}, black,
                white);
      }
    }
  }

  const Scene& scene_;
  Rows rows_;
  int width_;
  std::array<RoomFace, room_faces> faces_;
  std::vector<double> light_;
  std::vector<std::uint8_t> face_;  ///< the room face behind each pixel, or `mixed`
};

}  // namespace

namespace {

/// The farthest that a corner of the marker comes while a row gathers light, px.
double farthest_px(const Scene& scene) {
  const double half_s = scene.shutter.exposure_s / 2;
  const auto begin = project_marker(scene.camera, pose_at(scene, scene.time_s - half_s)),
             end = project_marker(scene.camera, pose_at(scene, scene.time_s + half_s));
  double farthest = 0;
  for (std::size_t i = 0; i < begin.size(); ++i)
    farthest = std::max(farthest, std::hypot(end[i].x - begin[i].x, end[i].y - begin[i].y));
  return farthest;
}

/// Adds the mean over the exposure of these rows, whose middle is at `time_s`.
void expose(const Scene& scene, Rows rows, double time_s, int moments,
            std::vector<double>& picture) {
  Scene still = scene;
  for (int moment = 0; moment < moments; ++moment) {
    const double share = (moment + 0.5) / moments - 0.5;
    still.pose = pose_at(scene, time_s + share * scene.shutter.exposure_s);
    const std::vector<double> light = Painter(still, rows).paint();
    double* to = picture.data() + static_cast<std::ptrdiff_t>(rows.begin) * scene.camera.width;
    for (const double value : light) *to++ += value / moments;
  }
}

/// Of a scene that moves: each row, or all of them at once, at its own times.
std::vector<double> moving_light(const Scene& scene) {
  constexpr double moments_a_px = 4;
  constexpr int most_moments = 64;
  const int moments = static_cast<int>(
      std::clamp(std::ceil(moments_a_px * farthest_px(scene)), 1.0, double{most_moments}));
  const int height = scene.camera.height;
  std::vector<double> picture(static_cast<std::size_t>(scene.camera.width) *
                              static_cast<std::size_t>(height));
  if (scene.shutter.readout_s == 0) {
    expose(scene, {0, height}, scene.time_s, moments, picture);
    return picture;
  }
  for (int y = 0; y < height; ++y)
    expose(scene, {y, y + 1}, exposure_time(scene, y + 0.5), moments, picture);
  return picture;
}

/// Less light towards the corners, with the square of the distance from the optical axis.
void darken(const Scene& scene, std::vector<double>& picture) {
  const Camera& camera = scene.camera;
  const double far_x = std::max(camera.cx, camera.width - camera.cx),
               far_y = std::max(camera.cy, camera.height - camera.cy);
  const double missing = scene.vignetting / (far_x * far_x + far_y * far_y);
  double* pixel = picture.data();
  for (int y = 0; y < camera.height; ++y) {
    const double dy = y + 0.5 - camera.cy;
    for (int x = 0; x < camera.width; ++x) {
      const double dx = x + 0.5 - camera.cx;
      *pixel++ *= 1 - missing * (dx * dx + dy * dy);
    }
  }
}

}  // namespace

std::vector<double> render_light(const Scene& scene) {
  validate(scene);
  std::vector<double> light =
      scene.motion.any() ? moving_light(scene) : Painter(scene, {0, scene.camera.height}).paint();
  if (scene.hidden > 0) hide_corner(scene, light);
  if (scene.blur_sigma_px >= smallest_blur_px) {
    gaussian_blur(light, scene.camera.width, scene.camera.height, scene.blur_sigma_px);
  }
  if (scene.vignetting > 0) darken(scene, light);
  return light;
}

GreyImage render(const Scene& scene) {
  const std::vector<double> light = render_light(scene);
  GreyImage image{scene.camera.width, scene.camera.height, {}};
  image.pixels.reserve(light.size());
  GaussianNoise noise(scene.seed);
  for (double value : light) {
    double noisy = value + scene.noise_sigma * noise.next();
    if (scene.light_of_levels) noisy = level_of(noisy, *scene.light_of_levels);
    const double rounded = std::floor(noisy * full_scale + 0.5);
    image.pixels.push_back(static_cast<std::uint8_t>(std::clamp(rounded, 0.0, full_scale)));
  }
  if (scene.jpeg > 0) lose_as_jpeg(image, scene.jpeg);
  return image;
}

}  // namespace platform
