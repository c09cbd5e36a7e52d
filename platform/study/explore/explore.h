#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <study/explore/budget.h>
#include <study/explore/search.h>
#include <study/pareto.h>
#include <study/plan.h>
#include <study/results.h>

namespace platform::explore {

/// One thing that must hold of a point: a part of its verdict, or a constraint.
class Requirement {
 public:
  static Requirement part(const std::string& name);
  static Requirement constraint(const vp::Expression& expression);

  /// "verdict.timing", "summary.fps.mean >= 200".
  const std::string& text() const { return text_; }
  /// Null: a part of the verdict.
  const vp::Expression* expression() const { return expression_ ? &*expression_ : nullptr; }

  /// How far the point is from it, without dimension; 0: it holds.
  double shortfall(const study::Results& results, const study::ResultRow& row) const;

 private:
  std::string text_;
  std::optional<vp::Expression> expression_;
};

/// What a search is for.
struct Goal {
  std::vector<study::Objective> objectives;
  std::vector<Requirement> requirements;
  /// The least shortfall is the objective, in place of `objectives`.
  std::optional<Requirement> given_up;
};

/// Why a search ended.
enum class End { points, time, infeasible, no_gain, exhausted, failed, interrupted };

/// "all its points are used", …
std::string to_string(End end);

/// Searches a space for the points that a study asks for. Which points are computed depends on the
/// study and its seed alone, not on what was computed before, by which process and how fast; a time
/// limit is the exception.
class Explorer {
 public:
  /// Returns the outcomes of the points at these positions of the space's manifest, computed now or
  /// before. Points without an outcome were interrupted, by a signal or at the deadline.
  using Compute =
      std::function<std::map<std::size_t, study::Outcome>(const std::vector<std::size_t>&)>;
  /// Called after each generation.
  using OnGeneration = std::function<void(std::uint64_t points, const Front& front)>;

  /// Throws vp::InputError for a study that no search can be made for: no number as objective,
  /// constraints that contradict each other, nothing to vary.
  Explorer(study::Space& space, Budget budget, Compute compute, OnGeneration on_generation = {});

  /// Searches for goal(), with the whole budget once a point is feasible. Until then it ends after
  /// half of it, with End::infeasible: the rest is for relaxations(). Throws vp::InputError if no
  /// point has a value of an objective.
  End explore();

  /// A search that begins with the points that are there, and ends when `budget` is spent.
  End search(const Goal& goal, const Budget& budget) { return search(goal, budget, budget); }

  /// The points, in the order in which they were asked for, without the manifest.
  const study::Results& results() const { return results_; }
  study::Space& space() const { return space_; }
  /// What explore() asks for.
  const Goal& goal() const { return goal_; }
  const Budget& budget() const { return budget_; }
  /// Whether some point meets all that goal() requires.
  bool has_feasible_point() const;
  /// Of the last search.
  const Front& front() const { return front_; }
  /// The point nearest to being feasible; null if none ran.
  const study::ResultRow* least_violating() const;
  double violation(const Goal& goal, const study::ResultRow& row) const;

 private:
  End search(const Goal& goal, const Budget& whole, const Budget& while_infeasible);
  void check() const;
  void check_first_generation() const;
  study::Assignment assignment(const Genome& genome) const;
  double broken_conditions(const study::Assignment& point, const Goal& goal) const;
  std::size_t take_any(const Goal& goal, std::uint64_t most);
  bool take(const Genome& genome, const Goal& goal);
  bool compute_taken();
  Judgement judgement(const Goal& goal, const study::ResultRow& row) const;

  study::Space& space_;
  const study::SearchChoice& choice_;
  const Budget budget_;
  Compute compute_;
  OnGeneration on_generation_;
  Goal goal_;
  std::vector<Coordinate> coordinates_;
  study::Results results_;         ///< its rows belong to the manifest's points, in order
  std::vector<Genome> genomes_;    ///< of the manifest's points
  std::set<std::string> offered_;  ///< assignments, whatever became of them
  std::set<std::string> keys_;
  Front front_;
};

/// The least that one requirement must give way for a point to meet all others.
struct Relaxation {
  Requirement given_up;
  study::ResultRow row;  ///< the point that meets the others
  double shortfall = 0;  ///< of it
};

/// What a search found of what would have to give way.
struct Relaxations {
  std::vector<Relaxation> found;  ///< the least first
  bool asked = false;             ///< there is something that could give way
  bool cut_short = false;         ///< the budget, or a signal, ended a search before it was done
};

/// For each constraint and each part of the verdict (except that a point runs and does its usual
/// job): the point, found by a search of its own and computed, that meets all others and needs the
/// least of it. Those without such a point are left out. For an explorer that found no feasible
/// point; the searches share what is left of its budget, and end as soon as one of them finds a
/// feasible point after all. `may_continue` is asked before each search.
Relaxations relaxations(Explorer& explorer, const std::function<bool()>& may_continue);

/// In words, a sentence for each: "'summary.fps.mean >= 200' gives way to …".
std::string text_of(const Explorer& explorer, const Relaxations& relaxations);

/// All that `markervp explore` finds.
struct Answer {
  End end = End::interrupted;
  std::optional<Relaxations> relaxations;  ///< none: a point is feasible, or the search broke off
};

/// Searches within the explorer's budget, and asks what would have to give way if no point is
/// feasible. If that finds a feasible point, the search continues from there.
Answer answer(Explorer& explorer, const std::function<bool()>& may_continue);

}  // namespace platform::explore
