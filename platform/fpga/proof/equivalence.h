#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fpga/proof/contract.h>
#include <fpga/proof/links.h>

namespace platform::proof {

struct Claim {
  std::string ip;  ///< none: `theirs` alone, whose links keep the rules of AXI
  /// In the place of the IP; none: the RTL that comes with markervp, whose streams keep the rules
  /// of AXI4-Stream.
  std::optional<synthesis::Design> theirs;
  FindPins find_pins = {};           ///< without an IP
  synthesis::Parameters parameters;  ///< in place of the least legal ones
  unsigned seconds = 60;             ///< of the processor, for everything
  std::uint64_t depth = 0;           ///< clocks that are enough; 0: none
  std::filesystem::path folder;      ///< gets trace and stimulus of a difference
};

enum class Verdict { proved, bounded, different, unknown };

/// A port that differs, or a rule that is broken, on the last clock of a counterexample.
struct Difference {
  std::string name;
  std::string ours, theirs;  ///< hexadecimal; of a rule empty
};

struct Answer {
  Verdict verdict = Verdict::unknown;
  std::string why;                      ///< of unknown
  std::uint64_t clocks = 0;             ///< looked at without a difference, or the one that differs
  synthesis::Parameters parameters;     ///< of ours
  std::vector<std::string> ours_alone;  ///< of these those that theirs does not have
  std::vector<std::string> assumptions;  ///< in words
  std::vector<std::string> compared, not_compared;
  std::vector<Difference> differences;
};

constexpr const char *trace_name = "prove.vcd", *stimulus_name = "stimulus.txt";

/// Looks for a proof or a counterexample with Yosys and ABC. Throws vp::InputError for RTL that
/// cannot be read or has other ports, and where a tool is missing.
Answer prove(const Claim& claim);

}  // namespace platform::proof
