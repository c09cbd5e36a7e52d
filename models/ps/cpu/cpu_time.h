#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <hal/hal.h>

namespace ps {

/// What one unit of work costs.
struct WorkCost {
  double cycles = 0;    ///< CPU cycles, 0 to 10⁹
  double stall_ns = 0;  ///< memory stalls in ns that do not scale with the CPU's clock, 0 to 10⁹
};

/// The cost of each unit of work that programs count (hal_program.work), by name. It does not say
/// how the costs were measured; `profile` names their origin, and every report shows it.
class CostTable {
 public:
  explicit CostTable(std::string profile) : profile_(std::move(profile)) {}

  const std::string& profile() const { return profile_; }
  /// Adds or replaces an entry. Throws vp::InputError that names it if a number is negative, absurd
  /// or not finite.
  void set(const std::string& work, const WorkCost& cost);
  /// The cost of a unit of `program`. Throws vp::InputError that names the unit if the table has
  /// none.
  const WorkCost& at(const std::string& work, const std::string& program) const;
  const std::map<std::string, WorkCost>& entries() const { return entries_; }
  /// How long code that counts no work takes, as a multiple of what it does compiled with -O0.
  double code_scale() const { return code_scale_; }
  /// `scale` 0.01 to 100.
  void scale_code(double scale) { code_scale_ = scale; }

 private:
  std::string profile_;
  double code_scale_ = 1;
  std::map<std::string, WorkCost> entries_;
};

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

/// How often a program did a unit of work.
struct WorkCount {
  std::string name;
  std::uint64_t count = 0;
  double cycles = 0;    ///< CPU cycles of one
  double stall_ns = 0;  ///< memory stalls of one in ns
};

/// Where a program's time went.
struct FunctionTime {
  std::string name;
  std::uint64_t calls = 0;
  std::uint64_t self_ps =
      0;  ///< inside the function itself; without interrupts and functions below it
  std::uint64_t total_ps =
      0;  ///< from entry to return; of nested calls of one function the outermost
};

/// Bookkeeping of what a processor does as simulation time passes.
class Activity {
 public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  void start(const hal_program& program);

  void enter(std::uint32_t function, std::uint64_t now_ps);
  void leave(std::uint64_t now_ps);
  /// The function that runs; `none` outside of all.
  std::uint32_t function() const { return stack_.empty() ? none : stack_.back().function; }

  /// `ps` passed in the function that runs, or in the interrupt's entry, exit and dispatcher.
  void busy(std::uint64_t ps) { unassigned_ps_ += ps; }
  /// `ps` passed asleep.
  void idle(std::uint64_t ps) { idle_ps_ += ps; }
  /// An interrupt begins or ends: the interrupted function's own time stops.
  void enter_handler();
  void leave_handler();

  const std::vector<FunctionTime>& functions() const;
  std::uint64_t busy_ps() const { return busy_ps_ + unassigned_ps_; }
  std::uint64_t idle_ps() const { return idle_ps_; }
  std::uint64_t handler_ps() const { return handler_ps_ + (in_handler_ ? unassigned_ps_ : 0); }

 private:
  struct Frame {
    std::uint32_t function;
    std::uint64_t entered_ps;
  };
  void assign() const;

  mutable std::vector<FunctionTime> functions_;
  std::vector<Frame> stack_;
  std::size_t handler_base_ = 0;  ///< frames of the interrupted program
  bool in_handler_ = false;
  std::uint64_t idle_ps_ = 0;
  // Time is assigned to functions when they change.
  mutable std::uint64_t unassigned_ps_ = 0;
  mutable std::uint64_t busy_ps_ = 0;
  mutable std::uint64_t handler_ps_ = 0;
};

}  // namespace ps
