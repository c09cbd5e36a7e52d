#pragma once

#include <hal/hal.h>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ps {

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
