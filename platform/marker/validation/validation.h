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

/// The rule of that value; null if there is none.
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

/// A picture as a gnuplot script.
struct Plot {
  std::string name;     ///< of its file, without .svg
  std::string caption;  ///< one sentence
  std::string figures;  ///< of the thesis: "5.29"
  std::string script;   ///< without terminal and output
};

/// Builds a script: data first, then panels in a grid, each with commands of its own.
class PlotScript {
 public:
  /// A panel of 400 x 300 px for each cell.
  PlotScript(int columns, int rows);

  /// A table of numbers under that name ("$name").
  void data(const std::string& name, const std::vector<std::vector<double>>& rows);
  /// Commands until the next panel, which ends with its plot command.
  void panel(const std::string& title, const std::string& x_label, const std::string& y_label,
             const std::string& commands);
  std::string text() const;

 private:
  int columns_, rows_;
  std::string data_, panels_;
};

/// Writes `name`.svg into the folder. False: gnuplot is not installed. Throws vp::InputError if it
/// failed.
bool draw(const Plot& plot, const std::filesystem::path& folder);

/// Pictures like figures 5.19 to 5.45 of the thesis: the increased-feature test, all tests,
/// accuracy. `work`: of the frames of marker_tests, in order.
std::vector<Plot> feature_plots(const Validation& validation);
std::vector<Plot> test_plots(const Validation& validation, const std::vector<ImageWork>& work);
std::vector<Plot> accuracy_plots(const Validation& validation);

/// All of them, and what they need counted in the images.
std::vector<Plot> all_plots(const Validation& validation);

/// A dashed line at a published value: "VALUE with lines ls 9 title 'thesis, mean'".
std::string published_line(const Validation& validation, const std::string& id, double scale = 1);

/// Value of a published row; throws std::out_of_range if there is none.
double published_value(const Validation& validation, const std::string& id);

/// What varies in a test: -0.5 of "x-0.5", 30 of "roll30".
double position_of(const Frame& frame);

/// The page docs/validation.md. Its pictures are expected in `pictures`, relative to it.
std::string markdown_text(const Validation& validation, const std::vector<Plot>& plots,
                          const std::string& pictures);

}  // namespace platform::validation
