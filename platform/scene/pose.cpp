#include <scene/portable_math.h>
#include <scene/pose.h>
#include <vp/error.h>

#include <cmath>
#include <string>

namespace platform {

namespace {

constexpr double rotation_tolerance = 1e-6;
constexpr double pi = 3.14159265358979323846;

Matrix3 transpose(const Matrix3& m) {
  Matrix3 t;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) t[row][column] = m[column][row];
  }
  return t;
}

double determinant(const Matrix3& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

}  // namespace

Matrix3 rotation_x(double degrees) {
  const auto [s, c] = portable_sin_cos_degrees(degrees);
  return {{{1, 0, 0}, {0, c, -s}, {0, s, c}}};
}

Matrix3 rotation_y(double degrees) {
  const auto [s, c] = portable_sin_cos_degrees(degrees);
  return {{{c, 0, s}, {0, 1, 0}, {-s, 0, c}}};
}

Matrix3 rotation_z(double degrees) {
  const auto [s, c] = portable_sin_cos_degrees(degrees);
  return {{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
}

Matrix3 multiply(const Matrix3& a, const Matrix3& b) {
  Matrix3 product;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      product[row][column] =
          a[row][0] * b[0][column] + a[row][1] * b[1][column] + a[row][2] * b[2][column];
    }
  }
  return product;
}

Vector3 rotate(const Matrix3& m, const Vector3& v) {
  Vector3 result;
  for (int row = 0; row < 3; ++row) {
    result[row] = m[row][0] * v[0] + m[row][1] * v[1] + m[row][2] * v[2];
  }
  return result;
}

Vector3 transform(const Pose& pose, const Vector3& marker_point) {
  Vector3 point = rotate(pose.rotation, marker_point);
  for (int i = 0; i < 3; ++i) point[i] += pose.translation[i];
  return point;
}

Vector3 camera_position(const Pose& pose) {
  Vector3 position = rotate(transpose(pose.rotation), pose.translation);
  for (double& coordinate : position) coordinate = -coordinate;
  return position;
}

Pose pose_from_centre(const Matrix3& rotation, const Vector3& centre, double side_m) {
  const Vector3 offset = rotate(rotation, {side_m / 2, side_m / 2, 0});
  return {rotation, {centre[0] - offset[0], centre[1] - offset[1], centre[2] - offset[2]}};
}

PixelPoint project(const Camera& camera, const Vector3& camera_point) {
  return {camera.fx * camera_point[0] / camera_point[2] + camera.cx,
          camera.fy * camera_point[1] / camera_point[2] + camera.cy};
}

std::array<PixelPoint, 4> project_marker(const Camera& camera, const Pose& pose, double side_m) {
  const std::array<Vector3, 4> corners{
      {{0, 0, 0}, {side_m, 0, 0}, {side_m, side_m, 0}, {0, side_m, 0}}};
  std::array<PixelPoint, 4> projected;
  for (int i = 0; i < 4; ++i) {
    const Vector3 point = transform(pose, corners[i]);
    if (!(point[2] > 0)) {
      throw vp::InputError("marker corner " + std::to_string(i) +
                           " lies at Z = " + std::to_string(point[2]) +
                           " m, behind the camera: move the marker to Z > 0");
    }
    projected[i] = project(camera, point);
  }
  return projected;
}

double rotation_error_deg(const Pose& a, const Pose& b) {
  const Matrix3 between = multiply(transpose(a.rotation), b.rotation);
  // Sine and cosine of the angle together: acos alone loses half the digits near zero.
  const double x = between[2][1] - between[1][2];
  const double y = between[0][2] - between[2][0];
  const double z = between[1][0] - between[0][1];
  const double twice_sine = std::sqrt(x * x + y * y + z * z);
  const double twice_cosine = between[0][0] + between[1][1] + between[2][2] - 1;
  return std::atan2(twice_sine, twice_cosine) * 180.0 / pi;
}

double translation_error_mm(const Pose& a, const Pose& b) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double difference = a.translation[i] - b.translation[i];
    sum += difference * difference;
  }
  return std::sqrt(sum) * 1000.0;
}

void validate(const Pose& pose) {
  for (double coordinate : pose.translation) {
    if (!std::isfinite(coordinate)) {
      throw vp::InputError("pose translation is not a number: give three finite values in m");
    }
  }
  const Matrix3 product = multiply(pose.rotation, transpose(pose.rotation));
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const double expected = row == column ? 1.0 : 0.0;
      if (!(std::abs(product[row][column] - expected) <= rotation_tolerance)) {
        throw vp::InputError("pose rotation is not orthonormal: give a 3x3 rotation matrix");
      }
    }
  }
  if (determinant(pose.rotation) < 0) {
    throw vp::InputError("pose rotation mirrors (determinant -1): give a 3x3 rotation matrix");
  }
}

}  // namespace platform
