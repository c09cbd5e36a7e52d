#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ps {

/// The time a processor has spent since it last looked at the clock, in CPU cycles and in
/// nanoseconds that do not scale with its frequency.
///
/// Sums are exact integers: 2^-20 cycles and femtoseconds. Only take_ps() rounds, and keeps what it
/// cut off for the next call: the picoseconds taken in total do not depend on how the work was
/// split, and never drift.
class LocalTime {
 public:
  using Wide = unsigned __int128;

  static constexpr unsigned fraction_bits = 20;
  static constexpr std::uint64_t one_cycle = std::uint64_t{1} << fraction_bits;
  static constexpr std::uint64_t fs_per_ps = 1'000;
  static constexpr std::uint64_t fs_per_second = 1'000'000'000'000'000;

  /// Longest time that one call adds: more than any run lasts, less than what overflows.
  static constexpr Wide most_cycles = Wide{1} << 76;  ///< in 2^-20 cycles: three years at 667 MHz
  static constexpr Wide most_stall_fs = Wide{1} << 100;

  /// `hertz` 1 to 10^12: the frequency at which cycles added before are taken.
  void set_frequency(std::uint64_t hertz);

  void add_cycles(Wide fraction_cycles) { cycles_.add(fraction_cycles, most_cycles); }
  void add_stall_fs(Wide femtoseconds) { stall_fs_.add(femtoseconds, most_stall_fs); }

  bool empty() const { return (cycles_.little | stall_fs_.little) == 0; }
  /// Whole picoseconds added since the last call.
  std::uint64_t take_ps() { return little() ? take_little() : take_much(); }
  /// Is it so little that take_little() does?
  bool little() const {
    return cycles_.little <= little_cycles_ && stall_fs_.little <= little_limit;
  }
  /// take_ps(), where it is.
  std::uint64_t take_little();
  /// What take_ps() would return after so many more whole cycles.
  std::uint64_t ps_after(std::uint64_t cycles) const;

 private:
  /// 2^-20 of a cycle is 5^15 / (hertz · 2^5) femtoseconds: 10^15 / (hertz · 2^20), reduced.
  static constexpr std::uint64_t numerator_factor = 30'517'578'125;
  static constexpr unsigned denominator_bits = 5;
  /// Up to this, sums of two stay within 64 bits.
  static constexpr std::uint64_t little_limit = std::uint64_t{1} << 62;

  /// A sum that is nearly always little.
  struct Sum {
    static constexpr std::uint64_t in_much = ~std::uint64_t{0};
    std::uint64_t little = 0;  ///< the sum, or in_much
    Wide much = 0;

    void add(Wide amount, Wide most) {
      if (amount <= little_limit && little <= little_limit) {
        little += static_cast<std::uint64_t>(amount);
      } else {
        much = std::min(value() + std::min(amount, most), most);
        little = in_much;
      }
    }
    Wide value() const { return little == in_much ? much : little; }
  };

  struct Taken {
    std::uint64_t ps, cycle_remainder, fs_remainder;
  };
  Taken taken(std::uint64_t cycles) const;
  std::uint64_t take_much();

  std::uint64_t hertz_ = 0;
  std::uint64_t denominator_ = 1;    ///< hertz · 2^5
  std::uint64_t cycle_fs_ = 0;       ///< a whole cycle in femtoseconds, rounded down
  std::uint64_t cycle_rest_ = 0;     ///< what that cuts off, in 1 / (hertz · 2^5) of one
  std::uint64_t little_cycles_ = 0;  ///< up to this, take_little() does
  Sum cycles_;                       ///< in 2^-20 cycles
  Sum stall_fs_;
  std::uint64_t cycle_remainder_ = 0;  ///< in 1 / (hertz · 2^5) of a femtosecond, less than one
  std::uint64_t fs_remainder_ = 0;
};

// Femtoseconds of whole cycles and of the fraction, then picoseconds; what is cut off is kept.
inline LocalTime::Taken LocalTime::taken(std::uint64_t cycles) const {
  const std::uint64_t whole = cycles / one_cycle;
  const std::uint64_t numerator =
      whole * cycle_rest_ + cycles % one_cycle * numerator_factor + cycle_remainder_;
  const std::uint64_t rest_fs = numerator / denominator_;
  const std::uint64_t fs = whole * cycle_fs_ + rest_fs + stall_fs_.little + fs_remainder_;
  const std::uint64_t ps = fs / fs_per_ps;
  return {ps, numerator - rest_fs * denominator_, fs - ps * fs_per_ps};
}

inline std::uint64_t LocalTime::take_little() {
  const Taken all = taken(cycles_.little);
  cycle_remainder_ = all.cycle_remainder;
  fs_remainder_ = all.fs_remainder;
  cycles_.little = stall_fs_.little = 0;
  return all.ps;
}

inline std::uint64_t LocalTime::ps_after(std::uint64_t cycles) const {
  if (cycles <= little_cycles_ / one_cycle / 2 && cycles_.little <= little_cycles_ / 2 &&
      stall_fs_.little <= little_limit) {
    return taken(cycles_.little + cycles * one_cycle).ps;
  }
  LocalTime copy = *this;
  copy.add_cycles(Wide{cycles} << fraction_bits);
  return copy.take_ps();
}

/// What a processor has done ahead of the simulation time, in order: stretches of work, and the
/// functions it entered and left between them.
class Timeline {
 public:
  enum class Kind : std::uint8_t {
    work,   ///< time passes; an interrupt may come in between
    enter,  ///< enters `function`
    leave,  ///< leaves the function entered last
  };
  struct Segment {
    Kind kind = Kind::work;
    std::uint32_t function = 0;
    std::uint64_t ps = 0;
  };

  bool empty() const { return next_ == segments_.size(); }
  std::size_t size() const { return segments_.size() - next_; }
  /// The time of all segments.
  std::uint64_t total_ps() const { return total_ps_; }
  const Segment& front() const { return segments_[next_]; }

  void push(Kind kind, std::uint64_t ps, std::uint32_t function = 0) {
    Segment& segment = segments_.emplace_back();
    segment.kind = kind;
    segment.function = function;
    segment.ps = ps;
    total_ps_ += ps;
  }
  /// `ps` of the first segment have passed.
  void pass(std::uint64_t ps) {
    segments_[next_].ps -= ps;
    total_ps_ -= ps;
  }
  /// The first segment is over.
  void pop() {
    total_ps_ -= segments_[next_].ps;
    if (++next_ == segments_.size()) {
      segments_.clear();
      next_ = 0;
    }
  }

 private:
  std::vector<Segment> segments_;
  std::size_t next_ = 0;
  std::uint64_t total_ps_ = 0;
};

}  // namespace ps
