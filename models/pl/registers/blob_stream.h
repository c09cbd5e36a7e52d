#pragma once

#include <cstdint>

/// What the logic of the design `improved` and its software agree on: the packet with the blobs of
/// a frame that pl.blob_stream sends through a DMA. Control packet, addresses and interrupts are
/// those of marker_logic.h; of the control packet `ready` and `wr_en` mean nothing here.
///
/// A packet is
///
///     blob 0      8 words, one extreme point each
///     blob 1      …
///     trailer     4 words; TLAST comes with the last
///
/// The trailer comes last because the number of blobs is known at the frame's end only; the DMA
/// says in S2MM_LENGTH how long the packet is.
namespace blob_stream {

inline constexpr std::uint32_t bytes_per_word = 4;

/// The words of a blob, clockwise around it. Among pixels equally far out the first in raster order
/// (row by row, left to right) is the extreme.
enum Extreme : std::uint32_t {
  least_y,
  greatest_x_minus_y,
  greatest_x,
  greatest_x_plus_y,
  greatest_y,
  least_x_minus_y,
  least_x,
  least_x_plus_y,
};
inline constexpr std::uint32_t words_per_blob = 8;

/// The words of the trailer.
enum Trailer : std::uint32_t {
  frame_number,  ///< of the camera: counts triggers since the system reset, the first is 0
  blobs_sent,
  /// Blobs that were dropped (FIFO full, more than max_blobs), and dark pixels without a label. Not
  /// 0: markers may be missing.
  lost,
  /// Bits 7 to 0: the threshold with which the frame was made binary. With a checksum also Checked
  /// and, in bits 31 to 16, the checksum; 0 otherwise.
  threshold,
};
inline constexpr std::uint32_t trailer_words = 4;

/// The bits of the trailer's last word.
inline constexpr std::uint32_t threshold_mask = 0xFF;
inline constexpr std::uint32_t Checked = 1u << 8;  ///< the packet has a checksum
inline constexpr std::uint32_t checksum_shift = 16;

/// Takes a word of a packet into its sum, which begins at 0: any bit that is wrong changes it, and
/// so do words that change places, for it turns by a bit with each.
constexpr std::uint32_t add_to_sum(std::uint32_t sum, std::uint32_t word) {
  return (sum << 1 | sum >> 31) ^ word;
}
/// The trailer's last word with the checksum: of `sum` over all words before, and of its own bits.
constexpr std::uint32_t checked_word(std::uint32_t sum, std::uint32_t threshold) {
  const std::uint32_t all = add_to_sum(sum, threshold | Checked);
  return ((all ^ all >> 16) & 0xFFFF) << checksum_shift | threshold | Checked;
}

/// More blobs of a frame are dropped and counted as lost: the longest packet has a bound, what a
/// LENGTH of 18 bits counts.
inline constexpr std::uint32_t max_blobs = 8191;

constexpr std::uint32_t packet_words(std::uint32_t blobs) {
  return blobs * words_per_blob + trailer_words;
}
/// What a buffer needs that holds every packet; S2MM_LENGTH has the bits for it.
inline constexpr std::uint32_t max_packet_bytes = packet_words(max_blobs) * bytes_per_word;

/// An extreme: the pixel's index in x and y, less than 65 536 each.
constexpr std::uint32_t point(std::uint32_t x, std::uint32_t y) {
  return y << 16 | x;
}
constexpr std::uint32_t x(std::uint32_t point) {
  return point & 0xFFFF;
}
constexpr std::uint32_t y(std::uint32_t point) {
  return point >> 16;
}

/// The blobs in a packet of so many bytes; `no_packet` if none has that length.
inline constexpr std::uint32_t no_packet = ~0u;
constexpr std::uint32_t blobs_in(std::uint32_t bytes) {
  constexpr std::uint32_t blob = words_per_blob * bytes_per_word;
  constexpr std::uint32_t trailer = trailer_words * bytes_per_word;
  const bool whole = bytes >= trailer && (bytes - trailer) % blob == 0;
  return whole && bytes <= max_packet_bytes ? (bytes - trailer) / blob : no_packet;
}

}  // namespace blob_stream
