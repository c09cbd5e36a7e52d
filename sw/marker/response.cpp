#include <marker/angles.h>
#include <marker/response.h>
#include <marker/work.h>

#include <algorithm>
#include <cmath>

namespace marker {
namespace {

/// An edge seen through a curve of exponent e is shifted by this much of its transition's deviation
/// for each unit of log(e): 0.31 at 1.8, 0.39 at 2.2 (measured).
constexpr double shift_of_logarithm = 0.51;
/// Exponents that cameras have, with room.
constexpr double least_logarithm = -0.5, most_logarithm = 1.4;
/// One marker's exponent scatters by this much around the camera's, whatever its edges say: 0.02 of
/// a transition (measured).
constexpr double marker_variance = 0.04 * 0.04;
/// What edges say of a marker's exponent is not better than this, whatever they agree on.
constexpr double least_edge_variance = 0.001 * 0.001;
/// What is known weighs no more than so many markers: a camera whose curve changes is followed
/// within 30 frames of ten (decision).
constexpr double most_weight = 300 / marker_variance;
/// A logarithm known to 0.01 shifts no edge by more than 0.005 of its transition.
constexpr double settled_weight = 1 / (0.01 * 0.01);
/// Looks at a frame: a first one with what is known, and others while the curve still moves.
constexpr std::uint32_t most_looks = 4;
/// So much of a change of the logarithm is worth another look: less than 0.01 of a transition.
constexpr double worth_a_look = 0.015;
/// Markers whose cells are narrow for their blur are off by so much (measured). They count where no
/// other has been seen, and only if they say clearly that there is a curve.
constexpr double vague_variance = 0.1 * 0.1;
constexpr double clear_logarithm = 0.3, clear_deviations = 2;
/// An exponent that is not as far from 1 is taken for 1: levels of most machine-vision cameras are
/// light (decision).
constexpr double told_deviations = 2;
/// A marker that is farther off than this, in transitions, is not one of this curve: a reflection,
/// or a shadow.
constexpr double most_shift = 0.8;
/// The scatter of single markers, in transitions: what is expected before it is seen (measured), as
/// if so many had shown it, and over how many it is kept.
constexpr double first_scatter = 0.006 * 0.006, first_scatter_markers = 4, remembered_markers = 60;

}  // namespace

void ResponseFinder::open() {
  logarithm_ = weight_ = 0;
  scatter_ = first_scatter;
  scatter_markers_ = first_scatter_markers;
  common_shift_ = unknown_shift;
  make_table(0);
  begin_frame();
}

void ResponseFinder::make_table(double logarithm) {
  table_logarithm_ = logarithm;
  exponent_ = exponential(logarithm);
  if (logarithm == 0) {
    std::copy_n(linear_light(), table_.size(), table_.begin());
  } else {
    fill_light(exponent_, table_);
    work(Work::curves_made, 1);
  }
}

bool ResponseFinder::is_settled() const {
  return weight_ > settled_weight;
}

void ResponseFinder::begin_frame() {
  before_ = logarithm_;
  before_weight_ = std::min(weight_, most_weight);
  looks_ = 0;
  begin_look();
}

void ResponseFinder::begin_look() {
  sum_ = sum_weight_ = square_ = noise_ = vague_ = vague_weight_ = 0;
  markers_ = 0;
}

void ResponseFinder::add(const InnerShift& seen) {
  if (seen.edges == 0 || !(seen.deviation > 0)) return;
  const double shift = seen.shift / seen.deviation;
  const double variance = seen.variance / (seen.deviation * seen.deviation);
  if (!(std::abs(shift) < most_shift)) return;
  constexpr double slope = shift_of_logarithm;
  const double of_edges = variance / (slope * slope);
  if (seen.is_vague) {
    const double weight = 1 / (of_edges + least_edge_variance);
    vague_ += weight * (table_logarithm_ + shift / slope);
    vague_weight_ += weight;
    return;
  }
  const double weight = 1 / (of_edges + marker_variance);
  sum_ += weight * (table_logarithm_ + shift / slope);
  sum_weight_ += weight;
  square_ += shift * shift;
  noise_ += variance;
  ++markers_;
}

bool ResponseFinder::end_look() {
  ++looks_;
  if (markers_ == 0 && before_weight_ == 0 && vague_weight_ > 0) {
    const double deviation = 1 / std::sqrt(vague_weight_);
    const double logarithm = vague_ / vague_weight_;
    if (logarithm > clear_logarithm + clear_deviations * deviation) {
      sum_weight_ = 1 / (deviation * deviation + vague_variance);
      sum_ = sum_weight_ * logarithm;
    }
  }
  if (!(sum_weight_ > 0)) return false;
  weight_ = before_weight_ + sum_weight_;
  logarithm_ =
      std::clamp((before_weight_ * before_ + sum_) / weight_, least_logarithm, most_logarithm);
  const bool is_told = std::abs(logarithm_) * std::sqrt(weight_) > told_deviations;
  const double best = is_told ? logarithm_ : 0;
  const bool is_off = std::abs(best - table_logarithm_) > worth_a_look;
  if (is_off) {
    make_table(best);
  } else if (markers_ > 0) {
    note_scatter();
  }
  common_shift_ = std::sqrt(shift_left * shift_left + scatter_ +
                            shift_of_logarithm * shift_of_logarithm / weight_);
  begin_look();
  return is_off && looks_ < most_looks;
}

/// A curve shifts all markers alike; what else there is, as sharpening or the blocks of JPEG, does
/// not.
void ResponseFinder::note_scatter() {
  const double excess = std::max(square_ - noise_, 0.0);
  const double all = scatter_markers_ + markers_;
  scatter_ = (scatter_ * scatter_markers_ + excess) / all;
  scatter_markers_ = std::min(all, remembered_markers);
}

}  // namespace marker
