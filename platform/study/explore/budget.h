#pragma once

#include <cstdint>
#include <functional>

#include <study/spec.h>

namespace platform::explore {

/// Seconds since some fixed moment.
using Clock = std::function<double()>;

/// The host's monotonic clock.
Clock host_clock();

/// What a search may spend: points, and time from the moment it was made. One budget covers all
/// that a command does, so "at most" holds for the whole of it.
class Budget {
 public:
  /// What the study allows. Throws vp::InputError for a time that is not one.
  explicit Budget(const study::SearchChoice& choice, Clock clock = host_clock());

  /// How many points may be looked at, from the first one on.
  std::uint64_t points() const { return points_; }
  bool time_is_over() const { return clock_() >= deadline_; }

  /// A budget that ends when `part` (0 to 1) of what is left of this one is spent, of which
  /// `looked_at` points are gone.
  Budget share(double part, std::uint64_t looked_at) const;

 private:
  Clock clock_;
  std::uint64_t points_;
  double deadline_;  ///< by the clock; infinite: none
};

}  // namespace platform::explore
