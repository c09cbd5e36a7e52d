#include <result/page/comparison_rows.h>

#include <algorithm>
#include <set>
#include <string>

#include <result/figures.h>
#include <result/metrics.h>

namespace platform::page {

namespace {

using result::Json;

/// The metrics of one figure that either run has.
std::set<std::string> metrics_of(const facts::Figure& figure, const result::Metrics& a,
                                 const result::Metrics& b) {
  std::set<std::string> metrics;
  for (const result::Metrics* run : {&a, &b}) {
    for (const std::string& name : run->names()) {
      if (result::figures().of(name) == &figure) metrics.insert(name);
    }
  }
  return metrics;
}

bool is_largest_of_units(const std::string& metric) {
  const std::string end = ".max";
  return metric.rfind("frames.", 0) == 0 && metric.size() > end.size() &&
         metric.compare(metric.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

Json comparison_rows(const Json& a, const Json& b) {
  const std::string unit = a.value("unit", "frame");
  const result::Metrics left = result::metrics_of(a), right = result::metrics_of(b);
  Json rows = Json::array();
  for (const facts::Figure& figure : result::figures().list()) {
    if (figure.title.empty()) continue;
    const bool is_of_many = figure.path.find('*') != std::string::npos;
    for (const std::string& metric : metrics_of(figure, left, right)) {
      const double *in_a = left.find(metric), *in_b = right.find(metric);
      const bool is_nothing = (!in_a || *in_a == 0) && (!in_b || *in_b == 0);
      if (is_largest_of_units(metric) || (is_of_many && is_nothing)) continue;
      const result::ShownMetric shown = *result::shown_metric(metric, unit);
      const auto value = [&](const double* in_run) {
        return in_run ? Json(*in_run * shown.factor) : Json();
      };
      rows.push_back({{"title", shown.title},
                      {"unit", shown.unit},
                      {"better", shown.better},
                      {"a", value(in_a)},
                      {"b", value(in_b)}});
    }
  }
  return rows;
}

}  // namespace platform::page
