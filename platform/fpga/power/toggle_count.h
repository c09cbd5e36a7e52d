#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// What a simulation says of activity: how often the signals of a part of a design change.

namespace platform::power {

/// Where to count.
struct ToggleSource {
  std::string trace;     ///< VCD or FST of any simulator, or what one counted: NAME.saif
  std::string below;     ///< scope, whose signals and inner scopes count: "top.cipher"
  std::string clock;     ///< signal by whose rising edges toggles are divided: "top.clk"
  double clock_mhz = 0;  ///< instead, where the trace has none: its time is counted in such clocks
};

struct ToggleCount {
  struct Net {
    std::string path;
    unsigned width = 0;
    std::uint64_t toggles = 0;  ///< of all its bits
  };

  std::uint64_t clocks = 0;
  std::uint64_t bits = 0;     ///< of all nets together
  std::uint64_t toggles = 0;  ///< of them
  std::vector<Net> nets;      ///< the most active first, then by path

  /// Toggles a bit and clock.
  double rate() const { return static_cast<double>(toggles) / static_cast<double>(bits * clocks); }
};

/// Counts changes from 0 to 1 and from 1 to 0. Each net counts once, however many names show it,
/// and the clock itself does not; a SAIF does not say which names are of one net, and counts each.
/// Real numbers, texts and events are no nets. Throws vp::InputError
/// for a trace that cannot be read, a scope or clock that is not in it, a clock that is a vector or
/// does not rise.
ToggleCount count_toggles(const ToggleSource& source);

}  // namespace platform::power
