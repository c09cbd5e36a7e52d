#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <facts/limit.h>
#include <facts/result.h>
#include <vp/power_meter.h>

namespace platform::facts {

/// Cuts a run into the periods of its frames, for all that divides by time: the frame rate and the
/// power use the same ones.
///
/// A period reaches from the end of the frame before it (its own start, for the first) to its own
/// end, without the time in which its input was only uploaded (thesis 5.5: inputs are preloaded) or
/// given for the logic to settle (settled_ps).
/// With inputs at a fixed rate it reaches from one to the next, the wait for that included.
class FramePeriods {
 public:
  /// The period of the next frame, in order of time.
  std::vector<vp::Interval> next(const UnitReport& frame);
  /// End of the last period; 0 before the first.
  std::uint64_t end_ps() const { return end_ps_.value_or(0); }

 private:
  std::optional<std::uint64_t> end_ps_;
};

constexpr double ps_per_us = 1e6;
constexpr double ps_per_s = 1e12;

/// Mean, least and largest of the values added so far; all 0 when there are none.
class Statistic {
 public:
  void add(double value);
  std::uint64_t count() const { return count_; }
  double mean() const { return count_ == 0 ? 0 : sum_ / static_cast<double>(count_); }
  double min() const { return min_; }
  double max() const { return max_; }

 private:
  std::uint64_t count_ = 0;
  double sum_ = 0;
  double min_ = 0;
  double max_ = 0;
};

/// A run in figures, gathered frame by frame in constant memory.
///
/// Rates, latency and stages are those of delivered results. The time to a result is the period of
/// its frame (FramePeriods) and of those that the software gave up before it; FPS is one over it,
/// the mean FPS results over the sum of these times. Latency runs from the frame's start to its
/// result.
class Summary {
 public:
  struct Stage {
    std::string name;
    std::string part_of, clock, why;  ///< as in StageTime
    Statistic us;
  };

  void add(const UnitReport& frame);

  /// Units that the program worked on.
  std::uint64_t frames() const { return frames_; }
  /// Units with a result; the software gave up the others.
  std::uint64_t delivered() const { return latency_us_.count(); }
  /// Delivered units for which the tally of this name holds (Work::tallies).
  std::uint64_t tally(const std::string& name) const;
  /// Units in which something was lost.
  std::uint64_t lossy() const { return lossy_; }
  /// Units that did their job (UnitReport::fulfilled).
  std::uint64_t fulfilled() const { return fulfilled_; }
  /// Why delivered units did not by the design's own rule, and how many of them, in the order in
  /// which the reasons came.
  const std::vector<std::pair<std::string, std::uint64_t>>& failures() const { return failures_; }
  /// Units whose input was given before, so that what the logic learned from it is its own.
  std::uint64_t settled() const { return settled_; }
  /// Units with warnings.
  std::uint64_t warned() const { return warned_; }
  /// Results per second from the first frame's start to the last result; 0 without any.
  double mean_fps() const;
  /// The slowest and the fastest result.
  const Statistic& fps() const { return fps_; }
  const Statistic& latency_us() const { return latency_us_; }
  const std::vector<Stage>& stages() const { return stages_; }
  /// None: no result tells what its frame consists of.
  std::optional<Limit> limit() const { return limit_.limit(); }
  /// Of the samples of that name (UnitExtra::add_samples).
  const Statistic& samples(const std::string& name) const;
  /// Of the figures of delivered units, in the order in which they came.
  struct Figure {
    std::string name, unit;
    Statistic values;
  };
  const std::vector<Figure>& figures() const { return figures_; }

 private:
  void add_stages(const UnitReport& frame);
  void add_job(const UnitReport& frame);
  void add_figures(const UnitReport& frame);

  std::uint64_t frames_ = 0;
  std::uint64_t lossy_ = 0;
  std::uint64_t fulfilled_ = 0;
  std::uint64_t warned_ = 0;
  std::uint64_t settled_ = 0;
  std::uint64_t busy_ps_ = 0;  ///< until the last result
  std::uint64_t open_ps_ = 0;  ///< since then
  std::vector<std::pair<std::string, std::uint64_t>> failures_;
  std::map<std::string, std::uint64_t> tallies_;
  std::map<std::string, Statistic> samples_;
  std::vector<Figure> figures_;
  FramePeriods periods_;
  LimitFinder limit_;
  Statistic fps_;
  Statistic latency_us_;
  std::vector<Stage> stages_;
};

}  // namespace platform::facts
