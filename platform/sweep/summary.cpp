#include <sweep/summary.h>

#include <algorithm>
#include <map>

#include <report/words.h>
#include <sweep/objective.h>
#include <sweep/text_table.h>

namespace platform::sweep {

namespace {

/// Columns that fit a terminal.
constexpr std::size_t most_metrics = 6;
/// Reasons of failure that are printed.
constexpr std::size_t most_reasons = 8;

/// The figures that the sweep is about: its metrics, else those of its objectives, else the
/// speed. Those that no result has are left out.
std::vector<std::string> key_figures(const Results& results) {
  std::vector<std::string> wanted = results.manifest.metrics;
  if (wanted.empty()) {
    for (const std::string& objective : results.manifest.objectives) {
      const Objective parsed(objective, results.manifest.name);
      for (const std::string& name : parsed.figure().names()) wanted.push_back(name);
    }
  }
  if (wanted.empty()) wanted = {"summary.fps.mean", "summary.latency_us.mean"};
  const std::vector<std::string> known = results.metric_names();
  std::vector<std::string> figures;
  for (const std::string& name : wanted) {
    if (figures.size() < most_metrics && std::binary_search(known.begin(), known.end(), name))
      figures.push_back(name);
  }
  return figures;
}

std::string failures_text(const Results& results) {
  std::map<std::string, std::uint64_t> reasons;
  for (const ResultRow& row : results.rows) {
    if (row.failed) ++reasons[row.failure.message];
  }
  std::string text;
  std::size_t printed = 0;
  for (const auto& [reason, count] : reasons) {
    if (printed++ == most_reasons) return text + "and other reasons: see sweep.csv\n";
    text += report::counted(count, "point") + " failed: " + reason + "\n";
  }
  return text;
}

}  // namespace

std::string verdicts_text(const Results& results) {
  constexpr std::pair<const char*, const char*> parts[] = {{"ran", "did not run"},
                                                           {"job", "did not do their job"},
                                                           {"fits", "do not fit"},
                                                           {"clocks", "have impossible clocks"},
                                                           {"timing", "miss timing"}};
  const auto count = [&](const auto& wanted) {
    return std::count_if(results.rows.begin(), results.rows.end(), wanted);
  };
  using report::Holds;
  std::string text = std::to_string(count([&](const ResultRow& row) {
                       return results.feasible(row) == Holds::yes;
                     })) +
                     " of " + report::counted(results.rows.size(), "point") + " feasible";
  const auto add = [&](auto number, const std::string& what) {
    if (number != 0) text += ", " + std::to_string(number) + " " + what;
  };
  for (const auto& [part, what] : parts) {
    add(count([&, name = part](const ResultRow& row) {
          return results.holds(row, name) == Holds::no;
        }),
        what);
  }
  add(count([&](const ResultRow& row) { return results.feasible(row) == Holds::unknown; }),
      "unknown");
  return text;
}

std::string sweep_text(const Results& results, std::size_t most_rows) {
  const std::vector<std::string> figures = key_figures(results);
  std::vector<std::string> names = results.manifest.swept;
  names.insert(names.end(), figures.begin(), figures.end());
  TextTable table(short_names(names));
  std::size_t rows = 0;
  for (const ResultRow& row : results.rows) {
    if (rows++ == most_rows) break;
    std::vector<std::string> fields;
    for (const std::string& path : results.manifest.swept) fields.push_back(row.value(path));
    for (const std::string& name : figures) {
      const double* found = row.metrics.find(name);
      const std::string none = row.failed ? "failed" : "-";
      fields.push_back(found ? readable(*found) : none);
    }
    table.add(fields);
  }
  std::string text =
      (results.manifest.title.empty() ? results.manifest.name : results.manifest.title) + "\n\n" +
      table.text();
  if (results.rows.size() > most_rows)
    text += "… and " + report::counted(results.rows.size() - most_rows, "point") +
            " more: see sweep.csv\n";
  const std::string failures = failures_text(results);
  text += "\n" + verdicts_text(results) + "\n";
  if (!failures.empty()) text += "\n" + failures;
  if (!results.manifest.text.empty()) {
    text += "\n" + results.manifest.text;
    if (text.back() != '\n') text += "\n";
  }
  return text;
}

}  // namespace platform::sweep
