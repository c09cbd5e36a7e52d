#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sweep/pareto.h>
#include <sweep/plan.h>
#include <sweep/results.h>
#include <vp/expression.h>

namespace platform::sweep {

/// How much one parameter moves a figure.
struct Sensitivity {
  std::string path;
  std::size_t count = 0;  ///< effects, or values, it was found from
  /// Morris: mean of the elementary effects, of their sizes, and their deviation. An effect is the
  /// figure's change over the whole range of the parameter.
  double mean = 0;
  double mean_size = 0;
  double deviation = 0;
  /// The others: lowest and highest value of the figure, and where.
  double low = 0;
  double high = 0;
  std::string low_at;
  std::string high_at;

  double swing() const { return high - low; }
};

struct SensitivityReport {
  std::string method;  ///< "morris", "one-at-a-time", or "main effects" of any other sweep
  double base = 0;     ///< the figure at the base point, or its mean
  std::vector<Sensitivity> rows;  ///< the strongest first
  std::size_t skipped = 0;  ///< effects, or points, left out: a point is not feasible, is missing
                            ///< or has no value of the figure
};

/// How the figure depends on each swept parameter: Morris' elementary effects or a tornado, if the
/// sweep was made for it; otherwise main effects (the mean of the figure for each value). Throws
/// vp::InputError for a metric that no point has, or too few points. `all`: points that ran count
/// even if they are not feasible.
SensitivityReport sensitivity(const Results& results, const vp::Expression& figure,
                              bool all = false);

std::string sensitivity_table(const SensitivityReport& report);
std::string sensitivity_csv(const std::string& figure, const SensitivityReport& report);

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

}  // namespace platform::sweep
