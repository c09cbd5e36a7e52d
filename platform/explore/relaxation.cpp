#include <explore/relaxation.h>

#include <algorithm>
#include <utility>

#include <report/console.h>
#include <sweep/report.h>
#include <vp/text.h>

namespace platform::explore {

namespace {

/// Of what the study's own search may take; at least some generations.
constexpr std::uint64_t part_of_points = 4, least_generations = 8;

/// What could give way. A design that does not run or not do its usual job is none.
std::vector<Requirement> candidates(const Explorer& explorer) {
  const std::vector<vp::Expression>& conditions = explorer.space().conditions();
  std::vector<Requirement> found;
  const sweep::Results& results = explorer.results();
  for (const Requirement& requirement : explorer.goal().requirements) {
    const bool usual_job = requirement.text() == "verdict.job" && !results.job;
    if (requirement.text() == "verdict.ran" || usual_job) continue;
    const auto breaks = [&](const sweep::ResultRow& row) {
      return !row.failed && requirement.shortfall(results, row) > 0;
    };
    // No point was computed that breaks one on parameters.
    const bool on_parameters = std::any_of(
        conditions.begin(), conditions.end(),
        [&](const vp::Expression& condition) { return condition.text() == requirement.text(); });
    if (on_parameters || std::any_of(results.rows.begin(), results.rows.end(), breaks))
      found.push_back(requirement);
  }
  return found;
}

/// The point that meets all but this, and needs the least of it; null if there is none.
const sweep::ResultRow* nearest(const Explorer& explorer, const Goal& goal) {
  const sweep::ResultRow* best = nullptr;
  double least = 0;
  for (const sweep::ResultRow& row : explorer.results().rows) {
    if (explorer.violation(goal, row) > 0) continue;
    const double here = goal.given_up->shortfall(explorer.results(), row);
    if (best != nullptr && here >= least) continue;
    best = &row;
    least = here;
  }
  return best;
}

/// What the requirement speaks of, as the point has it: "summary.fps.mean = 179.2".
std::string figures(const Relaxation& relaxation) {
  std::vector<std::string> names;
  if (const vp::Expression* expression = relaxation.given_up.expression()) {
    names = expression->names();
  } else {
    names = {relaxation.given_up.text() + ".margin_percent"};
  }
  std::vector<std::string> parts;
  for (const std::string& name : names) {
    const double* metric = relaxation.row.metrics.find(name);
    const std::string value =
        metric != nullptr ? sweep::readable(*metric) : relaxation.row.value(name);
    if (!value.empty()) parts.push_back(name + " = " + value);
  }
  return vp::join(parts, ", ");
}

}  // namespace

std::vector<Relaxation> relaxations(Explorer& explorer, const std::function<bool()>& go_on) {
  std::vector<Relaxation> found;
  const sweep::SearchChoice& choice = explorer.space().spec().search;
  const std::uint64_t points = std::max<std::uint64_t>(choice.points / part_of_points,
                                                       least_generations * choice.generation);
  for (const Requirement& candidate : candidates(explorer)) {
    if (!go_on()) break;
    Goal goal = explorer.goal();
    goal.given_up = candidate;
    explorer.search(goal, points);
    const sweep::ResultRow* row = nearest(explorer, goal);
    if (row != nullptr)
      found.push_back({candidate, *row, candidate.shortfall(explorer.results(), *row)});
  }
  std::stable_sort(found.begin(), found.end(), [](const Relaxation& a, const Relaxation& b) {
    return a.shortfall < b.shortfall;
  });
  return found;
}

std::string text_of(const Explorer& explorer, const std::vector<Relaxation>& found) {
  if (found.empty())
    return "No single constraint stands in the way: at least two would have to give way.\n";
  std::string text = "It takes one of these, all else kept, the least first:\n";
  for (const Relaxation& relaxation : found) {
    std::vector<std::string> values;
    for (const std::string& path : explorer.space().manifest().swept)
      values.push_back(path + " = " + relaxation.row.value(path));
    text += "'" + relaxation.given_up.text() + "' gives way to " + figures(relaxation) + " (" +
            vp::join(values, ", ") + ").\n";
  }
  return text;
}

}  // namespace platform::explore
