#pragma once

#include <pl/corner_detection/core.h>

#include <cstdint>

namespace appendix_c {

/// One point of interest serves the examples C.2 to C.5: its circle is bright at 0 to 7 and 15, the
/// thesis' 33023 = 0x80FF, which is contiguous and lies mostly in the east; the levels give the
/// strength 1372 of C.5.
constexpr std::uint8_t point_level = 40;
constexpr std::uint8_t background_level = 60;
constexpr std::uint32_t corner_threshold = 30;

inline pl::fast::Circle worked_circle() {
  pl::fast::Circle circle;
  circle.fill(background_level);
  // 40 + 30 = 70: four differences of 153 and five of 152 make 1372.
  for (const unsigned n : {0u, 1u, 2u, 3u}) circle[n] = 223;
  for (const unsigned n : {4u, 5u, 6u, 7u, 15u}) circle[n] = 222;
  return circle;
}

}  // namespace appendix_c
