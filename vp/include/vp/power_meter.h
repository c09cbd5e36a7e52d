#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace vp {

/// A quantity that is constant for a while and then changes: the frequency of a clock, whether
/// something runs. Keeps its history, so that its integral between two times can be queried later.
class PiecewiseConstant {
 public:
  struct Step {
    std::uint64_t ps;
    double value;
  };

  explicit PiecewiseConstant(double value = 0) : steps_{{0, value}} {}

  /// It has that value from `ps` on; not earlier than the change before. Of several values of an
  /// instant the last one counts.
  void set(std::uint64_t ps, double value);
  double value() const { return steps_.back().value; }
  /// The value at `ps`, which must not precede the history.
  double at(std::uint64_t ps) const;
  /// Value · seconds between the two times. 0 if `to_ps` is not after `from_ps`.
  double integral(std::uint64_t from_ps, std::uint64_t to_ps) const;

  /// The changes, oldest first. The first one holds for all earlier times.
  const std::vector<Step>& steps() const { return steps_; }
  /// Drops the history before `ps`, which will not be queried again.
  void forget_before(std::uint64_t ps);

 private:
  std::vector<Step> steps_;
};

/// The same number estimated low, as it is believed, and high.
struct Band {
  double low = 0;
  double nominal = 0;
  double high = 0;

  Band& operator+=(const Band& other) {
    low += other.low;
    nominal += other.nominal;
    high += other.high;
    return *this;
  }
};

inline Band operator*(const Band& band, double factor) {
  return {band.low * factor, band.nominal * factor, band.high * factor};
}

inline Band operator*(const Band& a, const Band& b) {
  return {a.low * b.low, a.nominal * b.nominal, a.high * b.high};
}

/// What is left of `a` without its part `b`: no estimate goes below 0.
inline Band operator-(const Band& a, const Band& b) {
  return {std::max(0.0, a.low - b.low), std::max(0.0, a.nominal - b.nominal),
          std::max(0.0, a.high - b.high)};
}

/// What makes a part of the power flow.
enum class PowerKind {
  leakage,  ///< voltage alone: grows with the temperature
  clock,    ///< a clock that runs
  state,    ///< something being in a state: busy, enabled
  event,    ///< something that happens, each time
};

/// "static", "clock", "state", "event".
const char* to_string(PowerKind kind);

/// Energy of one module from one rail, for one reason.
struct EnergyEntry {
  std::string module;  ///< hierarchical name
  std::string group;   ///< modules that a reader wants to see as one
  std::string rail;    ///< supply
  PowerKind kind = PowerKind::state;
  std::string source;  ///< of the coefficient
  Band joules;
  /// Entries of one cause are low, or high, together. Empty: those of one source are.
  std::string cause = {};
};

/// Where energy went. Every joule is in exactly one entry, so the nominal sums by module, rail,
/// group and kind all equal the total. A band of a sum adds the entries of one cause, and different
/// causes in quadrature, because their errors are independent.
class EnergyLedger {
 public:
  /// Adds to the entry of the same module, rail, kind and source.
  void add(const EnergyEntry& entry);
  void add(const EnergyLedger& other);

  /// In the order in which they first came.
  const std::vector<EnergyEntry>& entries() const { return entries_; }
  Band total() const;
  std::map<std::string, Band> by_module() const;
  std::map<std::string, Band> by_rail() const;
  std::map<std::string, Band> by_group() const;
  std::map<PowerKind, Band> by_kind() const;

 private:
  std::vector<EnergyEntry> entries_;
};

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
  std::string cause = {};                    ///< as in EnergyEntry
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

/// How hot a chip gets: junction = ambient + theta_ja · power, once temperatures have settled.
struct ThermalPath {
  double ambient_c = 25;
  double theta_ja = 0;  ///< °C/W
};

/// Power that flows without any clock: base + leakage · exp(slope · (Tj − 25 °C)).
struct LeakageCurve {
  double base_w = 0;
  double leakage_w = 0;  ///< at 25 °C
  double slope = 0;      ///< 1/°C

  double watts(double junction_c) const;
};

/// Where temperature and static power agree.
struct StaticPoint {
  double junction_c = 0;
  double static_w = 0;
};

/// Static power heats the chip, and heat raises static power: finds the fixed point of both at
/// `dynamic_w`, from below, so it is the stable one. Throws InputError if none exists (thermal
/// runaway).
StaticPoint find_static_point(const LeakageCurve& leakage, const ThermalPath& path,
                              double dynamic_w);

}  // namespace vp
