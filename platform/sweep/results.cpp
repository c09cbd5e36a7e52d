#include <sweep/results.h>

#include <algorithm>
#include <set>

#include <vp/error.h>
#include <vp/text.h>

namespace platform::sweep {

namespace {

ResultRow row_of(const Manifest& manifest, const PlannedPoint& point, const PointRecord& record) {
  ResultRow row;
  row.key = point.key;
  row.swept = point.swept;
  row.configuration = manifest.configuration(point);
  row.program = manifest.families[point.family].contents.value("program", "");
  row.inputs = vp::join(manifest.input_sets[point.input_set].inputs, "+");
  row.failed = record.failed();
  if (row.failed) {
    const Json& failure = record.outcome.at("failure");
    row.failure = {failure.value("exit_code", -1), failure.value("signal", 0),
                   failure.value("message", "")};
  }
  if (record.outcome.contains("result")) row.metrics = metrics_of(record.outcome.at("result"));
  return row;
}

}  // namespace

std::string ResultRow::value(const std::string& path) const {
  for (const auto& [name, text] : swept) {
    if (name == path) return text;
  }
  const auto found = configuration.find(path);
  if (found != configuration.end()) return found->second;
  return path == "inputs" ? inputs : path == "system" || path == "program" ? program : "";
}

std::uint64_t Results::failed() const {
  return std::count_if(rows.begin(), rows.end(), [](const ResultRow& row) { return row.failed; });
}

std::vector<std::string> Results::metric_names() const {
  std::set<std::string> names;
  for (const ResultRow& row : rows) {
    for (const auto& [name, value] : row.metrics) names.insert(name);
  }
  return {names.begin(), names.end()};
}

std::vector<std::string> Results::chosen_metrics() const {
  return manifest.metrics.empty() ? metric_names() : manifest.metrics;
}

Results read_results(const Store& store, Manifest manifest, bool verify) {
  Results results;
  for (const PlannedPoint& point : manifest.points) {
    if (!store.has(point.key)) {
      ++results.missing;
      continue;
    }
    results.rows.push_back(row_of(manifest, point, store.read(point.key, verify)));
  }
  results.manifest = std::move(manifest);
  return results;
}

Value value_in(const Results& results, const ResultRow& row, const std::string& name,
               const std::string& where) {
  Value value;
  const auto metric = row.metrics.find(name);
  if (metric != row.metrics.end()) {
    value.number = metric->second;
    return value;
  }
  const std::string text = row.value(name);
  if (!text.empty()) {
    const ParameterKind kind = kind_of({name, text, text, "", {}, ""});
    if (kind.kind == ParameterKind::Kind::quantity) {
      value.number = number_of(kind, text);
      value.unit = kind.unit;
    } else {
      value.is_text = true;
      value.text = text;
    }
    return value;
  }
  std::vector<std::string> known = results.metric_names();
  for (const auto& [path, unused] : row.configuration) known.push_back(path);
  if (std::find(known.begin(), known.end(), name) != known.end()) {
    throw vp::InputError(where + ": point " + row.key + " has no '" + name + "'");
  }
  const std::string nearest = vp::nearest_match(name, known);
  throw vp::InputError(
      where + ": unknown metric '" + name +
      "': " + (nearest.empty() ? "sweep.csv has their names" : "did you mean '" + nearest + "'?"));
}

}  // namespace platform::sweep
