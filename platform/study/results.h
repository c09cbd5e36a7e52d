#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <result/verdict.h>
#include <study/axes.h>
#include <study/shards.h>
#include <vp/expression.h>

namespace platform::study {

/// A point of a sweep with its figures.
struct ResultRow : Point, Outcome {
  /// The effective configuration: these values, which points of a family share, and its changes.
  std::shared_ptr<const std::map<std::string, std::string>> base;
  Word program;
  Word inputs;
  /// Of a point with the results of an earlier one (Repetitions): the place of that among the rows.
  std::optional<std::size_t> same_as;

  /// The text of a parameter of the effective configuration; null if missing.
  const std::string* parameter(const std::string& path) const;
  /// The text of a swept value, or of any parameter; empty if the point has none.
  std::string value(const std::string& path) const;
};

/// Finds points whose results are equal to those of an earlier one: they differ in parameters that
/// change nothing, in wishes of clocks of which the chip makes the same, or in clocks that nothing
/// uses. Of a clock that the design uses the frequency is a result; the wish is not, nor how the
/// PLLs make it.
class Repetitions {
 public:
  /// The first row with these results; `figures` are all that the point has. None if they are new,
  /// or if it has none; new ones become those of `row`.
  std::optional<std::size_t> find(const result::Metrics& figures, std::size_t row);

 private:
  void look_at(const result::Metrics& figures);

  result::Metrics names_;             ///< what the places below are of
  std::vector<std::size_t> results_;  ///< places of all figures but those of clocks
  std::vector<std::pair<std::size_t, std::size_t>> clocks_;  ///< of a frequency, and of its "used"
  std::unordered_map<std::size_t, std::size_t> rows_;        ///< by the hash of the results
};

/// A sweep's results, in the order of its points.
struct Results {
  Manifest manifest;
  std::vector<ResultRow> rows;
  std::uint64_t missing = 0;          ///< points not computed yet
  std::optional<vp::Expression> job;  ///< what the study asks of a point instead of the usual job
  std::vector<vp::Expression> constraints;  ///< what else is asked of a result

  Results() = default;
  /// What a sweep asks of its points, without any.
  explicit Results(const Manifest& asked);
  /// A point, which the same manifest has or had, with all its figures.
  void add(const Manifest& manifest, Point point, Outcome outcome);

  std::uint64_t failed() const;
  /// Whether a part (result::verdict_parts) of the verdict on the point holds.
  result::Holds holds(const ResultRow& row, const std::string& part) const;
  /// The constraints that a point which ran breaks. One on what the point lacks is broken.
  std::vector<const vp::Expression*> broken(const ResultRow& row) const;
  /// Whether all parts and constraints hold: the only rule of what is feasible.
  result::Holds feasible(const ResultRow& row) const;
  /// Why it failed or is not feasible; empty if it is.
  std::vector<std::string> reasons(const ResultRow& row) const;
  /// All metrics of a point, of which its row may have some only.
  result::Metrics metrics_of(const ResultRow& row, Shards::Block& block) const;
  /// The names of all metrics, sorted.
  std::vector<std::string> metric_names() const;
  /// The metrics that do not tell one point from another.
  const result::CommonFigures& common() const { return common_; }
  /// Those that the sweep asks for; all if it does not.
  std::vector<std::string> chosen_metrics() const;

 private:
  friend Results read_results(std::shared_ptr<const Shards> shards, Manifest&& manifest,
                              const std::vector<vp::Expression>& more);

  /// The configurations of the families, which their points share.
  std::vector<std::shared_ptr<const std::map<std::string, std::string>>> bases_;
  std::shared_ptr<const Shards> shards_;        ///< which have all metrics; null: the rows have
  std::vector<std::string> names_;              ///< of all metrics in them
  result::CommonFigures common_;                ///< of all metrics
  std::optional<result::Selection> selection_;  ///< the figures that rows have; none: all
  Repetitions repetitions_;
};

/// Reads the results of a manifest's points, which become the rows. Of a million points not all
/// figures fit into memory: rows have those that the sweep asks for, and that `more` is made of.
/// Throws vp::InputError for a damaged point.
Results read_results(std::shared_ptr<const Shards> shards, Manifest&& manifest,
                     const std::vector<vp::Expression>& more = {});

/// Throws vp::InputError for a name in `expression` that no point has a value of, with the nearest.
void check_names(const Results& results, const vp::Expression& expression);

/// The first name in `expression` that this point has no value of; null if it has all.
const std::string* missing_in(const ResultRow& row, const vp::Expression& expression);

/// What a name means for a point that has it: a metric, a parameter, or system and inputs.
vp::ExpressionValue value_in(const ResultRow& row, const std::string& name);

/// What the expression comes to for this point; none if the point has no value of a name in it, or
/// it divides by zero.
std::optional<double> figure_in(const ResultRow& row, const vp::Expression& expression);

/// One line a point: key, status, message, feasible, same_as (the key of the point that it is,
/// too), the swept parameters, the metrics. Throws vp::OutputError.
void write_csv(const std::string& path, const Results& results);

/// How many points are feasible, and how many fail each part of the verdict: "3 of 12 points
/// feasible, 2 did not run, 7 miss timing".
std::string verdicts_text(const Results& results);

/// "same as 75 MHz": of a point that an earlier one is, too, the values in which that differs; else
/// empty.
std::string repetition_text(const Results& results, const ResultRow& row);

/// Writes the results as a SQLite database, anew:
///
///   points(key, position, status, exit_code, signal, message, program, inputs, feasible, same_as)
///   parameters(key, path, value, number)  those that differ between points; number in base units
///   constants(path, value)                those that all points share
///   metrics(key, name, value)             a view of metric_names, whose `value` all points that
///   ran
///                                         share, or of metric_values, with 64 of the others a row
///   runs(key, engine, host, date, attempt, wall_s, cpu_s)
///     only the key is known of results that an earlier version left (adopt_kept())
///   sweep(name, value)                    its title, file, program version
///
/// Throws vp::OutputError.
void write_database(const std::string& path, const Results& results, const Shards& shards);

}  // namespace platform::study
