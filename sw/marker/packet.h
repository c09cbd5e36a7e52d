#pragma once

#include <cstdint>

#include <marker_logic.h>

namespace marker {

/// Where the tip of a corner points: the region of the circle with the most bright pixels. The
/// codes of the packet.
enum class Direction : std::uint8_t { north = 0, south = 1, east = 2, west = 3 };

/// A corner as the PL found it.
struct Corner {
  std::uint16_t x;         ///< pixel column
  std::uint16_t y;         ///< pixel row
  std::uint16_t strength;  ///< the core's strength shifted right by 2, 0 … 1023
  Direction direction;
  std::uint8_t assigned;  ///< 1: belongs to a candidate (set by the feature evaluation)
};

/// A blob's bounding box, both corners inside.
struct BoundingBox {
  std::uint16_t sx, sy;  ///< first column and row
  std::uint16_t ex, ey;  ///< last column and row
  std::uint16_t number;  ///< the PL's count of blobs in this frame, modulo what its word holds
};

/// Features as words: what the PL sends, and what tests and programs send that find the features
/// themselves.
namespace packet {

using marker_logic::WordFormat;

/// Of frames up to 1024 × 512.
inline constexpr WordFormat usual_format{0, 0};

/// The corner of a corner word, not assigned.
constexpr Corner corner(std::uint32_t word, const WordFormat& format = usual_format) {
  return {static_cast<std::uint16_t>(format.x(word)), static_cast<std::uint16_t>(format.y(word)),
          static_cast<std::uint16_t>(format.strength(word)),
          static_cast<Direction>(format.direction(word)), 0};
}

// Fields are cut to their width.
constexpr std::uint32_t encode(const Corner& corner, const WordFormat& format = usual_format) {
  return format.corner(std::uint32_t{corner.strength} << 2,
                       static_cast<std::uint32_t>(corner.direction), corner.x, corner.y);
}
constexpr std::uint32_t encode_start(const BoundingBox& box,
                                     const WordFormat& format = usual_format) {
  return format.blob_start(box.number, box.sx, box.sy);
}
constexpr std::uint32_t encode_end(const BoundingBox& box,
                                   const WordFormat& format = usual_format) {
  return format.blob_end(box.number, box.ex, box.ey);
}

}  // namespace packet
}  // namespace marker
