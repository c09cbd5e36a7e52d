#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>

#include <vp/clock.h>

namespace ps {

/// Up to when a core may run at once: the program's time-out, or before that the time at which
/// something wants to have a look.
class Deadline {
 public:
  /// The first of both.
  std::uint64_t ps() const { return first_ps_; }
  /// At `now_ps`, or at ps(), the program's time is over.
  bool is_timeout(std::uint64_t now_ps) const { return now_ps >= timeout_ps_; }

  void set_timeout(std::uint64_t ps) {
    timeout_ps_ = ps;
    first_ps_ = std::min(timeout_ps_, look_ps_);
  }
  void shorten_timeout(std::uint64_t ps) { set_timeout(std::min(timeout_ps_, ps)); }
  bool wants_look() const { return look_ps_ != vp::Clock::never; }
  /// Once. Instead of the look that was wanted before.
  void want_look(std::uint64_t ps, std::function<void()> look) {
    look_ps_ = ps;
    look_ = std::move(look);
    set_timeout(timeout_ps_);
  }
  /// The time of the look has come.
  void look() {
    look_ps_ = vp::Clock::never;
    set_timeout(timeout_ps_);
    look_();
  }

 private:
  std::uint64_t timeout_ps_ = 0;
  std::uint64_t look_ps_ = vp::Clock::never;
  std::uint64_t first_ps_ = 0;
  std::function<void()> look_;
};

}  // namespace ps
