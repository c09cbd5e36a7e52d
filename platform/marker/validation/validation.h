#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <chip/run/cost_profile.h>
#include <marker/validation/measured.h>
#include <marker/validation/published.h>

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

/// The rule of that value; null if missing.
const RowRule* find_rule(const std::string& id);

/// Timing rows must be this near the published value, %.
inline constexpr double band_percent = 5;

/// What a published value was to the model.
enum class Use {
  calibration,  ///< a constant of the profile was fitted to it
  follows,      ///< plain sum, difference or ratio of such values
  taken,        ///< put in as data
  predicted,
};

enum class Verdict {
  met,          ///< within the band
  met_rounded,  ///< within the band of a value that the thesis would print the same
  known_miss,   ///< off for a known reason, by as much as that reason explains
  missed,
  explained,  ///< an accuracy
  absent,     ///< not modelled by this run
  given,      ///< an input
};

/// A published value and what became of it.
struct Row {
  Published published;
  Kind kind = Kind::timing;
  std::string how;
  std::optional<Measurement> modelled;
  double difference_percent = 0;  ///< of the value as printed
  Use use = Use::predicted;
  Verdict verdict = Verdict::missed;
  std::string reason;  ///< empty for rows that are met
};

/// All rows, in the table's order. `fitted_to`: IDs of the values that the profile was fitted to.
/// Throws vp::InputError for a published value that there is no rule for.
std::vector<Row> judge_rows(const std::vector<Published>& published, const Measured& measured,
                            const std::set<std::string>& fitted_to);

/// A condition of the verdict.
struct Gate {
  std::string name;
  bool passed = false;
  std::string text;  ///< with the numbers
};

/// The conditions: rows, detections, and that both systems found the same.
std::vector<Gate> judge_gates(const std::vector<Row>& rows, const Measured& measured);

bool all_passed(const std::vector<Gate>& gates);

/// Everything that the report says.
struct Validation {
  Measured measured;
  std::string profile;
  std::string profile_origin;
  std::vector<profiles::FittedConstant> fitted;
  std::uint32_t repetitions = 1;
  std::vector<Row> rows;
  std::vector<Gate> gates;
  std::optional<OrderStudy> orders;
  std::optional<TurnStudy> turns;

  bool passed() const { return all_passed(gates); }
};

/// Judges the two runs. `profile`: the one that they used. Throws vp::InputError if the runs do not
/// belong together.
Validation validate_runs(const Measured& measured, const profiles::CostProfile& profile,
                         const std::vector<Published>& published, std::uint32_t repetitions);

/// validation.json: profile, fitted constants, rows, gates, verdict. Nothing in it depends on the
/// host.
std::string json_text(const Validation& validation);

/// validation.csv: a line for each row.
std::string rows_csv(const Validation& validation);

/// frames.csv: a line for each frame and system: counts, times in us, errors.
std::string frames_csv(const Validation& validation);

// Phrases that console, files and the page of the documentation share.

/// "12.16 x", "6144.63 us"; percent and numbers without unit have none of their own.
std::string published_text(const Published& published);
/// The modelled value with two decimals more than the published one has; "-" for none.
std::string modelled_text(const Row& row);
/// "-4.1 %"; "-" without a value.
std::string difference_text(const Row& row);
/// "used for calibration", "follows from calibration", "taken from the thesis" or "predicted";
/// empty where that says nothing.
std::string use_text(const Row& row);
/// "met", "met, as printed", "missed, known", "MISSED", "explained", "not modelled", "input".
std::string verdict_text(Verdict verdict);
std::string kind_text(Kind kind);

/// One or two sentences each.
std::string order_text(const OrderStudy& study);
std::string turn_text(const TurnStudy& study);

/// "validation passed: …" or "validation FAILED: …", with the gates that failed.
std::string verdict_line(const Validation& validation);

/// The whole report for a terminal: every row, the reasons, the gates and the verdict.
std::string console_text(const Validation& validation);

/// The page docs/validation.md.
std::string markdown_text(const Validation& validation);

}  // namespace platform::validation
