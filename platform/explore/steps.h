#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sweep/plan.h>
#include <sweep/results.h>
#include <vp/expression.h>

namespace platform::explore {

/// One parameter of a point, or several that move together, one step away.
struct Step {
  std::string path;  ///< joined by '+' if they are several
  std::string from, to;
  sweep::Assignment point;  ///< the whole of it
};

/// A step down and one up for each parameter of the space, from `at`: of a list the neighbours, of
/// a range without step a twentieth of it, of words each other one. Points that constraints on
/// parameters rule out are left out.
std::vector<Step> steps_from(const sweep::Space& space, const sweep::Assignment& at);

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
StepEffects effects_of(const std::vector<Step>& steps, const sweep::Results& results,
                       const std::vector<vp::Expression>& figures);

std::string effects_table(const StepEffects& effects);
std::string effects_csv(const StepEffects& effects);
/// For the page: {"key", "figures": [{"path", "unit", "base"}], "rows": [{"path", "from", "to",
/// "changes": [number or null…], "trouble"}]}.
sweep::Json effects_json(const StepEffects& effects, const std::string& key);

}  // namespace platform::explore
