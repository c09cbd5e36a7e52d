#include <vp/piecewise.h>

#include <algorithm>
#include <iterator>

namespace vp {

namespace {

constexpr double s_per_ps = 1e-12;

/// The step that stands at `ps`.
template <class Steps>
auto standing_at(const Steps& steps, std::uint64_t ps) {
  const auto after = std::upper_bound(
      steps.begin(), steps.end(), ps,
      [](std::uint64_t time, const PiecewiseConstant::Step& step) { return time < step.ps; });
  return after == steps.begin() ? after : std::prev(after);
}

}  // namespace

void PiecewiseConstant::set(std::uint64_t ps, double value) {
  if (value == steps_.back().value) return;
  if (steps_.back().ps >= ps) {
    steps_.back().value = value;
  } else {
    steps_.push_back({ps, value});
  }
}

double PiecewiseConstant::at(std::uint64_t ps) const {
  return standing_at(steps_, ps)->value;
}

double PiecewiseConstant::integral(std::uint64_t from_ps, std::uint64_t to_ps) const {
  if (to_ps <= from_ps) return 0;
  double sum = 0;
  for (auto step = standing_at(steps_, from_ps); step != steps_.end() && from_ps < to_ps; ++step) {
    const auto next = std::next(step);
    const std::uint64_t end = next == steps_.end() ? to_ps : std::min(next->ps, to_ps);
    sum += step->value * static_cast<double>(end - from_ps) * s_per_ps;
    from_ps = end;
  }
  return sum;
}

void PiecewiseConstant::forget_before(std::uint64_t ps) {
  steps_.erase(steps_.begin(), standing_at(steps_, ps));
}

}  // namespace vp
