#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <pl/common/geometry.h>
#include <pl/global_threshold/core.h>

namespace pl {

/// The two peaks of a histogram as ThresholdCore has them after the last pixel.
struct Peaks {
  std::uint8_t dark = 0;      ///< 0 to 127; 0 if no pixel is below 128
  std::uint8_t bright = 255;  ///< 128 to 255; 255 if no pixel is above 127

  std::uint8_t threshold() const { return static_cast<std::uint8_t>((dark + bright) / 2); }
};

/// Peaks of `count` pixels in the order in which they come: of several levels with the greatest
/// count, the one that reached it first.
Peaks find_peaks(const std::uint8_t* pixels, std::size_t count);

/// Global Threshold over a whole frame: the words of GlobalThresholdClocked, and the next
/// threshold.
///
/// Works in pieces of any length, so that software may load a threshold between two pixels.
class ThresholdFrame {
 public:
  explicit ThresholdFrame(const Geometry& geometry);

  /// The clock at which the word with the pixel of this raster index as its last one leaves.
  static std::uint64_t clock(std::uint32_t last_pixel) { return std::uint64_t{3} + last_pixel; }

  /// A new frame; the threshold stays. `image` holds width x height pixels, and stays valid until
  /// end().
  void begin(const std::uint8_t* image);
  /// Binarises up to the pixel of raster index `pixels` - 1 with the present threshold.
  void advance(std::uint32_t pixels);
  /// Pixels from this raster index on count as not binarised; the threshold stays as it is now.
  void rewind(std::uint32_t pixel);
  /// Of `count` pixels that were binarised, from `first` on, the values changed: they are binarised
  /// again with the present threshold.
  void refresh(std::uint32_t first, std::uint32_t count);
  /// The frame is over: takes over the threshold that its pixels so far give, and returns it.
  std::uint8_t end();

  /// The frame's words, row by row; bit i of word w is pixel 32w + i. Bits of pixels that were not
  /// binarised are 0.
  const std::vector<std::uint32_t>& words() const { return words_; }
  std::uint32_t pixels() const { return position_; }

  /// For the pixels from now on. What `wr_thresh` loads at clock c counts from the pixel of raster
  /// index c - 2 on.
  void set_threshold(std::uint8_t threshold) { threshold_ = threshold; }
  std::uint8_t threshold() const { return threshold_; }

 private:
  void advance_by_pixel(std::uint32_t to);

  const std::uint8_t* image_ = nullptr;
  std::vector<std::uint32_t> words_;
  std::uint32_t position_ = 0;
  std::uint8_t threshold_ = ThresholdCore::default_threshold;
};

}  // namespace pl
