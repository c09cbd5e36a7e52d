#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace platform::explore {

/// One value a coordinate of the space.
using Genome = std::vector<double>;

/// A coordinate that has an order goes from 0 to 1; one without is the number of a choice.
struct Coordinate {
  std::uint32_t choices = 0;  ///< 0: ordered
};

/// What a genome is worth.
struct Judgement {
  std::vector<double> costs;  ///< of each objective; less is better
  double violation = 0;       ///< of all that must hold; 0: feasible
};

/// A search by non-dominated sorting (NSGA-II, Deb 2002) with the operators of pagmo. A feasible
/// genome beats one that is not, and of those the one that violates less (Deb's rule). Where
/// several cost the same one is kept. The same seed and the same judgements give the same search.
class Search {
 public:
  /// `survivors`: how many genomes have offspring.
  Search(std::vector<Coordinate> coordinates, std::size_t survivors, std::uint64_t seed);
  ~Search();

  /// Whether the search may have the genome; it may not have one twice.
  using Take = std::function<bool(const Genome& genome)>;

  /// Offers genomes until `wanted` of them are taken: evenly spread ones before anything was
  /// judged, then offspring, then random ones. Returns how many were taken: fewer if hundreds in a
  /// row are refused, as in a space that has no more.
  std::size_t breed(std::size_t wanted, const Take& take);

  void judge(const Genome& genome, Judgement judgement);

  /// Leaves the best of those that were judged.
  void select();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The feasible judgements that none dominates, and how much of the box of what was seen they
/// dominate.
class Front {
 public:
  void add(const Judgement& judgement);

  /// Of the front; points of equal costs count once.
  std::size_t size() const { return costs_.size(); }
  /// The part that the front dominates of the box between the best and the worst costs that were
  /// feasible, a tenth wider at the worst end: 0 to 1.
  double hypervolume() const { return hypervolume_of(costs_); }
  /// The same for an earlier front in today's box.
  double hypervolume_of(const std::vector<std::vector<double>>& costs) const;
  const std::vector<std::vector<double>>& costs() const { return costs_; }
  /// The least violation so far; infinity before the first judgement.
  double violation() const { return violation_; }

 private:
  std::vector<std::vector<double>> costs_;
  std::vector<double> best_, worst_;
  double violation_ = 1e300;
};

}  // namespace platform::explore
