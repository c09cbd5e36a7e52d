#pragma once

#include <marker/packet.h>

#include <array>
#include <cstdint>

namespace marker {

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
