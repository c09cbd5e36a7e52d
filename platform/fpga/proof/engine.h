#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace platform::proof {

/// The processor's time that a proof may take, all commands together: on a busy machine it takes
/// longer, and finds the same.
class Budget {
 public:
  explicit Budget(unsigned seconds);
  /// At least 1: what is begun late is ended soon.
  unsigned seconds_left() const;
  bool is_over() const;

 private:
  double end_;  ///< of the time of all children so far
};

/// What is known of an AIGER circuit with one output.
struct Search {
  bool proved = false;       ///< it is never high, on no clock
  std::uint64_t clocks = 0;  ///< it is low on so many at least, counted from the first
  /// The inputs on each clock, one digit a bit, if it can be high: on the last one it is.
  std::optional<std::vector<std::string>> inputs;
};

/// Asks Berkeley's ABC for a proof or a counterexample until the budget is used up. Registers that
/// are always equal become one (lcorr), after which much is proved at once (pdr); bounded model
/// checking finds what shows soon; then nets that are equal become one (scorr), of which pdr proves
/// more; then bounded model checking of what is left, `depth` clocks at most if it is not 0. `file`
/// lies in a folder of its own. Throws vp::InputError if ABC is not installed.
Search search(const std::filesystem::path& file, const Budget& budget, std::uint64_t depth);

}  // namespace platform::proof
