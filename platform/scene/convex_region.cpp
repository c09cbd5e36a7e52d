#include <scene/convex_region.h>

#include <algorithm>
#include <cmath>

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

}  // namespace platform
