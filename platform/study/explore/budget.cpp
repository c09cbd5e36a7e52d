#include <study/explore/budget.h>

#include <vp/error.h>
#include <vp/unit.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace platform::explore {

namespace {

double seconds_of(const study::SearchChoice& choice) {
  if (!choice.time) return std::numeric_limits<double>::infinity();
  constexpr double ps_in_a_second = 1e12;
  try {
    const double seconds =
        vp::parse_quantity(*choice.time, vp::Unit::time).to_double() / ps_in_a_second;
    if (seconds > 0) return seconds;
  } catch (const vp::InputError&) {  // reported below
  }
  const std::string where = choice.where.empty() ? "" : choice.where + ": ";
  throw vp::InputError(where + "'" + *choice.time +
                       "' is no time for a search: write '90 s' or '3600 s'");
}

}  // namespace

Clock host_clock() {
  return [] {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(now).count();
  };
}

Budget::Budget(const study::SearchChoice& choice, Clock clock)
    : clock_(std::move(clock)), points_(choice.points), deadline_(clock_() + seconds_of(choice)) {}

Budget Budget::share(double part, std::uint64_t looked_at) const {
  Budget share(*this);
  const std::uint64_t left = points_ - std::min(points_, looked_at);
  share.points_ =
      looked_at + static_cast<std::uint64_t>(std::floor(part * static_cast<double>(left)));
  if (std::isfinite(deadline_)) {
    const double now = clock_();
    share.deadline_ = now + part * std::max(0.0, deadline_ - now);
  }
  return share;
}

}  // namespace platform::explore
