#include <algorithm>
#include <boost/random/sobol.hpp>
#include <memory>
#include <numeric>
#include <string>
#include <utility>

#include <study/expansion.h>
#include <vp/error.h>
#include <vp/random.h>

namespace platform::study {

namespace {

constexpr double two_to_64 = 18446744073709551616.0;

/// In 0 … 1, 1 excluded, in steps of 2⁻⁵³.
double unit_of(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// Uniform from 0 to `below` - 1. The bias of the remainder is below 2⁻⁵⁰.
std::uint64_t below(vp::RandomBits& bits, std::uint64_t below) {
  return bits.next() % below;
}

class RandomSamples : public UnitSamples {
 public:
  RandomSamples(std::size_t dimensions, std::uint64_t seed)
      : bits_(seed), dimensions_(dimensions) {}

  std::vector<double> next() override {
    std::vector<double> point(dimensions_);
    for (double& value : point) value = unit_of(bits_.next());
    return point;
  }

 private:
  vp::RandomBits bits_;
  std::size_t dimensions_;
};

class SobolSamples : public UnitSamples {
 public:
  SobolSamples(std::size_t dimensions, std::uint64_t seed)
      : sobol_(dimensions), dimensions_(dimensions) {
    sobol_.discard(seed * dimensions);
  }

  std::vector<double> next() override {
    std::vector<double> point(dimensions_);
    for (double& value : point) value = static_cast<double>(sobol_() >> 11) * 0x1p11 / two_to_64;
    return point;
  }

 private:
  boost::random::sobol_engine<std::uint64_t, 64> sobol_;
  std::size_t dimensions_;
};

}  // namespace

std::unique_ptr<UnitSamples> random_samples(std::size_t dimensions, std::uint64_t seed) {
  return std::make_unique<RandomSamples>(dimensions, seed);
}

std::unique_ptr<UnitSamples> sobol_samples(std::size_t dimensions, std::uint64_t seed) {
  constexpr std::size_t most = boost::random::default_sobol_table::max_dimension;
  if (dimensions > most) {
    throw vp::InputError("a Sobol sample has at most " + std::to_string(most) + " dimensions");
  }
  return std::make_unique<SobolSamples>(dimensions, seed);
}

struct TrajectorySampler::State {
  vp::RandomBits bits;
  std::size_t dimensions;
  std::uint32_t levels;
};

TrajectorySampler::TrajectorySampler(std::size_t dimensions, std::uint32_t levels,
                                     std::uint64_t seed)
    : state_(new State{vp::RandomBits(seed), dimensions, levels}) {}

TrajectorySampler::~TrajectorySampler() = default;

Trajectory TrajectorySampler::next() {
  const double last = state_->levels - 1;
  const double delta = state_->levels / (2 * last);
  const std::uint64_t half = state_->levels / 2;  // starts from which `delta` up stays inside
  std::vector<double> point(state_->dimensions);
  std::vector<bool> up(state_->dimensions);
  for (std::size_t i = 0; i < point.size(); ++i) {
    up[i] = below(state_->bits, 2) == 1;
    const auto low = static_cast<double>(below(state_->bits, half)) / last;
    point[i] = up[i] ? low : low + delta;
  }
  std::vector<std::size_t> order(state_->dimensions);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[below(state_->bits, i)]);
  Trajectory trajectory;
  trajectory.points.push_back(point);
  for (const std::size_t dimension : order) {
    const double step = up[dimension] ? delta : -delta;
    point[dimension] += step;
    trajectory.points.push_back(point);
    trajectory.steps.push_back({dimension, step});
  }
  return trajectory;
}

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

}  // namespace platform::study
