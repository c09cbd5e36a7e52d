#include <vp/energy_ledger.h>

#include <algorithm>

namespace vp {

namespace {

template <class Key>
auto sums(const std::vector<EnergyEntry>& entries, Key EnergyEntry::*key) {
  std::map<Key, Band> result;
  for (const EnergyEntry& entry : entries) result[entry.*key] += entry.joules;
  return result;
}

}  // namespace

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
    return known.module == entry.module && known.rail == entry.rail && known.kind == entry.kind;
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
  Band sum;
  for (const EnergyEntry& entry : entries_) sum += entry.joules;
  return sum;
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

}  // namespace vp
