#pragma once

#include <string>

namespace platform::facts {

/// Which way a figure is better.
enum class Better { neither, less, more };

/// "neither", "less", "more".
const char* to_string(Better better);

/// What a number of a run is. It is declared once, where it is read: result.json, metrics, tables,
/// pages and the list in the docs follow from that.
struct Figure {
  Figure(std::string figure_path, std::string figure_unit, std::string figure_meaning,
         Better which_way = Better::neither, std::string head = {},
         const char* file = __builtin_FILE(), int line = __builtin_LINE());

  /// The same; people see its value times `times`, in a unit that suits them better.
  Figure shown_in(std::string unit_for_people, double times) const;
  /// The same, below what has it: "w" below "power.modules.*".
  Figure below(const std::string& prefix) const;

  std::string path;     ///< in result.json; `*` is any name, or several with dots between
  std::string unit;     ///< "1": a count, a ratio, or a truth
  std::string meaning;  ///< a phrase
  Better better;
  /// At the head of a row or column of a page. Pages show what has one unless asked otherwise; `*`
  /// as in the path.
  std::string title;
  std::string people_unit;  ///< empty: `unit`
  double factor = 1;
  std::string place;  ///< of the declaration: "result/cost_members.cpp:31"
};

}  // namespace platform::facts
