#pragma once

#include <string>
#include <vector>

namespace platform::sweep {

/// Metrics of one kind: what they count, and in what.
struct MetricKind {
  /// `*` stands for a name, or several with dots between: "power.modules.*.w".
  const char* pattern;
  const char* unit;     ///< empty: a count or a truth
  const char* meaning;  ///< a phrase
};

/// All that a result may have. Those of frames stand here without their end: ".mean", ".max".
const std::vector<MetricKind>& metric_kinds();

/// Null if no result has a metric of this name.
const MetricKind* kind_of_metric(const std::string& name);

/// The unit of an expression that is one metric; empty for any other.
std::string unit_of_metric(const std::string& text);

/// Throws vp::InputError for a name that is neither a metric nor one of `others`: "unknown metric
/// 'x'; did you mean 'y'?".
void check_metric(const std::string& name, const std::vector<std::string>& others);

/// The kinds whose pattern has `part` in it, or that have a metric of that name, as a table; empty:
/// all. Throws vp::InputError with the nearest if there is none.
std::string metric_table(const std::string& part);

}  // namespace platform::sweep
