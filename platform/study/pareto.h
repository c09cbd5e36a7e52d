#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <study/results.h>
#include <vp/expression.h>

namespace platform::study {

/// "max summary.fps.mean", "min power.total_w.nominal / summary.fps.mean".
class Objective {
 public:
  /// Throws vp::InputError; `where` names its place.
  Objective(const std::string& text, const std::string& where);

  bool maximise() const { return maximise_; }
  const vp::Expression& figure() const { return figure_; }

 private:
  bool maximise_;
  vp::Expression figure_;
};

/// A point in an analysis by objectives.
struct RankedPoint {
  const ResultRow* row = nullptr;
  std::vector<double> figures;  ///< of each objective; empty: it has no value of one of them
  result::Holds feasible = result::Holds::yes;
  /// Whether another point is better, as far as the bands of the figures tell (judge_by_bands()):
  /// yes, no, or unknown, that is perhaps. None: not judged, or on no front.
  std::optional<result::Holds> dominated;
  std::size_t front = 0;  ///< 1: nothing is better in all objectives; 2: once the first front
                          ///< is taken away; … 0: not feasible, without figures, or the same as
                          ///< an earlier one
  /// Position in Pareto::points of the one on the first front that beats it (find_better()).
  std::optional<std::size_t> better;
};

struct Pareto {
  std::vector<RankedPoint> points;  ///< failed ones left out, in the order of the sweep
  std::optional<std::size_t> knee;  ///< position in `points`
  bool has_bands = false;           ///< of a figure
  /// For each metric that some points lack: how many. A point without results has no rate.
  std::map<std::string, std::uint64_t> lacking;
};

/// Whether it repeats an earlier point: results, verdict and objectives are equal.
bool is_repetition(const Results& results, const ResultRow& row,
                   const std::vector<Objective>& objectives);

/// Sorts the points into fronts: one dominates another if it is no worse in every objective and
/// better in one. The knee is the point of the first front nearest to the best value of every
/// objective, each objective scaled to 0 … 1 over that front; a front of two has none. A point
/// without a metric of an objective cannot be compared and is not ranked. Points that are not
/// feasible are on no front, nor is one that repeats an earlier one.
Pareto rank(const Results& results, const std::vector<Objective>& objectives);

/// Of a study that names none: frame rate and power.
inline constexpr std::array<const char*, 2> usual_objectives{"max summary.fps.mean",
                                                             "min power.total_w.nominal"};

/// Fills in what the bands of the figures leave of the order.
void judge_by_bands(Pareto& pareto, const std::vector<Objective>& objectives);

/// For each point behind the first front, the point of that front that beats it: of several the one
/// whose least gain of all objectives is the largest, each gain as a part of the objective's range
/// over all ranked points; of equal ones the earlier.
void find_better(Pareto& pareto, const std::vector<Objective>& objectives);

/// The study's objectives, or the usual ones; without those that no point has a value of.
std::vector<Objective> objectives_of(const Results& results);

/// Positions in `points`: front by front, in each the best by the first objective first; then those
/// that are on no front, in the order of the sweep.
std::vector<std::size_t> best_first(const Pareto& pareto, const std::vector<Objective>& objectives);

/// Why no point is on a front: what rules out how many, and the point that is nearest to being
/// feasible. Of those that break as few parts of the verdict it is the one whose constraints fall
/// short the least.
std::string why_no_point(const Results& results);

/// Whether `a` is no worse than `b` in every objective and better in one.
bool dominates(const std::vector<double>& a, const std::vector<double>& b,
               const std::vector<bool>& maximise);

/// The fronts of figures alone, 1 for the best; `maximise` says which way each objective goes.
std::vector<std::size_t> fronts(const std::vector<std::vector<double>>& figures,
                                const std::vector<bool>& maximise);

/// What is sure of the order: "By the bands of the figures 2 of 7 points on the front can be beaten
/// by no other; of 12 behind it 3 are worse for sure". Empty if no figure has a band.
std::string doubt_text(const Pareto& pareto);

/// The first front as a table, the knee marked, and the points that are on it for sure.
std::string pareto_table(const Results& results, const std::vector<Objective>& objectives,
                         const Pareto& pareto);
/// All points: key, front, knee, feasible and dominated (yes, no or unknown; the latter empty
/// where it is not judged), swept parameters, objectives; behind the front the key of the point
/// that beats it (find_better()), and by how much in each objective. Throws vp::OutputError.
void write_pareto_csv(const std::string& path, const Results& results,
                      const std::vector<Objective>& objectives, const Pareto& pareto);

}  // namespace platform::study
