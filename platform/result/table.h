#pragma once

#include <string>
#include <vector>

namespace platform::result {

/// Rows of columns for a terminal: numbers to the right, texts to the left.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> head);
  void add(std::vector<std::string> row);
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// The last parts of dotted names, as many as tell them apart: heads of columns.
std::vector<std::string> short_names(const std::vector<std::string>& names);

/// A number in as many digits as a reader needs: "92.493", "0.0213", "12400".
std::string readable(double value);

/// A line of a CSV file; fields stand in quotes where needed.
std::string csv_line(const std::vector<std::string>& fields);
/// A number as short as it reads back.
std::string csv_number(double value);

}  // namespace platform::result
