#include <ps/cpu/cost_table.h>
#include <vp/error.h>
#include <vp/text.h>
#include <cmath>
#include <vector>

namespace ps {

namespace {

constexpr double most_per_unit = 1e9;

void check(const std::string& profile, const std::string& work, const char* what, double value) {
  if (std::isfinite(value) && value >= 0 && value <= most_per_unit) return;
  throw vp::InputError("cost table '" + profile + "': the " + what + " of '" + work + "' are " +
                       std::to_string(value) + ": give a number from 0 to 1e9");
}

}  // namespace

void CostTable::set(const std::string& work, const WorkCost& cost) {
  check(profile_, work, "cycles", cost.cycles);
  check(profile_, work, "stalls (ns)", cost.stall_ns);
  entries_[work] = cost;
}

const WorkCost& CostTable::at(const std::string& work, const std::string& program) const {
  const auto entry = entries_.find(work);
  if (entry != entries_.end()) return entry->second;
  std::vector<std::string> names;
  for (const auto& [name, cost] : entries_) names.push_back(name);
  const std::string nearest = vp::nearest_match(work, names);
  throw vp::InputError("cost table '" + profile_ + "' has no entry for '" + work +
                       "', a unit of work of program '" + program +
                       "': add it to other_units of a profile of your own" +
                       (nearest.empty() ? "" : " (nearest entry: '" + nearest + "')"));
}

}  // namespace ps
