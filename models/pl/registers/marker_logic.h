#pragma once

#include <cstdint>

#include <gic_registers.h>

/// What the marker detector's logic and its software agree on, written once: the models, the PS
/// programs and the words of traces include it.
namespace marker_logic {

// ---- Images ------------------------------------------------------------------------------------

/// Pixels in a word of the binary image; bit i of word w is pixel 32w + i, 1 is dark (decision).
inline constexpr std::uint32_t pixels_per_word = 32;
/// Words of a DMA burst, images in and binary images out (thesis 4.4.2 and 4.5.1.1). The logic is
/// built for a power of two between these, which is what the AXI DMA takes.
inline constexpr std::uint32_t usual_burst_words = 32;
inline constexpr std::uint32_t min_burst_words = 2, max_burst_words = 256;
inline constexpr std::uint32_t bytes_per_word = 4;

constexpr bool is_legal_burst(std::uint32_t words) {
  return min_burst_words <= words && words <= max_burst_words && (words & (words - 1)) == 0;
}

/// Sizes of frames in pixels. Up to 1024 × 512 the words of features are the thesis'.
inline constexpr std::uint32_t min_width = 32, max_width = 2048;
inline constexpr std::uint32_t min_height = 16, max_height = 2048;

/// A binary image is whole words a line, and whole bursts of so many words.
constexpr bool is_legal_size(std::uint32_t width, std::uint32_t height, std::uint32_t burst_words) {
  return min_width <= width && width <= max_width && min_height <= height && height <= max_height &&
         width % pixels_per_word == 0 && width * height % (pixels_per_word * burst_words) == 0;
}

/// Bits that tell `count` things apart, at least `least`.
constexpr unsigned bits_for(std::uint32_t count, unsigned least) {
  while ((std::uint64_t{1} << least) < count) ++least;
  return least;
}

// ---- Feature words -----------------------------------------------------------------------------

/// How a feature is packed into the 32 bits that AXI GPIO 1 shows (thesis 4.4.3, figures 4.20 and
/// 4.21, table 4.4, whose shifts go right, not left), from bit 31 down:
///
///     corner      1 | strength 10 | direction 2 | y 9 | x 10
///     blob start  0 | 1 | number 11             | y 9 | x 10
///     blob end    0 | 0 | number 11             | y 9 | x 10
///
/// Larger frames need wider coordinates. They take their bits from strength and number (decision):
/// a feature stays one word and costs one poll, and neither is missed. The strength only weighs
/// corners of one marker against each other, and a blob's two words follow each other.
class WordFormat {
 public:
  enum class Kind : std::uint8_t { corner, blob_start, blob_end, end };

  /// No corner looks like it: x and y never reach all ones together.
  static constexpr std::uint32_t end_of_frame = 0xFFFF'FFFFu;

  constexpr WordFormat(std::uint32_t width, std::uint32_t height)
      : x_bits_(bits_for(width, 10)), y_bits_(bits_for(height, 9)) {}

  constexpr unsigned x_bits() const { return x_bits_; }
  constexpr unsigned y_bits() const { return y_bits_; }
  constexpr unsigned direction_shift() const { return x_bits_ + y_bits_; }
  constexpr unsigned number_shift() const { return x_bits_ + y_bits_; }
  constexpr unsigned number_bits() const { return 30 - number_shift(); }
  constexpr unsigned strength_shift() const { return direction_shift() + 2; }
  constexpr unsigned strength_bits() const { return 31 - strength_shift(); }

  /// `strength` 12 bits; the upper ones are sent; `direction` N 0, S 1, E 2, W 3.
  constexpr std::uint32_t corner(std::uint32_t strength, std::uint32_t direction, std::uint32_t x,
                                 std::uint32_t y) const {
    return corner_flag |
           cut(strength >> (12 - strength_bits()), strength_bits()) << strength_shift() |
           cut(direction, 2) << direction_shift() | place(x, y);
  }
  /// `number` counts the frame's blobs, modulo what its bits hold.
  constexpr std::uint32_t blob_start(std::uint32_t number, std::uint32_t x, std::uint32_t y) const {
    return start_flag | blob_end(number, x, y);
  }
  constexpr std::uint32_t blob_end(std::uint32_t number, std::uint32_t x, std::uint32_t y) const {
    return cut(number, number_bits()) << number_shift() | place(x, y);
  }

  static constexpr Kind kind(std::uint32_t word) {
    if (word == end_of_frame) return Kind::end;
    if ((word & corner_flag) != 0) return Kind::corner;
    return (word & start_flag) != 0 ? Kind::blob_start : Kind::blob_end;
  }
  constexpr std::uint32_t x(std::uint32_t word) const { return cut(word, x_bits_); }
  constexpr std::uint32_t y(std::uint32_t word) const { return cut(word >> x_bits_, y_bits_); }
  constexpr std::uint32_t number(std::uint32_t word) const {
    return cut(word >> number_shift(), number_bits());
  }
  constexpr std::uint32_t direction(std::uint32_t word) const {
    return cut(word >> direction_shift(), 2);
  }
  /// The upper 10 of the strength's 12 bits, in larger frames with zeros at the end.
  constexpr std::uint32_t strength(std::uint32_t word) const {
    return cut(word >> strength_shift(), strength_bits()) << (10 - strength_bits());
  }

 private:
  static constexpr std::uint32_t corner_flag = 1u << 31, start_flag = 1u << 30;

  static constexpr std::uint32_t cut(std::uint32_t value, unsigned bits) {
    return value & ((1u << bits) - 1);
  }
  constexpr std::uint32_t place(std::uint32_t x, std::uint32_t y) const {
    return cut(y, y_bits_) << x_bits_ | cut(x, x_bits_);
  }

  unsigned x_bits_, y_bits_;
};

// ---- The control packet in AXI GPIO 0 ----------------------------------------------------------

/// Its bits (decision: thesis figure 4.19 is not in its text).
namespace control {

inline constexpr std::uint32_t ena = 1u << 0;  ///< rising: a frame starts
inline constexpr std::uint32_t rst = 1u << 1;  ///< clears the pipeline, not the threshold
inline constexpr unsigned ready_shift = 2;     ///< two bits, toggling
inline constexpr std::uint32_t ready = 3u << ready_shift;  ///< a change asks for the next word
inline constexpr std::uint32_t wr_en = 1u << 4;      ///< the image store takes words from DMA 0
inline constexpr std::uint32_t wr_thresh = 1u << 5;  ///< loads the threshold below
inline constexpr unsigned threshold_shift = 8;       ///< 8 bits

}  // namespace control

// ---- Where the devices are ---------------------------------------------------------------------

/// Unless configured otherwise: Vivado's defaults for these IP. Software takes them from
/// xparameters.h.
namespace addresses {

inline constexpr std::uint32_t gpio_control = 0x4120'0000;  ///< AXI GPIO 0: control packet, outputs
inline constexpr std::uint32_t gpio_features = 0x4121'0000;  ///< AXI GPIO 1: feature words, inputs
inline constexpr std::uint32_t dma_image = 0x4040'0000;      ///< AXI DMA 0: MM2S, images to the PL
inline constexpr std::uint32_t dma_binary = 0x4041'0000;  ///< AXI DMA 1: S2MM, binary images to DDR
inline constexpr std::uint32_t dma_image_interrupt = gic::irq_f2p_id(0);
inline constexpr std::uint32_t dma_binary_interrupt = gic::irq_f2p_id(1);

}  // namespace addresses

}  // namespace marker_logic
