#include <sweep/samples.h>

#include <boost/random/sobol.hpp>
#include <numeric>
#include <string>
#include <utility>

#include <scene/noise.h>
#include <vp/error.h>

namespace platform::sweep {

namespace {

constexpr double two_to_64 = 18446744073709551616.0;

/// In 0 … 1, 1 excluded, in steps of 2⁻⁵³.
double unit_of(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// Uniform from 0 to `below` - 1. The bias of the remainder is below 2⁻⁵⁰.
std::uint64_t below(RandomBits& bits, std::uint64_t below) {
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
  RandomBits bits_;
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
  RandomBits bits;
  std::size_t dimensions;
  std::uint32_t levels;
};

TrajectorySampler::TrajectorySampler(std::size_t dimensions, std::uint32_t levels,
                                     std::uint64_t seed)
    : state_(new State{RandomBits(seed), dimensions, levels}) {}

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

}  // namespace platform::sweep
