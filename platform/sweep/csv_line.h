#pragma once

#include <string>
#include <vector>

namespace platform::sweep {

/// A line of a CSV file; fields stand in quotes where needed.
std::string csv_line(const std::vector<std::string>& fields);
/// A number as short as it reads back.
std::string csv_number(double value);

}  // namespace platform::sweep
