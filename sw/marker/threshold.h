#pragma once

#include <marker/images.h>

#include <array>
#include <cstdint>

namespace marker {

/// The adaptive threshold on the PS (thesis 4.3.5, A.3.1.2), with the rules of the PL: the peaks of
/// one frame's histogram give the threshold of the next.
class AdaptiveThreshold {
 public:
  static constexpr std::uint8_t first = 127;  ///< before the first frame

  /// As after a system reset.
  void reset() { threshold_ = first; }

  /// The threshold that the next frame is made binary with.
  std::uint8_t value() const { return threshold_; }

  /// Writes `image` (a multiple of 32 px wide) to `words`: bit i of word w is pixel 32w + i, 1
  /// where it is not above the threshold. Then takes over the next one.
  void binarise(const GreyImage& image, std::uint32_t* words);

 private:
  std::uint8_t peak(const GreyImage& image, std::uint32_t first_level,
                    std::uint8_t otherwise) const;

  std::uint8_t threshold_ = first;
  std::array<std::uint32_t, 256> histogram_{};
};

}  // namespace marker
