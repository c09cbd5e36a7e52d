#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace platform::trace {

/// Numbers with names: what an analysis found, for people, scripts and spreadsheets.
struct Table {
  using Cell = std::variant<std::string, std::uint64_t, double>;

  std::string name;  ///< a key: "links"
  std::string title;
  std::vector<std::string> columns;  ///< keys with their unit: "longest_stall_us"
  std::vector<std::vector<Cell>> rows;
  bool detail = false;  ///< long: left out of the text
};

/// Columns lined up, a title above each table; empty tables and details are left out.
std::string tables_as_text(const std::vector<Table>& tables);
/// {"links": [{"link": "pl.image_stream", "beats": 76800}]}
std::string tables_as_json(const std::vector<Table>& tables);
/// Blocks separated by an empty line: the table's name, the columns, the rows.
std::string tables_as_csv(const std::vector<Table>& tables);

}  // namespace platform::trace
