#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pl {

/// What a run in lock-step has shown of RTL: of each port how often it meant something, changed,
/// and which bits were seen at both levels. What never changed was not compared in earnest.
struct LockstepUse {
  struct Port {
    std::string name;
    unsigned bits = 1;
    bool output = false;
    bool fixed = false;  ///< an output that is the same for ever, as the strobes of whole words
    std::uint64_t clocks = 0;         ///< on which it meant something
    std::uint64_t changes = 0;        ///< from one of them to the next
    std::uint64_t rises = 0;          ///< of its lowest bit
    std::uint64_t high = 0, low = 0;  ///< bits that were seen there
    std::uint64_t last = 0;           ///< that was noted

    void note(std::uint64_t value);
  };
  /// A stream's valid and ready.
  struct Stream {
    std::string name;  ///< "m"
    std::uint64_t beats = 0, stalls = 0;
  };

  std::uint64_t clocks = 0;
  std::vector<Port> ports;  ///< inputs first
  std::vector<Stream> streams;
};

/// Where RTL in lock-step leaves what it counted of its lines and toggles, if it was built so;
/// empty: nowhere.
std::string& lockstep_coverage();

/// Of the last simulation of this process that had RTL in lock-step; none: there was none.
std::optional<LockstepUse>& lockstep_use();

}  // namespace pl
