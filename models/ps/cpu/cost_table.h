#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace ps {

/// What one unit of work costs.
struct WorkCost {
  double cycles = 0;    ///< CPU cycles, 0 to 10⁹
  double stall_ns = 0;  ///< memory stalls in ns that do not scale with the CPU's clock, 0 to 10⁹
};

/// The cost of each unit of work that programs count (hal_program.work), by name. Data: it says
/// nothing of how it was found; `profile` names that, and stands in every report.
class CostTable {
 public:
  explicit CostTable(std::string profile) : profile_(std::move(profile)) {}

  const std::string& profile() const { return profile_; }
  /// Adds or replaces an entry. Throws vp::InputError that names it if a number is negative, absurd
  /// or not finite.
  void set(const std::string& work, const WorkCost& cost);
  /// The cost of a unit of `program`. Throws vp::InputError that names the unit if the table has
  /// none.
  const WorkCost& at(const std::string& work, const std::string& program) const;
  const std::map<std::string, WorkCost>& entries() const { return entries_; }

 private:
  std::string profile_;
  std::map<std::string, WorkCost> entries_;
};

}  // namespace ps
