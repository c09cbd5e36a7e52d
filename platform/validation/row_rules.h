#pragma once

#include <optional>
#include <string>
#include <vector>

#include <validation/measured.h>

namespace platform::validation {

enum class Kind {
  timing,    ///< must be within the band
  geometry,  ///< likewise: follows from camera and scene
  accuracy,  ///< shown side by side, never tuned
  estimate,  ///< power and highest clocks, where the run has them
  given,     ///< an input of the validation, not a result
};

/// How a published value is found in the frames of a run.
struct RowRule {
  std::string id;  ///< of data/published.csv
  Kind kind;
  std::string how;  ///< one phrase for the report
  /// None: the run does not have it.
  std::optional<Measurement> (*measure)(const Measured&);
  /// Published values of which this one is the plain difference, ratio or sum: where those are used
  /// for calibration, this one is no prediction of its own.
  std::vector<std::string> follows_from = {};
  bool lower_bound = false;  ///< the thesis says "at least"
  bool taken = false;        ///< what the run has is the thesis' figure, put in as data
};

/// One for each published value, in their order.
const std::vector<RowRule>& row_rules();

/// The rule of that value; null if there is none.
const RowRule* find_rule(const std::string& id);

}  // namespace platform::validation
