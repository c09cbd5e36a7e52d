#include <study/explore/explore.h>

#include <result/console.h>
#include <result/metrics.h>
#include <result/table.h>
#include <result/verdict.h>
#include <study/report.h>
#include <vp/error.h>
#include <vp/text.h>
#include <vp/unit.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace platform::explore {

namespace {

/// Of a point that did not run: farther than any that did.
constexpr double did_not_run = 100;
/// Of what should be above a number, and is that number.
constexpr double least_shortfall = 1e-9;
/// A front in more dimensions cannot be read.
constexpr std::size_t most_objectives = 4;
/// A hypervolume that grew by less did not gain.
constexpr double least_gain = 0.001;

/// Where few points are allowed, so many are looked at until one is.
constexpr std::size_t allowed_generation = 50;
constexpr int allowed_generations = 200;

const char* const part_prefix = "verdict.";

double shortfall_of(const vp::Expression& asked, const vp::Expression::Lookup& lookup) {
  return asked.holds(lookup) ? 0 : std::max(least_shortfall, asked.shortfall(lookup));
}

}  // namespace

Requirement Requirement::part(const std::string& name) {
  Requirement requirement;
  requirement.text_ = part_prefix + name;
  return requirement;
}

Requirement Requirement::constraint(const vp::Expression& expression) {
  Requirement requirement;
  requirement.text_ = expression.text();
  requirement.expression_ = expression;
  return requirement;
}

double Requirement::shortfall(const study::Results& results, const study::ResultRow& row) const {
  const auto lookup = [&](const std::string& name) { return study::value_in(row, name); };
  const auto of = [&](const vp::Expression& asked) {
    return missing_in(row, asked) ? 1 : shortfall_of(asked, lookup);
  };
  if (expression_) return of(*expression_);
  const std::string part = text_.substr(std::string(part_prefix).size());
  if (results.holds(row, part) == result::Holds::yes) return 0;
  if (part == "job" && results.job) return of(*results.job);
  const double* margin = row.metrics.find(text_ + ".margin_percent");
  return margin != nullptr && *margin < 0 ? -*margin / 100 : 1;
}

std::string to_string(End end) {
  switch (end) {
    case End::points:
      return "all its points are used";
    case End::time:
      return "its time is up";
    case End::infeasible:
      return "no point is feasible";
    case End::no_gain:
      return "no gain any more";
    case End::exhausted:
      return "no other point was found";
    case End::failed:
      return "no point ran";
    case End::interrupted:
      break;
  }
  return "interrupted";
}

namespace {

Coordinate coordinate_of(const study::AxisGroup& group) {
  const study::AxisValues& axis = group.front();
  return {axis.ordered() ? 0 : static_cast<std::uint32_t>(axis.values().size())};
}

}  // namespace

Explorer::Explorer(study::Space& space, Budget budget, Compute compute, OnGeneration on_generation)
    : space_(space),
      choice_(space.spec().search),
      budget_(std::move(budget)),
      compute_(std::move(compute)),
      on_generation_(std::move(on_generation)) {
  study::Manifest& manifest = space.manifest();
  if (manifest.objectives.empty())
    manifest.objectives = {study::usual_objectives.begin(), study::usual_objectives.end()};
  // A point that one of them gave way for is not feasible.
  for (const vp::Expression& condition : space.conditions())
    manifest.constraints.push_back(condition.text());
  for (const std::string& text : manifest.objectives)
    goal_.objectives.emplace_back(text, space.spec().origin + ": objectives");
  results_ = study::Results(manifest);
  for (const char* part : result::verdict_parts)
    goal_.requirements.push_back(Requirement::part(part));
  for (const vp::Expression& constraint : results_.constraints)
    goal_.requirements.push_back(Requirement::constraint(constraint));
  for (const study::AxisGroup& group : space.groups()) coordinates_.push_back(coordinate_of(group));
  check();
}

void Explorer::check() const {
  const std::string start = space_.spec().origin + ": ";
  if (goal_.objectives.size() > most_objectives)
    throw vp::InputError(start + "a search has at most " + std::to_string(most_objectives) +
                         " objectives: make a constraint of those that need only be good enough");
  if (space_.size() == 1)
    throw vp::InputError(start +
                         "the space has one point, so there is nothing to search: "
                         "'markervp sweep' computes it; give parameters more values");
}

