#pragma once

#include <string>
#include <vector>

#include <sweep/pareto.h>
#include <sweep/results.h>

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

}  // namespace platform::sweep
