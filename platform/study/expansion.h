#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <study/axes.h>
#include <study/point.h>
#include <study/spec.h>

namespace platform::study {

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

/// Two points that differ in one axis: a step of a sensitivity analysis.
struct Effect {
  std::size_t from = 0;  ///< position in Expansion::points
  std::size_t to = 0;
  std::string path;
  double delta = 0;  ///< how far along the axis, -1 to 1; 0: one at a time, which has no distance
};

struct Expansion {
  std::vector<Assignment> points;
  std::vector<Effect> effects;  ///< of Morris and one-at-a-time
};

/// How many points there are before constraints and limit. Throws vp::InputError if zipped axes
/// differ in length, or a range in a grid has neither step nor count.
double point_count(const Spec& spec, const std::vector<AxisGroup>& groups);

/// All points for which `allowed` is true, `limit` at most. Throws vp::InputError if missing:
/// the constraints contradict each other or the values.
Expansion expand(const Spec& spec, const std::vector<AxisGroup>& groups,
                 const std::function<bool(const Assignment&)>& allowed, std::uint64_t limit);

}  // namespace platform::study