void Explorer::check_first_generation() const {
  for (const study::Objective& objective : goal_.objectives) {
    const auto has_it = [&](const study::ResultRow& row) {
      return study::figure_in(row, objective.figure()).has_value();
    };
    if (std::any_of(results_.rows.begin(), results_.rows.end(), has_it)) continue;
    throw vp::InputError(space_.spec().origin + ": none of the first " +
                         result::counted(results_.rows.size(), "point") + " has a value of '" +
                         objective.figure().text() +
                         "': take another objective ('markervp metrics'), or inputs that give it");
  }
}

study::Assignment Explorer::assignment(const Genome& genome) const {
  study::Assignment point;
  for (std::size_t i = 0; i < genome.size(); ++i) {
    for (const study::AxisValues& axis : space_.groups()[i]) {
      point.emplace_back(axis.path(), coordinates_[i].choices == 0
                                          ? axis.sampled(genome[i])
                                          : axis.values()[static_cast<std::size_t>(genome[i])]);
    }
  }
  return point;
}

/// By how much a point breaks the constraints on parameters; 0: the search may have it.
double Explorer::broken_conditions(const study::Assignment& point, const Goal& goal) const {
  const auto lookup = [&](const std::string& name) { return space_.value(point, name); };
  double sum = 0;
  for (const vp::Expression& condition : space_.conditions()) {
    const bool given_up = goal.given_up && goal.given_up->text() == condition.text();
    if (!given_up) sum += shortfall_of(condition, lookup);
  }
  return sum;
}

bool Explorer::take(const Genome& genome, const Goal& goal) {
  const study::Assignment found = assignment(genome);
  if (broken_conditions(found, goal) > 0) return false;
  std::string name;
  for (const auto& [path, value] : found) name += value.text() + '\n';
  if (!offered_.insert(name).second) return false;
  study::Point point = space_.point(found);
  // Different values may be the same point: clocks are those that a chip has.
  if (!keys_.insert(point.key).second) return false;
  space_.manifest().points.push_back(std::move(point));
  genomes_.push_back(genome);
  return true;
}

/// Points that constraints on parameters allow are few: a search for them, which computes nothing.
std::size_t Explorer::take_any(const Goal& goal, std::uint64_t most) {
  Search search(coordinates_, allowed_generation, choice_.seed);
  std::size_t taken = 0;
  for (int i = 0; i < allowed_generations && taken == 0; ++i) {
    std::vector<Genome> generation;
    search.breed(allowed_generation, [&](const Genome& genome) {
      generation.push_back(genome);
      return true;
    });
    for (const Genome& genome : generation) {
      const double broken = broken_conditions(assignment(genome), goal);
      if (broken == 0 && taken < most && take(genome, goal)) ++taken;
      search.judge(genome, {{0}, broken});
    }
    search.select();
  }
  return taken;
}

/// False: interrupted. Then the points without an outcome are forgotten.
bool Explorer::compute_taken() {
  std::vector<study::Point>& points = space_.manifest().points;
  const std::size_t first = results_.rows.size();
  std::vector<std::size_t> positions;
  for (std::size_t i = first; i < points.size(); ++i) positions.push_back(i);
  const std::map<std::size_t, study::Outcome> outcomes = compute_(positions);
  std::size_t kept = first;
  for (const std::size_t position : positions) {
    const auto found = outcomes.find(position);
    if (found == outcomes.end()) continue;
    if (kept != position) {
      points[kept] = std::move(points[position]);
      genomes_[kept] = std::move(genomes_[position]);
    }
    results_.add(space_.manifest(), points[kept++], found->second);
  }
  const bool whole = kept == points.size();
  points.resize(kept);
  genomes_.resize(kept);
  return whole;
}

double Explorer::violation(const Goal& goal, const study::ResultRow& row) const {
  if (row.failed) return did_not_run;
  double sum = 0;
  for (const Requirement& requirement : goal.requirements) {
    if (goal.given_up && goal.given_up->text() == requirement.text()) continue;
    sum += requirement.shortfall(results_, row);
  }
  return sum;
}

