#pragma once

#include <cstdint>

#include <pl/clock_crossing/crossing_register.h>
#include <vp/clock.h>
#include <vp/ip.h>

namespace pl {

/// The pixel side of all three crossings: corner, blob and binary words, and the count of those
/// that were lost.
///
/// At coincident edges the system side samples first, so a word that is sampled and replaced at the
/// same edge was seen.
class ClockCrossing : public vp::Clocked, public vp::Ip {
 public:
  ClockCrossing(sc_core::sc_module_name name, vp::Clock& pixel_clk, const vp::Clock& system_clk);

  vp::In<bool> rst{"rst", this};
  vp::In<bool> corner_out{"corner_out", this};
  vp::In<std::uint32_t> corner_data{"corner_data", this};
  vp::In<bool> blob_out{"blob_out", this};
  vp::In<std::uint32_t> blob_start{"blob_start", this};
  vp::In<std::uint32_t> blob_end{"blob_end", this};
  vp::In<bool> thresh_out{"thresh_out", this};
  vp::In<std::uint32_t> thresh_data{"thresh_data", this};

  CrossingRegister corner{"corner"};
  CrossingRegister blob{"blob"};
  CrossingRegister binary{"binary"};
  /// Words overwritten before the system side saw them, since the last reset.
  vp::Signal<std::uint32_t> crossing_overflow{"crossing_overflow"};
  /// Counts words that were lost on a way that somebody else models.
  void add_lost(std::uint32_t words) {
    if (words != 0) crossing_overflow = crossing_overflow.written() + words;
  }
  /// The pixel side is in reset, and with it the count.
  void forget_lost() { crossing_overflow = 0; }

 private:
  void edge() override;
  vp::IpEstimate own_estimate() const override;
  void reset();
  void count(bool delivered) {
    if (!delivered) crossing_overflow = crossing_overflow.written() + 1;
  }
};

}  // namespace pl
