#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace platform::cli {

/// A campaign as its file says it:
///
///   design: thesis
///   inputs: [z1.0, z2.0]
///   count: 10000
///   seed: 1
///   classes: [bus, register]     # none: all
///   below: [pl.axi_dma_0]        # none: everywhere
///   set: {ps.cores: 1}
///   noticed: [retry, ERROR]      # a line of the console with it says that something went wrong
///   simulate: all                # needed: not those whose outcome is known without
///   patience: 200 ms             # how long a run with a fault may take longer
struct CampaignFile {
  std::optional<std::string> design;
  std::optional<std::string> program;
  std::optional<std::string> fidelity;
  std::vector<std::string> inputs;
  std::vector<std::pair<std::string, std::string>> settings;  ///< by path, in order
  std::uint64_t count = 1000;                                 ///< faults, 1 to 10 million
  std::uint64_t seed = 1;
  std::uint64_t repeat = 1;  ///< times that the inputs are run
  std::vector<std::string> classes;
  std::vector<std::string> below;
  std::vector<std::string> noticed;  ///< texts in lines of the console
  bool simulates_all = false;
  /// Beyond the end of the run without faults, before a run with one is a hang; at least that run's
  /// time. Programs that give a unit up after a second must come to it.
  std::uint64_t patience_ps = 1'500'000'000'000;
};

/// Reads one. Throws vp::InputError "FILE:line: …".
CampaignFile read_campaign(const std::string& path);

}  // namespace platform::cli
