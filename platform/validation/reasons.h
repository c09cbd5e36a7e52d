#pragma once

#include <string>
#include <vector>

namespace platform::validation {

/// Why a published time cannot be met, and how far off the modelled value is for that reason: a
/// larger difference is a failure of its own.
struct KnownMiss {
  std::string id;  ///< of the published value
  double least_percent, most_percent;
  std::string reason;  ///< one sentence
};
const std::vector<KnownMiss>& known_misses();

/// Null if that row must be met.
const KnownMiss* find_known_miss(const std::string& id);

/// Why an accuracy differs; every one is explained.
std::string accuracy_reason(const std::string& id);

/// Where the thesis contradicts itself or says too little.
struct Contradiction {
  std::string topic;
  std::string text;  ///< with the numbers
};
const std::vector<Contradiction>& contradictions();

}  // namespace platform::validation
