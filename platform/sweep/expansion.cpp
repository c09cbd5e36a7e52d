#include <sweep/expansion.h>

#include <algorithm>
#include <memory>

#include <sweep/samples.h>
#include <vp/error.h>

namespace platform::sweep {

namespace {

using Allowed = std::function<bool(const Assignment&)>;

/// Draws for each point that is wanted, before the constraints count as contradictory.
constexpr std::uint64_t most_draws = 1000;
/// Points of a grid that are looked at before its constraints count as contradictory.
constexpr std::uint64_t most_looks = 20'000'000;

std::size_t length(const AxisGroup& group) {
  return group.front().values().size();
}

void add(Assignment& point, const AxisGroup& group, std::size_t index) {
  for (const AxisValues& axis : group) point.emplace_back(axis.path(), axis.values()[index]);
}

Expansion grid(const std::vector<AxisGroup>& groups, const Allowed& allowed, std::uint64_t limit) {
  Expansion result;
  std::vector<std::size_t> index(groups.size(), 0);
  for (std::uint64_t looks = 0; looks < most_looks && result.points.size() < limit; ++looks) {
    Assignment point;
    for (std::size_t i = 0; i < groups.size(); ++i) add(point, groups[i], index[i]);
    if (allowed(point)) result.points.push_back(std::move(point));
    // The last axis moves fastest.
    std::size_t i = groups.size();
    while (i > 0 && ++index[i - 1] == length(groups[i - 1])) index[--i] = 0;
    if (i == 0) break;
  }
  return result;
}

/// One number of the sample for each group.
Assignment at(const std::vector<AxisGroup>& groups, const std::vector<double>& u,
              std::string (AxisValues::*value)(double) const) {
  Assignment point;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (const AxisValues& axis : groups[i]) point.emplace_back(axis.path(), (axis.*value)(u[i]));
  }
  return point;
}

Expansion sampled(const Spec& spec, const std::vector<AxisGroup>& groups, const Allowed& allowed,
                  std::uint64_t limit) {
  const Sampling& sampling = spec.sampling;
  const std::unique_ptr<UnitSamples> samples = sampling.method == Sampling::Method::sobol
                                                   ? sobol_samples(groups.size(), sampling.seed)
                                                   : random_samples(groups.size(), sampling.seed);
  Expansion result;
  const std::uint64_t wanted = std::min(sampling.points, limit);
  for (std::uint64_t draws = 0; result.points.size() < wanted; ++draws) {
    if (draws >= most_draws * (result.points.size() + 1)) break;
    Assignment point = at(groups, samples->next(), &AxisValues::sampled);
    if (allowed(point)) result.points.push_back(std::move(point));
  }
  if (!result.points.empty() && result.points.size() < wanted) {
    throw vp::InputError(sampling.where + ": the constraints allow almost no point: " +
                         std::to_string(result.points.size()) + " of " + std::to_string(wanted) +
                         " found; narrow the ranges");
  }
  return result;
}

std::string group_name(const AxisGroup& group) {
  std::string name;
  for (const AxisValues& axis : group) name += (name.empty() ? "" : "+") + axis.path();
  return name;
}

bool all_allowed(const std::vector<Assignment>& points, const Allowed& allowed) {
  return std::all_of(points.begin(), points.end(), allowed);
}

Expansion morris(const Spec& spec, const std::vector<AxisGroup>& groups, const Allowed& allowed,
                 std::uint64_t limit) {
  TrajectorySampler sampler(groups.size(), spec.sampling.levels, spec.sampling.seed);
  Expansion result;
  std::uint32_t found = 0;
  for (std::uint64_t draws = 0; found < spec.sampling.trajectories; ++draws) {
    if (draws >= most_draws * (found + 1) || result.points.size() + groups.size() + 1 > limit)
      break;
    const Trajectory trajectory = sampler.next();
    std::vector<Assignment> points;
    for (const std::vector<double>& u : trajectory.points)
      points.push_back(at(groups, u, &AxisValues::at_level));
    if (!all_allowed(points, allowed)) continue;
    ++found;
    const std::size_t first = result.points.size();
    for (std::size_t i = 0; i < trajectory.steps.size(); ++i) {
      const std::size_t d = trajectory.steps[i].dimension;
      // Of a list of few values, two levels may be the same one.
      const double delta = groups[d].front().level_of(trajectory.points[i + 1][d]) -
                           groups[d].front().level_of(trajectory.points[i][d]);
      if (delta == 0) continue;
      result.effects.push_back({first + i, first + i + 1, group_name(groups[d]), delta});
    }
    result.points.insert(result.points.end(), points.begin(), points.end());
  }
  return result;
}

Expansion one_at_a_time(const std::vector<AxisGroup>& groups, const Allowed& allowed,
                        std::uint64_t limit) {
  Expansion result;
  const Assignment base;
  if (!allowed(base)) return result;
  result.points.push_back(base);
  for (const AxisGroup& group : groups) {
    for (std::size_t i = 0; i < length(group); ++i) {
      Assignment point;
      add(point, group, i);
      if (result.points.size() >= limit || !allowed(point)) continue;
      result.effects.push_back({0, result.points.size(), group_name(group), 0});
      result.points.push_back(std::move(point));
    }
  }
  return result;
}

}  // namespace

double point_count(const Spec& spec, const std::vector<AxisGroup>& groups) {
  using Method = Sampling::Method;
  const Method method = spec.sampling.method;
  double product = 1;
  double sum = 1;
  for (const AxisGroup& group : groups) {
    for (const AxisValues& axis : group) {
      if (axis.values().size() != length(group)) {
        throw vp::InputError(axis.where() + ": zipped parameters need as many values each: '" +
                             group.front().path() + "' has " + std::to_string(length(group)) +
                             ", '" + axis.path() + "' " + std::to_string(axis.values().size()));
      }
      if (axis.continuous() && method == Method::grid) {
        throw vp::InputError(axis.where() + ": the range of '" + axis.path() +
                             "' needs 'step' or 'count', unless 'sample' draws from it");
      }
    }
    product *= static_cast<double>(length(group));
    sum += static_cast<double>(length(group));
  }
  if (method == Method::grid) return product;
  if (method == Method::one_at_a_time) return sum;
  if (method == Method::morris)
    return spec.sampling.trajectories * static_cast<double>(groups.size() + 1);
  return static_cast<double>(spec.sampling.points);
}

Expansion expand(const Spec& spec, const std::vector<AxisGroup>& groups, const Allowed& allowed,
                 std::uint64_t limit) {
  using Method = Sampling::Method;
  if (spec.sampling.method != Method::grid && groups.empty())
    throw vp::InputError(spec.sampling.where + ": 'sample' without 'parameters' to draw");
  Expansion result;
  switch (spec.sampling.method) {
    case Method::grid:
      result = grid(groups, allowed, limit);
      break;
    case Method::random:
    case Method::sobol:
      result = sampled(spec, groups, allowed, limit);
      break;
    case Method::morris:
      result = morris(spec, groups, allowed, limit);
      break;
    case Method::one_at_a_time:
      result = one_at_a_time(groups, allowed, limit);
      break;
  }
  if (result.points.empty()) {
    throw vp::InputError(spec.origin + ": no point is left: " +
                         (spec.constraints.empty()
                              ? "the limit is below one trajectory"
                              : "the constraints contradict each other or the values"));
  }
  return result;
}

}  // namespace platform::sweep
