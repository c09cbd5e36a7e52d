#include <sweep/results_csv.h>

#include <sweep/csv_line.h>

namespace platform::sweep {

std::string results_csv(const Results& results) {
  const std::vector<std::string> metrics = results.chosen_metrics();
  std::vector<std::string> head{"key", "status", "message", "feasible"};
  head.insert(head.end(), results.manifest.swept.begin(), results.manifest.swept.end());
  head.insert(head.end(), metrics.begin(), metrics.end());
  std::string text = csv_line(head);
  std::vector<std::size_t> places;  // of the metrics in a row's values
  const Metrics* before = nullptr;
  for (const ResultRow& row : results.rows) {
    if (!before || !row.metrics.shares_names(*before)) {
      places.clear();
      for (const std::string& name : metrics) places.push_back(row.metrics.place_of(name));
    }
    before = &row.metrics;
    std::vector<std::string> fields{row.key, row.failed ? "failed" : "done", row.failure.message,
                                    to_string(results.feasible(row))};
    for (const std::string& path : results.manifest.swept) fields.push_back(row.value(path));
    const std::vector<double>& values = row.metrics.values();
    for (const std::size_t place : places)
      fields.push_back(place < values.size() ? csv_number(values[place]) : "");
    text += csv_line(fields);
  }
  return text;
}

}  // namespace platform::sweep
