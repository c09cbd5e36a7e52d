#include <sweep/results_csv.h>

#include <sweep/csv_line.h>

namespace platform::sweep {

std::string results_csv(const Results& results) {
  const std::vector<std::string> metrics = results.chosen_metrics();
  std::vector<std::string> head{"key", "status", "message"};
  head.insert(head.end(), results.manifest.swept.begin(), results.manifest.swept.end());
  head.insert(head.end(), metrics.begin(), metrics.end());
  std::string text = csv_line(head);
  for (const ResultRow& row : results.rows) {
    std::vector<std::string> fields{row.key, row.failed ? "failed" : "done", row.failure.message};
    for (const std::string& path : results.manifest.swept) fields.push_back(row.value(path));
    for (const std::string& name : metrics) {
      const double* found = row.metrics.find(name);
      fields.push_back(found ? csv_number(*found) : "");
    }
    text += csv_line(fields);
  }
  return text;
}

}  // namespace platform::sweep
