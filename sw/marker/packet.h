#pragma once

#include <cstdint>

namespace marker {

/// Where the tip of a corner points: the region of the circle with the most bright pixels. The
/// codes of the packet.
enum class Direction : std::uint8_t { north = 0, south = 1, east = 2, west = 3 };

/// A corner as the PL found it.
struct Corner {
  std::uint16_t x;         ///< pixel column, 0 … 1023
  std::uint16_t y;         ///< pixel row, 0 … 511
  std::uint16_t strength;  ///< the core's strength shifted right by 2, 0 … 1023
  Direction direction;
  std::uint8_t assigned;  ///< 1: belongs to a candidate (set by the feature evaluation)
};

/// A blob's bounding box, both corners inside.
struct BoundingBox {
  std::uint16_t sx, sy;  ///< first column and row
  std::uint16_t ex, ey;  ///< last column and row
  std::uint16_t number;  ///< the PL's count of blobs in this frame, modulo 2048
};

/// The feature packets of the PL (thesis figure 4.17 and table 4.4, whose shifts go right, not
/// left).
namespace packet {

/// All ones. Cannot be a corner: its x would be 1023.
inline constexpr std::uint32_t end_of_frame = 0xFFFF'FFFFu;

inline constexpr std::uint32_t corner_flag = 1u << 31;
inline constexpr std::uint32_t start_flag = 1u << 30;
inline constexpr std::uint32_t x_mask = 0x3FF;
inline constexpr std::uint32_t y_mask = 0x1FF;
inline constexpr std::uint32_t direction_mask = 0x3;
inline constexpr std::uint32_t strength_mask = 0x3FF;
inline constexpr std::uint32_t number_mask = 0x7FF;
inline constexpr unsigned y_shift = 10;
inline constexpr unsigned direction_shift = 19;
inline constexpr unsigned strength_shift = 21;
inline constexpr unsigned number_shift = 19;

enum class Kind : std::uint8_t { corner, blob_start, blob_end, end };

constexpr Kind kind(std::uint32_t word) {
  if (word == end_of_frame) return Kind::end;
  if (word & corner_flag) return Kind::corner;
  return (word & start_flag) ? Kind::blob_start : Kind::blob_end;
}

constexpr std::uint16_t x(std::uint32_t word) {
  return static_cast<std::uint16_t>(word & x_mask);
}

constexpr std::uint16_t y(std::uint32_t word) {
  return static_cast<std::uint16_t>((word >> y_shift) & y_mask);
}

/// The number of a blob packet.
constexpr std::uint16_t number(std::uint32_t word) {
  return static_cast<std::uint16_t>((word >> number_shift) & number_mask);
}

/// The corner of a corner packet, not assigned.
constexpr Corner corner(std::uint32_t word) {
  return {x(word), y(word), static_cast<std::uint16_t>((word >> strength_shift) & strength_mask),
          static_cast<Direction>((word >> direction_shift) & direction_mask), 0};
}

/// Encoders, for tests and for programs that find the features themselves. Fields are cut to their
/// width.
constexpr std::uint32_t encode(const Corner& corner) {
  return corner_flag | (corner.strength & strength_mask) << strength_shift |
         static_cast<std::uint32_t>(corner.direction) << direction_shift |
         (corner.y & y_mask) << y_shift | (corner.x & x_mask);
}

constexpr std::uint32_t encode_start(const BoundingBox& box) {
  return start_flag | (box.number & number_mask) << number_shift | (box.sy & y_mask) << y_shift |
         (box.sx & x_mask);
}

constexpr std::uint32_t encode_end(const BoundingBox& box) {
  return (box.number & number_mask) << number_shift | (box.ey & y_mask) << y_shift |
         (box.ex & x_mask);
}

}  // namespace packet
}  // namespace marker
