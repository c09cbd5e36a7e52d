#include <vp/clock_times.h>

namespace vp {

namespace {

using Wide = unsigned __int128;

}  // namespace

void EdgeTimes::restart(std::uint64_t cycles, std::uint64_t ps, std::uint64_t hertz) {
  hertz_ = hertz;
  origin_ = anchor_ = {cycles, ps, hertz / 2};
  reach_ps_ = 0;
  if (stands()) return;
  period_ps_ = ps_per_second / hertz_;
  period_remainder_ = ps_per_second % hertz_;
  reach_ps_ = (std::uint64_t{1} << 62) / hertz_;
}

// Some way before `cycle`, as the next question may be about an earlier time.
void EdgeTimes::set_anchor(std::uint64_t cycle) const {
  constexpr std::uint64_t margin = std::uint64_t{1} << 16;
  const std::uint64_t from_origin = cycle - origin_.cycle;
  const std::uint64_t edges = from_origin - std::min(from_origin, margin);
  const Wide numerator = Wide(edges) * ps_per_second + origin_.remainder;
  anchor_ = {origin_.cycle + edges, origin_.ps + static_cast<std::uint64_t>(numerator / hertz_),
             static_cast<std::uint64_t>(numerator % hertz_)};
}

// The first edge at or after `ps`, which is past the origin, counted from an anchor near it.
inline std::uint64_t EdgeTimes::edges_from_anchor(std::uint64_t ps) const {
  if (ps - anchor_.ps > reach_ps_) {
    // The edge looked for or the one before.
    set_anchor(origin_.cycle +
               static_cast<std::uint64_t>(Wide(ps - origin_.ps) * hertz_ / ps_per_second));
  }
  // The smallest n whose edge, n · 10¹² / f + what was cut off, is not before.
  const std::uint64_t distance = (ps - anchor_.ps) * hertz_;
  if (distance <= anchor_.remainder) return 0;
  return (distance - anchor_.remainder + ps_per_second - 1) / ps_per_second;
}

std::uint64_t EdgeTimes::cycle_at_or_after(std::uint64_t ps) const {
  if (stands()) return never;
  if (ps <= origin_.ps) return origin_.cycle + 1;
  const std::uint64_t n = edges_from_anchor(ps);
  return std::max(anchor_.cycle + n, origin_.cycle + 1);
}

std::uint64_t EdgeTimes::far_edge_at_or_after(std::uint64_t ps) const {
  if (stands()) return never;
  if (ps <= origin_.ps) return edge(origin_.cycle + 1).ps;
  const std::uint64_t n = edges_from_anchor(ps);
  if (anchor_.cycle + n <= origin_.cycle) return edge(origin_.cycle + 1).ps;
  return time_from_anchor(n);
}

void Earliest::push(std::uint64_t time) {
  times_.back() = time;
  times_.push_back(never);
  look();
}

void Earliest::erase(std::size_t place) {
  times_.erase(times_.begin() + static_cast<std::ptrdiff_t>(place));
  look();
}

void Earliest::look() {
  first_ = 0;
  others_ = never;
  for (std::size_t place = 1; place < times_.size(); ++place) set(place, times_[place]);
}

}  // namespace vp
