#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace platform::sweep {

/// Points of the unit cube, 1 excluded, one after the other; the same on every host.
class UnitSamples {
 public:
  virtual ~UnitSamples() = default;
  virtual std::vector<double> next() = 0;
};

/// Independent uniform numbers.
std::unique_ptr<UnitSamples> random_samples(std::size_t dimensions, std::uint64_t seed);

/// The Sobol sequence (direction numbers of Joe and Kuo, by Boost.Random); the origin, its first
/// point, is left out. `seed` points are skipped. Throws vp::InputError for too many dimensions.
std::unique_ptr<UnitSamples> sobol_samples(std::size_t dimensions, std::uint64_t seed);

/// Morris' trajectories (Morris 1991): each visits dimensions + 1 points of a grid of `levels`
/// levels, and moves one coordinate at a time by levels / (2 · (levels - 1)).
struct Trajectory {
  struct Step {
    std::size_t dimension;
    double delta;  ///< signed
  };
  std::vector<std::vector<double>> points;  ///< levels from 0 to 1
  std::vector<Step> steps;                  ///< step i leads from point i to i + 1
};

/// Trajectories of one seed, one after the other.
class TrajectorySampler {
 public:
  TrajectorySampler(std::size_t dimensions, std::uint32_t levels, std::uint64_t seed);
  ~TrajectorySampler();
  Trajectory next();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace platform::sweep
