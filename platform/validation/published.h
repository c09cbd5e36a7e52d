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

}  // namespace platform::validation
