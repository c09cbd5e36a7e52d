#include <study/explore/search.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <pagmo/rng.hpp>
#include <pagmo/types.hpp>
#include <pagmo/utils/genetic_operators.hpp>
#include <pagmo/utils/hypervolume.hpp>
#include <pagmo/utils/multi_objective.hpp>
#include <utility>

#include <study/expansion.h>

namespace platform::explore {

/// A genome that was judged.
struct Member {
  Genome genome;
  Judgement judgement;
};

namespace {

using Costs = std::vector<std::vector<double>>;

/// Deb's settings, but for the mutation, which reaches farther: a step must leave its cell of a
/// list.
constexpr double crossover_rate = 0.95, crossover_spread = 10, mutation_spread = 5;
/// Offers for each genome that is wanted, before others are tried.
constexpr std::size_t most_offers = 100;

/// pagmo compares vectors of two figures and more.
std::vector<double> two_or_more(std::vector<double> costs) {
  if (costs.size() == 1) costs.push_back(costs.front());
  return costs;
}

/// By Deb's rule: costs that any feasible genome is below, and the more the more is violated.
Costs ranked_costs(const std::vector<Member>& members) {
  double above = 0;
  std::size_t objectives = 1;
  for (const Member& member : members) {
    objectives = std::max(objectives, member.judgement.costs.size());
    if (member.judgement.violation > 0) continue;
    for (const double cost : member.judgement.costs) above = std::max(above, cost);
  }
  Costs costs;
  for (const Member& member : members) {
    costs.push_back(
        two_or_more(member.judgement.violation > 0
                        ? std::vector<double>(objectives, above + 1 + member.judgement.violation)
                        : member.judgement.costs));
  }
  return costs;
}

}  // namespace

struct Search::State {
  std::vector<std::size_t> order;  ///< of pagmo's coordinates: those without order come last
  std::pair<Genome, Genome> bounds;
  std::size_t choices = 0;  ///< coordinates without order
  std::size_t survivors = 0;
  pagmo::detail::random_engine_type random;
  std::unique_ptr<study::UnitSamples> spread, anywhere;
  std::vector<Member> members;  ///< after select() the best first
  bool judged = false;

  Genome ours(const Genome& theirs) const {
    Genome genome(theirs.size());
    for (std::size_t i = 0; i < theirs.size(); ++i) genome[order[i]] = theirs[i];
    return genome;
  }

  Genome theirs(const Genome& ours) const {
    Genome genome;
    for (const std::size_t i : order) genome.push_back(ours[i]);
    return genome;
  }

  /// From a point of the unit cube.
  Genome at(const std::vector<double>& unit) const {
    Genome genome(unit.size());
    for (std::size_t i = 0; i < unit.size(); ++i) {
      const bool ordered = i < unit.size() - choices;
      const double count = bounds.second[i] + 1;
      genome[i] = ordered ? unit[i] : std::floor(unit[i] * count);
    }
    return ours(genome);
  }

  /// The better of two: the one that precedes the other.
  const Genome& parent() {
    const std::size_t a = random() % members.size(), b = random() % members.size();
    return members[std::min(a, b)].genome;
  }

  std::pair<Genome, Genome> children() {
    auto pair = pagmo::sbx_crossover(theirs(parent()), theirs(parent()), bounds, choices,
                                     crossover_rate, crossover_spread, random);
    const double rate = 1.0 / static_cast<double>(order.size());
    for (Genome* child : {&pair.first, &pair.second})
      pagmo::polynomial_mutation(*child, bounds, choices, rate, mutation_spread, random);
    return {ours(pair.first), ours(pair.second)};
  }
};

Search::Search(std::vector<Coordinate> coordinates, std::size_t survivors, std::uint64_t seed)
    : state_(new State) {
  for (const bool ordered : {true, false}) {
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      if ((coordinates[i].choices == 0) != ordered) continue;
      state_->order.push_back(i);
      state_->bounds.first.push_back(0);
      state_->bounds.second.push_back(ordered ? 1 : coordinates[i].choices - 1.0);
      if (!ordered) ++state_->choices;
    }
  }
  state_->survivors = survivors;
  state_->random.seed(static_cast<std::uint32_t>(seed));
  state_->spread = study::sobol_samples(coordinates.size(), seed * survivors);
  state_->anywhere = study::random_samples(coordinates.size(), seed);
}

