#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace platform::cli {

/// Inputs that a proof found: a value a clock for each pin of these names.
struct RecordedPins {
  std::vector<std::string> names;
  std::vector<std::vector<std::uint64_t>> rows;
};

/// Reads the names, and a line a clock of as many hexadecimal numbers. Throws vp::InputError with
/// the line.
RecordedPins read_recorded(const std::string& file);

}  // namespace platform::cli
