#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <hal/hal.h>
#include <ps/cpu/local_time.h>

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

/// How often a program did a unit of work.
struct WorkCount {
  std::string name;
  std::uint64_t count = 0;
  double cycles = 0;    ///< CPU cycles of one
  double stall_ns = 0;  ///< memory stalls of one in ns
};

/// Counts the work of a program, and what it costs.
class WorkMeter {
 public:
  /// The cost of all work so far.
  struct Counted {
    LocalTime::Wide cycles = 0;  ///< in 2^-20 cycles
    LocalTime::Wide stall_fs = 0;
  };
  /// A unit of work.
  struct Unit {
    LocalTime::Wide cycles = 0;    ///< of one, in 2^-20 cycles
    LocalTime::Wide stall_fs = 0;  ///< of one
    LocalTime::Wide most_fs = 0;   ///< the time of one, rounded up
    std::uint64_t count = 0;
  };

  /// Throws vp::InputError if `costs` lacks a unit of work of the program.
  void load(const hal_program& program, const CostTable& costs);
  /// The cost of a unit is kept in cycles; its upper bound in time follows the clock.
  void set_frequency(std::uint64_t hertz);
  /// What a basic block takes, or a unit of what it is charged by, in cycles, 0 to 10^6.
  void set_code_cycles(double cycles);

  /// `item` has been done `count` times more; null: the program has no such unit.
  const Unit* add(std::uint32_t item, std::uint64_t count) {
    if (item >= units_.size()) return nullptr;
    units_[item].count += count;
    return &units_[item];
  }
  /// `blocks` of code ran, `slower` times as long as usual. Returns their cycles, in 2^-20.
  LocalTime::Wide add_code(std::uint64_t blocks, std::uint64_t slower) {
    const LocalTime::Wide cycles = LocalTime::Wide{blocks} * code_unit_ * slower;
    code_cycles_ += cycles;
    return cycles;
  }

  std::vector<WorkCount> counts() const;
  Counted counted() const;

 private:
  const hal_program* program_ = nullptr;
  std::vector<Unit> units_;
  std::uint64_t code_unit_ = 0;      ///< in 2^-20 cycles
  LocalTime::Wide code_cycles_ = 0;  ///< in 2^-20 cycles
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
