#pragma once

#include <map>
#include <string>
#include <vector>

namespace vp {

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
};

/// Where energy went. Every joule stands in exactly one entry, so the sums by module, rail, group
/// and kind are all the total.
class EnergyLedger {
 public:
  /// Adds to the entry of the same module, rail and kind.
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

}  // namespace vp
