#include <vp/power_meter.h>

#include <vp/error.h>
#include <vp/text.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace vp {

namespace {

constexpr double s_per_ps = 1e-12;

/// The step in effect at `ps`.
template <class Steps>
auto step_at(const Steps& steps, std::uint64_t ps) {
  const auto after = std::upper_bound(
      steps.begin(), steps.end(), ps,
      [](std::uint64_t time, const PiecewiseConstant::Step& step) { return time < step.ps; });
  return after == steps.begin() ? after : std::prev(after);
}

/// Adds up entries: those of one cause as they are, causes in quadrature.
class Sum {
 public:
  void add(const EnergyEntry& entry) {
    nominal_ += entry.joules.nominal;
    causes_[entry.cause.empty() ? entry.source : entry.cause] += entry.joules;
  }

  Band band() const {
    double below = 0, above = 0;
    for (const auto& [cause, band] : causes_) {
      below = std::hypot(below, band.nominal - band.low);
      above = std::hypot(above, band.high - band.nominal);
    }
    return {nominal_ - below, nominal_, nominal_ + above};
  }

 private:
  double nominal_ = 0;
  std::map<std::string, Band> causes_;
};

template <class Key>
std::map<Key, Band> sums(const std::vector<EnergyEntry>& entries, Key EnergyEntry::*key) {
  std::map<Key, Sum> parts;
  for (const EnergyEntry& entry : entries) parts[entry.*key].add(entry);
  std::map<Key, Band> result;
  for (const auto& [of, sum] : parts) result[of] = sum.band();
  return result;
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
  return step_at(steps_, ps)->value;
}

double PiecewiseConstant::integral(std::uint64_t from_ps, std::uint64_t to_ps) const {
  if (to_ps <= from_ps) return 0;
  double sum = 0;
  for (auto step = step_at(steps_, from_ps); step != steps_.end() && from_ps < to_ps; ++step) {
    const auto next = std::next(step);
    const std::uint64_t end = next == steps_.end() ? to_ps : std::min(next->ps, to_ps);
    sum += step->value * static_cast<double>(end - from_ps) * s_per_ps;
    from_ps = end;
  }
  return sum;
}

void PiecewiseConstant::forget_before(std::uint64_t ps) {
  steps_.erase(steps_.begin(), step_at(steps_, ps));
}

const char* to_string(PowerKind kind) {
  switch (kind) {
    case PowerKind::leakage:
      return "static";
    case PowerKind::clock:
      return "clock";
    case PowerKind::state:
      return "state";
    case PowerKind::event:
      return "event";
  }
  return "";
}

void EnergyLedger::add(const EnergyEntry& entry) {
  const auto same = std::find_if(entries_.begin(), entries_.end(), [&](const EnergyEntry& known) {
    return known.module == entry.module && known.rail == entry.rail && known.kind == entry.kind &&
           known.source == entry.source;
  });
  if (same == entries_.end()) {
    entries_.push_back(entry);
  } else {
    same->joules += entry.joules;
  }
}

void EnergyLedger::add(const EnergyLedger& other) {
  for (const EnergyEntry& entry : other.entries_) add(entry);
}

Band EnergyLedger::total() const {
  Sum sum;
  for (const EnergyEntry& entry : entries_) sum.add(entry);
  return sum.band();
}

std::map<std::string, Band> EnergyLedger::by_module() const {
  return sums(entries_, &EnergyEntry::module);
}

std::map<std::string, Band> EnergyLedger::by_rail() const {
  return sums(entries_, &EnergyEntry::rail);
}

std::map<std::string, Band> EnergyLedger::by_group() const {
  return sums(entries_, &EnergyEntry::group);
}

std::map<PowerKind, Band> EnergyLedger::by_kind() const {
  return sums(entries_, &EnergyEntry::kind);
}

void PowerMeter::add(PowerSource source) {
  if ((source.state != nullptr) == static_cast<bool>(source.count)) {
    throw std::logic_error("power source of " + source.module + ": a state or events, not both");
  }
  marks_.push_back(source.count ? source.count() : 0);
  sources_.push_back(std::move(source));
}

void PowerMeter::mark() {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (sources_[i].count) marks_[i] = sources_[i].count();
  }
}

EnergyLedger PowerMeter::measure(const std::vector<Interval>& intervals) const {
  EnergyLedger ledger;
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const PowerSource& source = sources_[i];
    double amount = 0;
    if (source.count) {
      amount = source.count() - marks_[i];
    } else {
      for (const Interval& interval : intervals) {
        amount += source.state->integral(interval.from_ps, interval.to_ps);
      }
    }
    ledger.add({source.module, source.group, source.rail, source.kind, source.source,
                source.joules * amount, source.cause});
  }
  return ledger;
}

Band PowerMeter::power(std::uint64_t ps) const {
  Band sum;
  for (const PowerSource& source : sources_) {
    if (source.state) sum += source.joules * source.state->at(ps);
  }
  return sum;
}

double PowerMeter::watts(std::uint64_t ps, const std::string& group) const {
  double sum = 0;
  for (const PowerSource& source : sources_) {
    if (source.state && (group.empty() || group == source.group)) {
      sum += source.joules.nominal * source.state->at(ps);
    }
  }
  return sum;
}

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
