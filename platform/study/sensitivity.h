#pragma once

#include <optional>
#include <string>
#include <vector>

#include <study/pareto.h>
#include <study/plan.h>
#include <study/results.h>
#include <vp/expression.h>

namespace platform::study {

/// How much one parameter moves a figure.
struct Sensitivity {
  std::string path;       ///< joined by '+' if several move together
  std::size_t count = 0;  ///< effects, values or comparisons that it was found from
  /// Morris: mean of the elementary effects, of their sizes, and their deviation. An effect is the
  /// figure's change over the whole range of the parameter. All else equal: `mean_size` is the mean
  /// of the changes.
  double mean = 0;
  double mean_size = 0;
  double deviation = 0;
  /// One at a time: lowest and highest value of the figure, and where. All else equal: those of the
  /// comparison with the largest change.
  double low = 0;
  double high = 0;
  std::string low_at;
  std::string high_at;

  double swing() const { return high - low; }
  /// What the parameters are compared by.
  double size() const { return mean_size > 0 ? mean_size : swing(); }
};

struct SensitivityReport {
  /// "morris", "one-at-a-time", or "all else equal" of any other sweep
  std::string method;
  std::string basis;              ///< what it rests on, in words
  std::vector<Sensitivity> rows;  ///< the strongest first
  /// Parameters that nothing can be said of: no two points differ in one of them alone.
  std::vector<std::string> not_compared;
  std::size_t skipped = 0;  ///< effects, or points, left out: a point is not feasible, is missing
                            ///< or has no value of the figure
};

/// How the figure depends on each swept parameter: Morris' elementary effects or a tornado, if the
/// sweep was made for it. Otherwise the points choose themselves in part: a search looks near its
/// best ones, and points that are not feasible do not count. A mean over those with one value would
/// mix what the other parameters do into it. So only points are compared that differ in one
/// parameter alone (or in those that move together), and a comparison's change is between the
/// lowest and the highest of them. Throws vp::InputError, which says what to run instead, where
/// no points are so; also for a metric that no point has. `all`: points that ran count even if they
/// are not feasible.
SensitivityReport sensitivity(const Results& results, const vp::Expression& figure,
                              bool all = false);

/// Says of which parameters it can say nothing, and what to run instead; empty: it says all.
std::string not_compared_text(const SensitivityReport& report);

std::string sensitivity_table(const SensitivityReport& report);
std::string sensitivity_csv(const std::string& figure, const SensitivityReport& report);
/// For the page: {"metric", "basis", "rows": [{"path", "count", "size", "low", "low_at", "high",
/// "high_at"}], "note"}. Without rows the note says why. "low" to "high_at" are not there for
/// Morris.
Json sensitivity_json(const Results& results, const vp::Expression& figure);

/// One parameter of a point, or several that move together, one step away.
struct Step {
  std::string path;  ///< joined by '+' if they are several
  std::string from, to;
  Assignment point;  ///< the whole of it
};

/// A step down and one up for each parameter of the space, from `at`: of a list the neighbours, of
/// a range without step a twentieth of it, of words each other one. Points that constraints on
/// parameters rule out are left out.
std::vector<Step> steps_from(const Space& space, const Assignment& at);

/// What steps change.
struct StepEffects {
  struct Row {
    Step step;
    std::vector<std::optional<double>> changes;  ///< of each figure
    std::string trouble;                         ///< why the point is not feasible; empty: it is
    double strength = 0;  ///< the largest change, in parts of the point's figure
  };

  std::vector<vp::Expression> figures;
  std::vector<std::optional<double>> base;  ///< the point's
  std::vector<Row> rows;                    ///< the strongest first
};

/// `results` has the point, then the steps in their order.
StepEffects effects_of(const std::vector<Step>& steps, const Results& results,
                       const std::vector<vp::Expression>& figures);

std::string effects_table(const StepEffects& effects);
std::string effects_csv(const StepEffects& effects);
/// For the page: {"key", "figures": [{"path", "unit", "base"}], "rows": [{"path", "from", "to",
/// "changes": [number or null…], "trouble"}]}.
Json effects_json(const StepEffects& effects, const std::string& key);

}  // namespace platform::study
