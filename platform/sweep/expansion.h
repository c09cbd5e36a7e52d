#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <sweep/axis_values.h>
#include <sweep/spec.h>

namespace platform::sweep {

/// The swept values of one point, in the order of the axes: path and value.
using Assignment = std::vector<std::pair<std::string, std::string>>;

/// Axes that move together, with their values.
using AxisGroup = std::vector<AxisValues>;

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

/// All points for which `allowed` is true, `limit` at most. Throws vp::InputError if there is none:
/// the constraints contradict each other or the values.
Expansion expand(const Spec& spec, const std::vector<AxisGroup>& groups,
                 const std::function<bool(const Assignment&)>& allowed, std::uint64_t limit);

}  // namespace platform::sweep
