#pragma once

#include <marker/geometry.h>
#include <marker/images.h>

#include <array>
#include <cstdint>

namespace marker {

/// A marker is 6 × 6 cells: 4 × 4 of code inside a black border.
inline constexpr std::uint32_t cells_per_side = 6;

/// Canonical widths: a cell is at least 3 px, of which the outer ring is left out.
inline constexpr std::uint32_t min_canonical_width = 3 * cells_per_side;
inline constexpr std::uint32_t max_canonical_width = 600;

/// The nearest canonical width that is whole cells.
std::uint32_t canonical_width(double wanted);

/// Canonical plane to image plane (equation 3.3).
struct Homography {
  double h1, h2, u1, h4, h5, v1, h7, h8;
  bool valid;  ///< false: the four corners do not span a plane
};

/// Appendix D: maps the square (0, 0) … (width, width) onto four image points in the order top
/// left, top right, bottom left, bottom right (the order for which D.1 to D.6 are correct as
/// printed). Pixel indices in, pixel indices out.
Homography make_homography(const Quad& corners, double width);

/// Equation 3.3. False if the canonical point has no image in front of the camera.
bool transform(const Homography& homography, Point canonical, Point& image);

/// How many samples of each cell are dark.
struct CellCounts {
  std::uint32_t samples_per_cell;
  std::array<std::array<std::uint32_t, cells_per_side>, cells_per_side> dark;  ///< [row][column]
};

/// Thesis 3.5.2: samples the canonical image of `width` px (a multiple of 6) cell by cell, without
/// the outer ring of each cell. Canonical pixel (i, j) is sampled at (i + 0.5, j + 0.5) and read at
/// the nearest image pixel; what lies outside the image is white.
void rectify(const BinaryImage& image, const Homography& homography, std::uint32_t width,
             CellCounts& cells);

}  // namespace marker
