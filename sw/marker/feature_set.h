#pragma once

#include <array>
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

/// Room for what one frame can bring: photographs give up to 4900 corners; blob numbers wrap at
/// 2048.
inline constexpr std::uint32_t max_corners = 8192;
inline constexpr std::uint32_t max_blobs = 2048;
/// Feature words of a frame, the end word included.
inline constexpr std::uint32_t max_words = max_corners + 2 * max_blobs + 1;

/// The words of one frame as they arrived.
struct WordStore {
  std::uint32_t count;  ///< words received, those without room included
  std::array<std::uint32_t, max_words> words;

  void clear() { count = 0; }

  /// Stores the word if there is room, counts it in any case.
  void push(std::uint32_t word) {
    if (count < max_words) words[count] = word;
    ++count;
  }
  std::uint32_t stored() const { return count < max_words ? count : max_words; }
  std::uint32_t lost() const { return count - stored(); }
};

/// The features of one frame: corners in the order of arrival, boxes in the order of their end
/// words.
struct FeatureSet {
  std::uint32_t corner_count;  ///< corners stored
  std::uint32_t blob_count;    ///< boxes stored
  std::uint32_t lost_corners;  ///< corners for which there was no room
  std::uint32_t lost_blobs;    ///< boxes for which there was no room
  std::uint32_t malformed;     ///< blob words without partner, or whose end lies before the start
  std::array<Corner, max_corners> corners;
  std::array<BoundingBox, max_blobs> blobs;

  void clear() { corner_count = blob_count = lost_corners = lost_blobs = malformed = 0; }
  void push(const Corner& corner);
  void push(const BoundingBox& box);
};

/// Decodes `count` words up to the end word into `features` (thesis 4.5.2). A blob's start and end
/// words are paired by their number; corners may come between them. `format`: of frames of this
/// size.
void decode(const std::uint32_t* words, std::uint32_t count, const packet::WordFormat& format,
            FeatureSet& features);

}  // namespace marker