Search::~Search() = default;

std::size_t Search::breed(std::size_t wanted, const Take& take) {
  std::size_t taken = 0;
  const auto offer = [&](const Genome& genome) {
    if (taken < wanted && take(genome)) ++taken;
  };
  const std::size_t offers = most_offers * wanted;
  State& state = *state_;
  if (!state.judged) {
    for (std::size_t i = 0; i < offers && taken < wanted; ++i)
      offer(state.at(state.spread->next()));
  } else {
    for (std::size_t i = 0; i < offers / 2 && taken < wanted; ++i) {
      const auto [first, second] = state.children();
      offer(first);
      offer(second);
    }
  }
  for (std::size_t i = 0; i < offers && taken < wanted; ++i)
    offer(state.at(state.anywhere->next()));
  return taken;
}

void Search::judge(const Genome& genome, Judgement judgement) {
  state_->judged = true;
  state_->members.push_back({genome, std::move(judgement)});
}

void Search::select() {
  std::vector<Member>& members = state_->members;
  const Costs all = ranked_costs(members);
  std::map<std::vector<double>, std::size_t> first;
  for (std::size_t i = 0; i < members.size(); ++i) first.emplace(all[i], i);
  std::vector<std::size_t> different;
  different.reserve(first.size());
  for (const auto& [unused, place] : first) different.push_back(place);
  std::sort(different.begin(), different.end());
  Costs costs;
  for (const std::size_t place : different) costs.push_back(all[place]);
  std::vector<Member> best;
  if (costs.size() == 1) {
    best.push_back(members[different.front()]);
  } else {
    for (const std::size_t i : pagmo::sort_population_mo(costs)) {
      if (best.size() < state_->survivors) best.push_back(members[different[i]]);
    }
  }
  members = std::move(best);
}

void Front::add(const Judgement& judgement) {
  violation_ = std::min(violation_, judgement.violation);
  if (judgement.violation > 0) return;
  const std::vector<double>& costs = judgement.costs;
  if (best_.empty()) best_ = worst_ = costs;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    best_[i] = std::min(best_[i], costs[i]);
    worst_[i] = std::max(worst_[i], costs[i]);
  }
  const auto is_no_worse = [&](const std::vector<double>& a, const std::vector<double>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) { return x <= y; });
  };
  if (std::any_of(costs_.begin(), costs_.end(),
                  [&](const std::vector<double>& other) { return is_no_worse(other, costs); }))
    return;
  costs_.erase(
      std::remove_if(costs_.begin(), costs_.end(),
                     [&](const std::vector<double>& other) { return is_no_worse(costs, other); }),
      costs_.end());
  costs_.push_back(costs);
}

double Front::hypervolume_of(const Costs& costs) const {
  if (costs.empty()) return 0;
  constexpr double reference = 1.1;
  Costs scaled;
  for (const std::vector<double>& point : costs) {
    std::vector<double> place;
    for (std::size_t i = 0; i < point.size(); ++i) {
      const double width = worst_[i] - best_[i];
      place.push_back(width > 0 ? (point[i] - best_[i]) / width : 0);
    }
    scaled.push_back(std::move(place));
  }
  if (best_.size() == 1) {
    const auto least = std::min_element(scaled.begin(), scaled.end());
    return (reference - least->front()) / reference;
  }
  const std::vector<double> corner(best_.size(), reference);
  return pagmo::hypervolume(scaled).compute(corner) /
         std::pow(reference, static_cast<double>(best_.size()));
}

}  // namespace platform::explore
