#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace platform::cli {

/// What Verilator counted of RTL that was built with COVERAGE, in one file or several.
class RtlCoverage {
 public:
  /// Adds the counts of a file, if there is one. Throws vp::InputError for one that is damaged.
  void add(const std::string& file);

  bool empty() const { return counts_.empty(); }
  /// Points of that kind, "v_line" or "v_toggle": those that were reached, and all.
  std::pair<std::uint64_t, std::uint64_t> reached(const std::string& kind) const;
  /// Lines that were not, "corner.sv:33", in order.
  std::vector<std::string> missed_lines() const;

 private:
  std::map<std::string, std::uint64_t> counts_;  ///< by point
};

}  // namespace platform::cli
