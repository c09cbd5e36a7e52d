#include <scene/catalogue_views.h>

#include <array>
#include <utility>

namespace platform {

namespace {

/// Distance between the squares of thesis 5.2.4, m (decision).
constexpr double square_pitch_m = 0.62;

/// Columns and rows of the squares in the order in which they appear (decision).
constexpr std::array<std::pair<int, int>, most_squares> square_places{{
    {0, 0},
    {-1, 0},
    {1, 0},
    {0, -1},
    {0, 1},
    {-1, -1},
    {1, -1},
    {-1, 1},
    {1, 1},
    {-2, 0},
    {2, 0},
    {-2, -1},
    {2, -1},
    {-2, 1},
    {2, 1},
}};

}  // namespace

void fill_squares(Scene& scene, int count) {
  scene.pose.translation = {-marker_side_m / 2, -marker_side_m / 2, 2.5};
  for (int i = 1; i < count; ++i) {
    const auto [column, row] = square_places[static_cast<std::size_t>(i)];
    Square square;
    square.u = column * square_pitch_m;
    square.v = row * square_pitch_m;
    scene.squares.push_back(square);
  }
}

const std::vector<IdentificationView>& identification_views() {
  static const std::vector<IdentificationView> views{
      {0, {0.00, 0.05, 1.20}, 20, -15, 0},      {7, {-0.45, 0.20, 1.80}, -10, 30, 10},
      {15, {0.50, -0.25, 1.60}, 12, 30, 98},    {21, {0.30, 0.30, 1.40}, -30, 14, 195},
      {36, {-0.20, -0.35, 2.20}, 5, -40, -95},  {43, {0.90, 0.10, 2.60}, 20, -25, 20},
      {52, {-0.30, 0.00, 1.00}, 30, 20, -8},    {76, {0.15, -0.10, 0.80}, 10, 45, 5},
      {88, {-0.80, 0.45, 3.00}, -12, -12, 190}, {99, {0.40, 0.15, 3.50}, -8, -18, -70},
  };
  return views;
}

Pose pose_of(const IdentificationView& view) {
  const Eigen::Matrix3d rotation =
      rotation_x(view.pitch) * (rotation_y(view.yaw) * rotation_z(view.roll));
  return pose_from_centre(rotation, view.centre);
}

void fill_demo(Scene& scene) {
  constexpr double pitch = square_pitch_m;
  constexpr double small = 0.19;
  scene.marker_id = 99;
  const Eigen::Matrix3d rotation = rotation_x(14) * (rotation_y(34) * rotation_z(-4));
  scene.pose = pose_from_centre(rotation, {0.08, 0.02, 1.75});
  // Foreign words: the markers of another dictionary.
  scene.squares = {
      {-pitch, 0, marker_side_m, 0x6BD6},
      {pitch, 0, marker_side_m, 0x9429},
      {0, -pitch, marker_side_m, 0x6996},
      {0, pitch, marker_side_m, plain_square_word},
      {-pitch, -pitch, marker_side_m, plain_square_word},
      {pitch, -pitch, marker_side_m, plain_square_word},
      {-pitch, pitch, marker_side_m, 0xF6F0},
      {-1.04, -0.62, small, plain_square_word},
      {-1.04, -0.20, small, 0x7BDE},
      {-1.04, 0.22, small, plain_square_word},
      {-1.04, 0.64, small, 0xFBD7},
  };
}

}  // namespace platform
