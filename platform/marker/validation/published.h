#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace platform::validation {

/// A value that the thesis prints.
struct Published {
  std::string id;        ///< "corner.delta"
  std::string section;   ///< of the thesis: "5.4.1.2"
  std::string system;    ///< "hybrid", "ps-only" or "both"
  std::string quantity;  ///< in words
  std::string unit;      ///< "ms", "x", "%", "1" …
  double value = 0;
  int decimals = 0;              ///< with which it is printed
  std::optional<double> spread;  ///< the standard deviation printed beside it
  std::string note;              ///< may be empty
};

/// The installed table (data/published.csv). Throws vp::InputError if it is not there.
std::filesystem::path published_file();

/// Reads a table. Throws vp::InputError that names file and line.
std::vector<Published> read_published(const std::filesystem::path& file);

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
