#include <vp/thermal.h>

#include <cmath>

#include <vp/error.h>
#include <vp/text.h>

namespace vp {

namespace {

constexpr double reference_c = 25;
/// Nothing that works gets hotter: beyond it the iteration only grows.
constexpr double hottest_c = 500;
constexpr int most_steps = 100'000;

[[noreturn]] void run_away(const ThermalPath& path, double dynamic_w) {
  throw InputError("thermal runaway: with " + format_fixed(dynamic_w, 3) + " W of dynamic power, " +
                   format_fixed(path.ambient_c, 1) + " C ambient and " +
                   format_fixed(path.theta_ja, 1) +
                   " C/W the junction finds no temperature at which it stays: lower power.ambient, "
                   "power.theta_ja (a heat sink) or the clocks");
}

}  // namespace

double LeakageCurve::watts(double junction_c) const {
  return base_w + leakage_w * std::exp(slope * (junction_c - reference_c));
}

StaticPoint find_static_point(const LeakageCurve& leakage, const ThermalPath& path,
                              double dynamic_w) {
  double junction = path.ambient_c + path.theta_ja * dynamic_w;
  for (int step = 0; step < most_steps && junction < hottest_c; ++step) {
    const double next = path.ambient_c + path.theta_ja * (dynamic_w + leakage.watts(junction));
    // Rising steps that shrink to nothing: below a rounding error of the temperature.
    if (next - junction <= 1e-12 * (1 + std::abs(next))) return {next, leakage.watts(next)};
    junction = next;
  }
  run_away(path, dynamic_w);
}

}  // namespace vp