Judgement Explorer::judgement(const Goal& goal, const study::ResultRow& row) const {
  Judgement judgement;
  judgement.violation = violation(goal, row);
  if (judgement.violation > 0) return judgement;
  if (goal.given_up) {
    judgement.costs = {goal.given_up->shortfall(results_, row)};
    return judgement;
  }
  for (const study::Objective& objective : goal.objectives) {
    const std::optional<double> figure = study::figure_in(row, objective.figure());
    // What cannot be compared is as good as a point that did not run.
    if (!figure) return {{}, did_not_run};
    judgement.costs.push_back(objective.maximise() ? -*figure : *figure);
  }
  return judgement;
}

const study::ResultRow* Explorer::least_violating() const {
  const study::ResultRow* least = nullptr;
  double violated = did_not_run;
  for (const study::ResultRow& row : results_.rows) {
    const double here = violation(goal_, row);
    if (here >= violated) continue;
    least = &row;
    violated = here;
  }
  return least;
}

namespace {

/// Whether the front is still getting better.
class Gain {
 public:
  explicit Gain(std::uint32_t patience) : patience_(patience) {}

  /// After each generation. True: none for as many generations as anybody waits.
  bool is_over(const Front& front) {
    const bool feasible = front.size() != 0;
    const double now = front.hypervolume();
    const bool gained = feasible ? now - front.hypervolume_of(costs_) > least_gain * now
                                 : front.violation() < violation_ * (1 - least_gain);
    if (gained) {
      costs_ = front.costs();
      violation_ = front.violation();
      without_ = 0;
    } else {
      ++without_;
    }
    return without_ >= patience_;
  }

 private:
  std::uint32_t patience_;
  std::uint32_t without_ = 0;
  std::vector<std::vector<double>> costs_;
  double violation_ = std::numeric_limits<double>::infinity();
};

/// Of the budget; the rest is for finding out what would have to give way.
constexpr double part_while_infeasible = 0.5;

/// Which limit of the budget is reached, if any.
std::optional<End> end_of(const Budget& budget, std::uint64_t looked_at) {
  if (looked_at >= budget.points()) return End::points;
  if (budget.time_is_over()) return End::time;
  return std::nullopt;
}

}  // namespace

bool Explorer::has_feasible_point() const {
  return std::any_of(results_.rows.begin(), results_.rows.end(), [&](const study::ResultRow& row) {
    return judgement(goal_, row).violation == 0;
  });
}

End Explorer::explore() {
  return search(goal_, budget_, budget_.share(part_while_infeasible, results_.rows.size()));
}

End Explorer::search(const Goal& goal, const Budget& whole, const Budget& while_infeasible) {
  Search search(coordinates_, choice_.generation, choice_.seed);
  Gain gain(choice_.patience);
  front_ = Front();
  const auto judge = [&](std::size_t from) {
    for (std::size_t i = from; i < results_.rows.size(); ++i) {
      const Judgement found = judgement(goal, results_.rows[i]);
      front_.add(found);
      search.judge(genomes_[i], found);
    }
    if (from != results_.rows.size()) search.select();
  };
  judge(0);
  for (;;) {
    const std::size_t first = results_.rows.size();
    if (const std::optional<End> end = end_of(whole, first)) return *end;
    const Budget& budget = front_.size() == 0 ? while_infeasible : whole;
    if (end_of(budget, first)) return End::infeasible;
    std::size_t taken =
        search.breed(std::min<std::size_t>(choice_.generation, budget.points() - first),
                     [&](const Genome& genome) { return take(genome, goal); });
    if (taken == 0 && first == 0) taken = take_any(goal, budget.points());
    if (taken == 0 && first == 0)
      throw vp::InputError(space_.spec().origin +
                           ": no point is left: the constraints contradict each other or the "
                           "values");
    if (taken == 0) return End::exhausted;
    if (!compute_taken()) {
      judge(first);
      return end_of(whole, 0).value_or(End::interrupted);
    }
    if (first == 0 && results_.failed() == results_.rows.size()) return End::failed;
    if (first == 0) check_first_generation();
    judge(first);
    if (on_generation_) on_generation_(results_.rows.size(), front_);
    if (gain.is_over(front_)) return End::no_gain;
  }
}

