#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <fpga/proof/equivalence.h>
#include <fpga/proof/miter.h>

namespace platform::proof {

/// Inputs that make both sides of a miter differ, played once more on the RTL as it was read:
/// Yosys' simulator knows nothing of what ABC made of it.
class Counterexample {
 public:
  /// `folder`: the files of the miter. Throws vp::HostError if Yosys fails.
  Counterexample(const std::filesystem::path& folder, const Miter& miter,
                 const std::vector<std::string>& inputs);

  /// The clock on which something differs; the first one is 0.
  std::uint64_t clock() const { return rows_.size() - 1; }
  /// Empty: nothing differs in the simulation.
  const std::vector<Difference>& differences() const { return differences_; }
  /// The trace, and what `rtl check --stimulus` plays: the names of the inputs, and a line a clock.
  void write(const std::filesystem::path& folder) const;

 private:
  void read_rows(const std::vector<std::string>& inputs);
  void simulate(const std::vector<std::string>& inputs) const;
  void read_trace(const Miter& miter);

  const std::filesystem::path folder_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::uint64_t>> rows_;  ///< a clock, a value for each name
  std::vector<Difference> differences_;
};

}  // namespace platform::proof
