#pragma once

#include <cstdint>
#include <vector>

namespace vp {

/// A quantity that stands for a while and then changes: the frequency of a clock, whether something
/// runs. Keeps its history, so that what it amounted to between two times can be asked for later.
class PiecewiseConstant {
 public:
  struct Step {
    std::uint64_t ps;
    double value;
  };

  explicit PiecewiseConstant(double value = 0) : steps_{{0, value}} {}

  /// It has that value from `ps` on; not earlier than the change before. Of several values of an
  /// instant the last one counts.
  void set(std::uint64_t ps, double value);
  double value() const { return steps_.back().value; }
  /// What stood at `ps`; not before the history begins.
  double at(std::uint64_t ps) const;
  /// Value · seconds between the two times. 0 if `to_ps` is not after `from_ps`.
  double integral(std::uint64_t from_ps, std::uint64_t to_ps) const;

  /// The changes, oldest first. The first one stands for all that was before.
  const std::vector<Step>& steps() const { return steps_; }
  /// What was before `ps` will not be asked for.
  void forget_before(std::uint64_t ps);

 private:
  std::vector<Step> steps_;
};

}  // namespace vp
