#pragma once

#include <array>

namespace marker {

/// A point in the image. Says in each use whether it is a pixel index or a coordinate (index + 0.5
/// at the centre).
struct Point {
  double x, y;
};

constexpr Point operator+(Point a, Point b) {
  return {a.x + b.x, a.y + b.y};
}
constexpr Point operator-(Point a, Point b) {
  return {a.x - b.x, a.y - b.y};
}
constexpr Point operator*(double s, Point a) {
  return {s * a.x, s * a.y};
}
constexpr double dot(Point a, Point b) {
  return a.x * b.x + a.y * b.y;
}

/// Four corners; each use states their order.
using Quad = std::array<Point, 4>;

/// Twice the signed area of the triangle a, b, c; positive when they turn clockwise on the screen
/// (y down).
constexpr double cross(Point a, Point b, Point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// True if the four corners, clockwise on the screen, are distinct and make a strictly convex
/// quadrilateral.
constexpr bool is_convex_clockwise(const Quad& q) {
  for (unsigned i = 0; i < 4; ++i) {
    if (!(cross(q[i], q[(i + 1) % 4], q[(i + 2) % 4]) > 0)) return false;
  }
  return true;
}

}  // namespace marker
