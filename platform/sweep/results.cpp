#include <sweep/results.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include <page/sweep_block.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::sweep {

namespace {

using Bases = std::vector<std::shared_ptr<const std::map<std::string, std::string>>>;

Bases bases_of(const Manifest& manifest) {
  Bases bases;
  for (const Family& family : manifest.families)
    bases.push_back(
        std::make_shared<const std::map<std::string, std::string>>(family.configuration));
  return bases;
}

ResultRow row_of(const Manifest& manifest, const Bases& bases, const PlannedPoint& point,
                 Outcome outcome) {
  ResultRow row;
  static_cast<Outcome&>(row) = std::move(outcome);
  row.key = point.key;
  row.swept = point.swept;
  row.base = bases[point.family];
  row.changes = point.changes;
  row.program = manifest.families[point.family].contents.value("program", "");
  row.inputs = vp::join(manifest.input_sets[point.input_set].inputs, "+");
  return row;
}

/// `outcome(position)` says what there is of a point, or nothing.
template <class OutcomeAt>
Results results_of(Manifest&& manifest, const OutcomeAt& outcome) {
  Results results;
  if (!manifest.job.empty()) results.job.emplace(manifest.job, manifest.name);
  const Bases bases = bases_of(manifest);
  results.rows.reserve(manifest.points.size());
  for (std::size_t i = 0; i < manifest.points.size(); ++i) {
    std::optional<Outcome> found = outcome(i);
    if (!found) {
      ++results.missing;
      continue;
    }
    if (!results.rows.empty()) found->metrics.share_names(results.rows.back().metrics);
    results.rows.push_back(row_of(manifest, bases, manifest.points[i], *std::move(found)));
  }
  results.manifest = std::move(manifest);
  return results;
}

bool has(const ResultRow& row, const std::string& name) {
  return row.metrics.find(name) || !row.value(name).empty();
}

}  // namespace

const std::string* ResultRow::parameter(const std::string& path) const {
  const auto changed = changes.find(path);
  if (changed != changes.end()) return &changed->second;
  if (!base) return nullptr;
  const auto found = base->find(path);
  return found == base->end() ? nullptr : &found->second;
}

std::string ResultRow::value(const std::string& path) const {
  for (const auto& [name, text] : swept) {
    if (name == path) return text;
  }
  if (const std::string* text = parameter(path)) return *text;
  return path == "inputs" ? inputs : path == "system" || path == "program" ? program : "";
}

std::uint64_t Results::failed() const {
  return std::count_if(rows.begin(), rows.end(), [](const ResultRow& row) { return row.failed; });
}

report::Holds Results::holds(const ResultRow& row, const std::string& part) const {
  if (part == "ran" && row.failed) return report::Holds::no;
  if (part == "job" && job && !row.metrics.empty()) {
    const auto lookup = [&](const std::string& name) { return value_in(row, name); };
    return !missing_in(row, *job) && job->holds(lookup) ? report::Holds::yes : report::Holds::no;
  }
  const double* found = row.metrics.find("verdict." + part + ".holds");
  if (!found || (*found > 0 && *found < 1)) return report::Holds::unknown;
  return *found == 0 ? report::Holds::no : report::Holds::yes;
}

report::Holds Results::feasible(const ResultRow& row) const {
  report::Holds worst = report::Holds::yes;
  for (const char* part : report::verdict_parts) worst = std::min(worst, holds(row, part));
  return worst;
}

std::vector<std::string> Results::metric_names() const {
  std::set<std::string> names;
  const Metrics* before = nullptr;
  for (const ResultRow& row : rows) {
    if (before && row.metrics.shares_names(*before)) continue;
    names.insert(row.metrics.names().begin(), row.metrics.names().end());
    before = &row.metrics;
  }
  return {names.begin(), names.end()};
}

std::vector<std::string> Results::chosen_metrics() const {
  return manifest.metrics.empty() ? metric_names() : manifest.metrics;
}

Outcome outcome_of(const PointRecord& record) {
  Outcome outcome;
  outcome.failed = record.failed();
  if (outcome.failed) {
    const Json& failure = record.outcome.at("failure");
    outcome.failure = {failure.value("exit_code", -1), failure.value("signal", 0),
                       failure.value("message", "")};
  }
  if (record.outcome.contains("result")) outcome.metrics = metrics_of(record.outcome.at("result"));
  outcome.row = page::point_row(record.outcome);
  return outcome;
}

Results read_results(const Store& store, Manifest manifest) {
  return results_of(std::move(manifest), [&](std::size_t position) -> std::optional<Outcome> {
    const std::string& key = manifest.points[position].key;
    if (!store.has(key)) return std::nullopt;
    return outcome_of(store.read(key));
  });
}

Results read_results(const Store& store, Manifest manifest,
                     const std::map<std::size_t, Outcome>& known) {
  return results_of(std::move(manifest), [&](std::size_t position) -> std::optional<Outcome> {
    const auto found = known.find(position);
    if (found != known.end()) return found->second;
    const std::string& key = manifest.points[position].key;
    if (!store.has(key)) return std::nullopt;
    return outcome_of(store.read(key, false));
  });
}

void check_names(const Results& results, const Expression& expression, const std::string& where) {
  if (results.failed() == results.rows.size()) return;  // then nobody knows what there would be
  std::vector<std::string> known = results.metric_names();
  if (results.rows.front().base) {
    for (const auto& [path, unused] : *results.rows.front().base) known.push_back(path);
  }
  for (const std::string& name : expression.names()) {
    const auto has_it = [&](const ResultRow& row) { return has(row, name); };
    if (std::find(known.begin(), known.end(), name) != known.end() ||
        std::any_of(results.rows.begin(), results.rows.end(), has_it))
      continue;
    const std::string nearest = vp::nearest_match(name, known);
    throw vp::InputError(
        where + ": unknown metric '" + name + "': " +
        (nearest.empty() ? "sweep.csv has their names" : "did you mean '" + nearest + "'?"));
  }
}

const std::string* missing_in(const ResultRow& row, const Expression& expression) {
  const auto& names = expression.names();
  const auto missing = std::find_if(names.begin(), names.end(),
                                    [&](const std::string& name) { return !has(row, name); });
  return missing == names.end() ? nullptr : &*missing;
}

Value value_in(const ResultRow& row, const std::string& name) {
  Value value;
  if (const double* metric = row.metrics.find(name)) {
    value.number = *metric;
    return value;
  }
  const std::string text = row.value(name);
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

}  // namespace platform::sweep
