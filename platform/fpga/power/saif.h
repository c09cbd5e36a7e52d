#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace platform::power {

/// What a simulator counted: backward SAIF 2.0 (IEEE 1801).
struct Saif {
  /// An entry of an instance's nets or ports: a bit, named "top.core.word[3]".
  struct Bit {
    std::string path;           ///< levels separated by '.', whatever divides them in the file
    std::uint64_t high = 0;     ///< T1, in steps of the file
    std::uint64_t toggles = 0;  ///< TC
  };

  double duration_ps = 0;
  std::vector<Bit> bits;  ///< in the order of the file
};

/// Throws vp::InputError with the line for what is no SAIF, cut off, or without a duration.
Saif read_saif(const std::string& file);

}  // namespace platform::power
