#pragma once

#include <array>
#include <cstdint>

#include <marker/geometry.h>
#include <marker/images.h>

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

/// A 4 × 4 code: bit 15 is the top left cell, then row by row; 1 = black (the thesis' convention;
/// OpenCV's is the inverse).
using Code = std::uint16_t;

inline constexpr std::uint32_t dictionary_size = 250;

/// The upright codes of ArUco's DICT_4X4_250 by ID.
extern const std::array<Code, dictionary_size> dictionary;

/// The code turned by a quarter clockwise (thesis table 3.2).
constexpr Code rotate_clockwise(Code code) {
  Code turned = 0;
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      const unsigned from = (3 - column) * 4 + row;
      turned = static_cast<Code>(turned << 1 | ((code >> (15 - from)) & 1u));
    }
  }
  return turned;
}

/// In how many cells two codes differ (thesis table 3.3).
constexpr unsigned hamming_distance(Code a, Code b) {
  unsigned distance = 0;
  for (unsigned difference = static_cast<unsigned>(a ^ b); difference != 0;
       difference &= difference - 1) {
    ++distance;
  }
  return distance;
}

/// What a rectified candidate turned out to be.
struct Identification {
  bool found;
  std::uint16_t id;       ///< 0 … 249
  std::uint8_t rotation;  ///< quarter turns clockwise from upright, 0 … 3
  bool border;            ///< all 20 border cells are black
  Code code;              ///< as read, not turned; 0 unless `border`
};

/// Thesis 3.5.3: a cell is black if more than half of its samples are dark. The border must be
/// black all round, and the inner code in one of its four rotations must equal a word of the
/// dictionary.
Identification identify(const CellCounts& cells);

}  // namespace marker
