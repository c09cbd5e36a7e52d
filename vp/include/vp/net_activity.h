#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vp {

/// How long each bit of a net has which value, and how often it turns: what power tools want to
/// know of a simulation. Times are steps of any length that never fall.
class NetActivity {
 public:
  /// In steps; SAIF calls them T0, T1, TX, TZ and TC.
  struct Bit {
    std::uint64_t low = 0, high = 0, unknown = 0, floating = 0;
    std::uint64_t toggles = 0;  ///< from 0 to 1 and from 1 to 0
  };

  /// All bits are x.
  explicit NetActivity(unsigned width);

  /// `digits` as a trace writes them; with more than there are bits, or another word, the net is x.
  void change(std::string_view digits, std::uint64_t now);
  /// Forgets what was counted; the values stay.
  void restart(std::uint64_t now);
  /// Counts up to `now`.
  void settle(std::uint64_t now);

  /// The leftmost first. Up to date after settle().
  const std::vector<Bit>& bits() const { return bits_; }
  /// Of all bits.
  std::uint64_t toggles() const;

 private:
  void settle(std::size_t bit, std::uint64_t now);

  std::string digits_;
  std::vector<Bit> bits_;
  std::vector<std::uint64_t> since_;  ///< when the bit was counted last
};

}  // namespace vp
