#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include <pl/common/rtl_object.h>

namespace pl {

/// How often the signals inside RTL change: the bits of its state that differ from one edge to the
/// next. A copy of the state is taken at edges drawn at random, always the same ones, less often
/// the larger it is; each counts for all edges since the one before. RTL that sleeps changes
/// nothing.
class RtlActivity {
 public:
  /// Changes a bit and clock at which a clock counts as busy: the vendor's default.
  static constexpr double usual_rate = 0.125;

  explicit RtlActivity(const RtlObject& rtl);

  /// Bits of its signals; 0: they cannot be counted, since not all of its state is known.
  std::uint64_t bits() const { return bits_; }
  /// Nothing is counted before.
  void begin();
  /// Behind each edge, when the RTL has settled.
  void edge() {
    if (left_ == 0) return;
    ++edges_;
    if (--left_ <= 1) look();
  }

  /// The same, for estimates. This must outlive them.
  vp::IpEstimate::Foreign::Toggles toggles();
  /// Of all bits, since the beginning.
  double changes() const { return changes_; }
  /// Clocks since then, each by its changes: 1 from the usual rate on.
  double busy_clocks() const { return busy_clocks_; }

 private:
  void look();
  void plan();
  std::uint64_t changed_bits() const;

  const RtlObject& rtl_;
  std::uint64_t bits_ = 0;
  /// The state without pins, whose power is that of what drives them; whole words of it.
  std::vector<std::uint64_t> counted_;
  std::vector<unsigned char> before_;
  std::uint64_t left_ = 0;   ///< edges until the next comparison; 0: nothing is counted
  std::uint64_t edges_ = 0;  ///< since the last one
  std::uint32_t random_ = 0x9E37'79B9;
  double changes_ = 0, busy_clocks_ = 0;
};

}  // namespace pl
