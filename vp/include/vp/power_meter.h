#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <vp/energy_ledger.h>
#include <vp/piecewise.h>

namespace vp {

/// A reason for power to flow. A state or a clock: `joules` for each second of `state` = 1, so
/// watts of a state, joules per clock of a frequency. An event: `joules` each time.
struct PowerSource {
  std::string module;
  std::string group;
  std::string rail;
  PowerKind kind = PowerKind::state;
  std::string source;  ///< where the coefficient comes from
  Band joules;
  const PiecewiseConstant* state = nullptr;  ///< null for events
  std::function<double()> count;             ///< events since the start; asked at mark and measure
};

/// A stretch of simulated time.
struct Interval {
  std::uint64_t from_ps = 0;
  std::uint64_t to_ps = 0;

  double seconds() const {
    return to_ps > from_ps ? 1e-12 * static_cast<double>(to_ps - from_ps) : 0;
  }
};

/// Adds up what sources took. Costs nothing while the simulation runs: states keep their history,
/// events are counted by the models anyway.
class PowerMeter {
 public:
  /// Throws std::logic_error if the source has neither or both of `state` and `count`.
  void add(PowerSource source);
  const std::vector<PowerSource>& sources() const { return sources_; }

  /// Events from here on belong to the next measurement.
  void mark();
  /// What was taken in these intervals; the events since mark().
  EnergyLedger measure(const std::vector<Interval>& intervals) const;
  /// Power of all states and clocks at a time, W.
  Band power(std::uint64_t ps) const;
  /// The nominal one of a group; of all groups if it is empty.
  double watts(std::uint64_t ps, const std::string& group = "") const;

 private:
  std::vector<PowerSource> sources_;
  std::vector<double> marks_;  ///< of the events
};

}  // namespace vp
