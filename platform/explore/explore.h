#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <explore/search.h>
#include <sweep/pareto.h>
#include <sweep/plan.h>
#include <sweep/results.h>

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
  double shortfall(const sweep::Results& results, const sweep::ResultRow& row) const;

 private:
  std::string text_;
  std::optional<vp::Expression> expression_;
};

/// What a search is for.
struct Goal {
  std::vector<sweep::Objective> objectives;
  std::vector<Requirement> requirements;
  /// The least shortfall is the objective, in place of `objectives`.
  std::optional<Requirement> given_up;
};

/// Why a search ended.
enum class End { points, time, no_gain, exhausted, failed, interrupted };

/// "2000 points are computed", …
std::string to_string(End end);

/// Searches a space for the points that a study asks for. Which points are computed depends on the
/// study and its seed alone, not on what was computed before, by whom and how fast; but for a limit
/// of time.
class Explorer {
 public:
  /// Brings what there is of the points at these positions of the space's manifest, computed now or
  /// before. Points that it does not bring were interrupted.
  using Compute =
      std::function<std::map<std::size_t, sweep::Outcome>(const std::vector<std::size_t>&)>;
  /// Told after each generation.
  using OnGeneration = std::function<void(std::uint64_t points, const Front& front)>;

  /// Throws vp::InputError for a study that no search can be made for: no number as objective,
  /// constraints that contradict each other, nothing to vary.
  Explorer(sweep::Space& space, Compute compute, OnGeneration on_generation = {});

  /// Throws vp::InputError if no point has a value of an objective.
  End explore();

  /// Another search, which begins with the points that are there; so many more at most.
  End search(const Goal& goal, std::uint64_t more_points);

  /// The points, in the order in which they were asked for, without the manifest.
  const sweep::Results& results() const { return results_; }
  sweep::Space& space() const { return space_; }
  /// What explore() asks for.
  const Goal& goal() const { return goal_; }
  /// Of the last search.
  const Front& front() const { return front_; }
  /// The point nearest to being feasible; null if none ran.
  const sweep::ResultRow* least_violating() const;
  double violation(const Goal& goal, const sweep::ResultRow& row) const;

 private:
  void check() const;
  void check_first_generation() const;
  sweep::Assignment assignment(const Genome& genome) const;
  double broken_conditions(const sweep::Assignment& point, const Goal& goal) const;
  std::size_t take_any(const Goal& goal);
  bool take(const Genome& genome, const Goal& goal);
  bool compute_taken();
  Judgement judgement(const Goal& goal, const sweep::ResultRow& row) const;

  sweep::Space& space_;
  const sweep::SearchChoice& choice_;
  Compute compute_;
  OnGeneration on_generation_;
  Goal goal_;
  std::optional<double> seconds_;
  std::vector<Coordinate> coordinates_;
  sweep::Results results_;         ///< its rows belong to the manifest's points, in order
  std::vector<Genome> genomes_;    ///< of the manifest's points
  std::set<std::string> offered_;  ///< assignments, whatever became of them
  std::set<std::string> keys_;
  Front front_;
};

/// The least that one requirement must give way for a point to meet all others.
struct Relaxation {
  Requirement given_up;
  sweep::ResultRow row;  ///< the point that meets the others
  double shortfall = 0;  ///< of it
};

/// For each constraint and each part of the verdict but that a point runs and does its job: the
/// point, found by a search of its own and computed, that meets all others and needs the least of
/// it. Those for which there is none are left out. For an explorer that found no feasible point.
/// `go_on` is asked before each search.
std::vector<Relaxation> relaxations(Explorer& explorer, const std::function<bool()>& go_on);

/// In words, a sentence for each: "'summary.fps.mean >= 200' alone given up: 179.2 are possible …".
std::string text_of(const Explorer& explorer, const std::vector<Relaxation>& found);

}  // namespace platform::explore
