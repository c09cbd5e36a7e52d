#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <pl/common/geometry.h>

namespace pl {

/// Intensity histogram of the running frame and the threshold it gives for the next one
/// (thesis 4.3.5).
///
/// One peak in each half, replaced only by a strictly greater count; next threshold = (P1 + P2)
/// / 2. Equation 4.5 prints a minus; figure C.7's 79 and 178 give 128 (decision).
class ThresholdCore {
 public:
  /// Threshold after a system reset (thesis 4.3.5).
  static constexpr std::uint8_t default_threshold = 127;

  /// Takes a pixel of the running frame. True (dark) if it is not above the threshold
  /// (equation 4.4).
  bool push(std::uint8_t pixel) {
    count(pixel);
    return pixel <= threshold_;
  }

  /// Loads the next threshold from the peaks and starts a new histogram.
  void end_frame() {
    threshold_ = next_threshold();
    clear_histogram();
  }
  /// Forgets the running frame's histogram; the threshold stays.
  void clear_histogram() {
    histogram_.fill(0);
    dark_count_ = bright_count_ = 0;
    dark_peak_ = 0;
    bright_peak_ = 255;
  }

  /// That of the running frame's pixels so far.
  std::uint8_t next_threshold() const {
    return static_cast<std::uint8_t>((dark_peak_ + bright_peak_) / 2);
  }
  std::uint8_t threshold() const { return threshold_; }
  void set_threshold(std::uint8_t threshold) { threshold_ = threshold; }
  std::uint8_t dark_peak() const { return dark_peak_; }
  std::uint8_t bright_peak() const { return bright_peak_; }
  std::uint32_t histogram(std::uint8_t level) const { return histogram_[level]; }

 private:
  void count(std::uint8_t pixel) {
    const std::uint32_t n = ++histogram_[pixel];
    if (pixel < 128) {
      if (n > dark_count_) dark_count_ = n, dark_peak_ = pixel;
    } else if (n > bright_count_) {
      bright_count_ = n, bright_peak_ = pixel;
    }
  }

  std::array<std::uint32_t, 256> histogram_{};
  std::uint32_t dark_count_ = 0, bright_count_ = 0;
  std::uint8_t dark_peak_ = 0, bright_peak_ = 255;
  std::uint8_t threshold_ = default_threshold;
};

/// A threshold that is searched after a frame, while no pixels are counted.
class ThresholdSearch {
 public:
  /// What a frame gives is there on edge `due`, if it gives anything. What was not found until now
  /// never is.
  void start(std::uint64_t due, std::optional<std::uint8_t> found);
  void stop() { due_ = never; }
  /// Where no frame runs: the threshold that is loaded on this edge, once.
  std::optional<std::uint8_t> take(std::uint64_t cycle);
  /// The edge that loads it.
  std::uint64_t due() const { return due_; }

 private:
  static constexpr std::uint64_t never = ~std::uint64_t{0};
  std::uint64_t due_ = never;
  std::uint8_t found_ = 0;
};

/// From the edge behind a frame's last pixel to the one that may load the threshold between its
/// peaks, where several pixels come on a clock: the levels one by one, and the pipeline.
constexpr std::uint64_t peak_search_clocks = 256 + 7;

/// Pixels of each grey level.
using Histogram = std::array<std::uint32_t, 256>;
Histogram count_levels(const std::uint8_t* pixels, std::size_t count);

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
  /// The frame is over: the threshold that its pixels so far give.
  std::uint8_t next_threshold() const;
  /// Takes it over, and returns it.
  std::uint8_t end();

  /// The frame is over: of its pixels so far.
  Histogram histogram() const;

  /// The frame's words, row by row; bit i of word w is pixel 32w + i. Bits of pixels that were not
  /// binarised are 0.
  const std::vector<std::uint32_t>& words() const { return words_; }
  std::uint32_t pixels() const { return position_; }

  /// For the pixels from now on.
  void set_threshold(std::uint8_t threshold) { threshold_ = threshold; }
  std::uint8_t threshold() const { return threshold_; }

 private:
  void advance_by_pixel(std::uint32_t to);

  const std::uint8_t* image_ = nullptr;
  std::vector<std::uint32_t> words_;
  std::uint32_t position_ = 0;
  std::uint8_t threshold_ = ThresholdCore::default_threshold;
};

/// Packs 32 pixels a word, the first in bit 0: 1 if a pixel is not above `threshold`. Reads and
/// writes nothing beyond the `words` words.
void pack_dark(const std::uint8_t* pixels, std::size_t words, std::uint8_t threshold,
               std::uint32_t* binary);

}  // namespace pl
