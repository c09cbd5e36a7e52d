#pragma once

#include <array>
#include <cstdint>

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
    threshold_ = static_cast<std::uint8_t>((dark_peak_ + bright_peak_) / 2);
    clear_histogram();
  }
  /// Forgets the running frame's histogram; the threshold stays.
  void clear_histogram() {
    histogram_.fill(0);
    dark_count_ = bright_count_ = 0;
    dark_peak_ = 0;
    bright_peak_ = 255;
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

}  // namespace pl