namespace {

/// What could give way. A design that does not run or not do its usual job is none.
std::vector<Requirement> candidates(const Explorer& explorer) {
  const std::vector<vp::Expression>& conditions = explorer.space().conditions();
  std::vector<Requirement> found;
  const study::Results& results = explorer.results();
  for (const Requirement& requirement : explorer.goal().requirements) {
    const bool usual_job = requirement.text() == "verdict.job" && !results.job;
    if (requirement.text() == "verdict.ran" || usual_job) continue;
    const auto breaks = [&](const study::ResultRow& row) {
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

/// The point that meets all but this, and needs the least of it; null if missing.
const study::ResultRow* nearest(const Explorer& explorer, const Goal& goal) {
  const study::ResultRow* best = nullptr;
  double least = 0;
  for (const study::ResultRow& row : explorer.results().rows) {
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
        metric != nullptr ? result::readable(*metric) : relaxation.row.value(name);
    if (!value.empty()) parts.push_back(name + " = " + value);
  }
  return vp::join(parts, ", ");
}

}  // namespace

Relaxations relaxations(Explorer& explorer, const std::function<bool()>& may_continue) {
  Relaxations result;
  const std::vector<Requirement> asked = candidates(explorer);
  result.asked = !asked.empty();
  for (std::size_t i = 0; i < asked.size() && !explorer.has_feasible_point(); ++i) {
    if (!may_continue()) {
      result.cut_short = true;
      break;
    }
    Goal goal = explorer.goal();
    goal.given_up = asked[i];
    const double part = 1.0 / static_cast<double>(asked.size() - i);
    const End end =
        explorer.search(goal, explorer.budget().share(part, explorer.results().rows.size()));
    result.cut_short |= end != End::no_gain && end != End::exhausted;
    if (const study::ResultRow* row = nearest(explorer, goal))
      result.found.push_back({asked[i], *row, asked[i].shortfall(explorer.results(), *row)});
  }
  std::stable_sort(
      result.found.begin(), result.found.end(),
      [](const Relaxation& a, const Relaxation& b) { return a.shortfall < b.shortfall; });
  return result;
}

std::string text_of(const Explorer& explorer, const Relaxations& relaxations) {
  if (!relaxations.asked)
    return "No constraint causes this: the points that were looked at do not run, or do not do "
           "their job.\n";
  if (relaxations.found.empty() && relaxations.cut_short)
    return "The search ended before it found a point that breaks only one constraint or part of "
           "the verdict: more points or time may find one.\n";
  if (relaxations.found.empty())
    return "No single constraint causes this: at least two would have to give way.\n";
  std::string text = "It takes one of these, all else kept, the least first:\n";
  for (const Relaxation& relaxation : relaxations.found) {
    std::vector<std::string> values;
    for (const std::string& path : explorer.space().manifest().swept)
      values.push_back(path + " = " + relaxation.row.value(path));
    text += "'" + relaxation.given_up.text() + "' gives way to " + figures(relaxation) + " (" +
            vp::join(values, ", ") + ").\n";
  }
  if (relaxations.cut_short)
    text += "The budget ended these searches: more points or time may find less to give up.\n";
  return text;
}

Answer answer(Explorer& explorer, const std::function<bool()>& may_continue) {
  Answer answer;
  answer.end = explorer.explore();
  const bool broke_off = answer.end == End::failed || answer.end == End::interrupted;
  if (explorer.has_feasible_point() || broke_off) return answer;
  Relaxations found = relaxations(explorer, may_continue);
  // What was kept for the relaxations is free again.
  const bool nothing_to_relax = !found.asked && answer.end == End::infeasible;
  if (explorer.has_feasible_point() || nothing_to_relax)
    answer.end = explorer.search(explorer.goal(), explorer.budget());
  if (explorer.has_feasible_point()) return answer;
  if (nothing_to_relax) found = relaxations(explorer, may_continue);
  answer.end = end_of(explorer.budget(), explorer.results().rows.size()).value_or(answer.end);
  answer.relaxations = std::move(found);
  return answer;
}

}  // namespace platform::explore
