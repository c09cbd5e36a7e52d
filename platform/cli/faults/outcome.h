#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <facts/result.h>
#include <nlohmann/json.hpp>

namespace platform::cli {

/// What is seen of a run from outside.
struct Witness {
  nlohmann::ordered_json units = nlohmann::ordered_json::array();  ///< results, without times
  std::vector<bool> told;             ///< by unit: it says itself that something is wrong
  std::vector<std::string> warnings;  ///< of the whole run, without times
  /// What the console shows, where no unit has data: then the program's text is its result.
  std::vector<std::string> lines;
  /// Lines of the console in which the program says that it noticed something.
  std::vector<std::string> notices;
  bool ended = false;  ///< the program came to its end
  int exit_code = 0;
  std::string error;  ///< what ended the run early
  std::uint64_t end_ps = 0;

  void add(const facts::UnitReport& unit);
  void add_warning(const std::string& warning);
  /// Call after all add(). A line with one of the texts `noticed` is a notice.
  void add_console(const std::string& text, const std::vector<std::string>& noticed);

  nlohmann::ordered_json json() const;
  static Witness of(const nlohmann::ordered_json& json);

 private:
  bool has_data_ = false;
};

/// What a fault came to. Where units have no data, the text on the console counts as a unit.
///
///   | Outcome   | The units of work                                                             |
///   |-----------|-------------------------------------------------------------------------------|
///   | masked    | are right, and nothing was noticed                                            |
///   | recovered | one was wrong or a warning came, the program or a checker said so, the last   |
///   |           | one is right                                                                  |
///   | reported  | are wrong, and the program or a checker said so                               |
///   | unnoticed | are wrong, and there is no sign of it                                         |
///   | hang      | do not all come: the program waits for ever, or longer than the campaign      |
///   | broken    | are not known: the simulator failed                                           |
enum class Outcome { masked, recovered, reported, unnoticed, hang, broken };

const std::vector<Outcome>& outcomes();
const char* to_string(Outcome outcome);

/// `right`: of the same run without a fault.
Outcome classify(const Witness& right, const Witness& seen);

/// What tells of a fault: the first warning that a right run has not, what ended the run, or the
/// first line of the console that differs; may be empty.
std::string sign(const Witness& right, const Witness& seen);

/// Lower and upper end of the 95 % interval of a share of `hits` in `count` (Wilson 1927), 0 to 1.
struct Interval {
  double low, high;
};
Interval wilson(std::uint64_t hits, std::uint64_t count);

}  // namespace platform::cli
