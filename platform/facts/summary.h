#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <facts/limit.h>
#include <facts/result.h>
#include <vp/power_meter.h>

namespace platform::facts {

/// Distance of a found marker from the truth.
struct MarkerError {
  double corner_px = 0;       ///< mean distance of the four corners
  double translation_mm = 0;  ///< distance of the translations
  double rotation_deg = 0;    ///< angle of the rotation between the two
};

/// Translation and rotation are meaningless unless has_pose_error().
MarkerError measure_error(const FoundMarker& found, const GroundTruth& truth);

/// False: the marker has no pose, or none that could be right, for it is larger or smaller than the
/// program knows.
bool has_pose_error(const FoundMarker& found, const GroundTruth& truth);

/// The truth of this marker: of those with its ID the one that is nearest. Null if the scene has
/// none, or is not known.
const GroundTruth* truth_of(const FrameReport& frame, const FoundMarker& found);

/// For a marker that the scene does not have: "another marker: the scene has 0 and 9 more".
std::string another_marker_text(const FrameReport& frame);

/// Cuts a run into the periods of its frames, for all that divides by time: the frame rate and the
/// power use the same ones.
///
/// A period reaches from the end of the frame before it (its own start, for the first) to its own
/// end, without the time in which its image was only uploaded (thesis 5.5: images are preloaded) or
/// shown for the threshold to settle (settled_ps).
/// With a camera of a fixed rate it reaches from image to image, the wait for the next included.
class FramePeriods {
 public:
  /// The period of the next frame, in order of time.
  std::vector<vp::Interval> next(const FrameReport& frame);
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

  void add(const FrameReport& frame);

  /// Frames that the program worked on.
  std::uint64_t frames() const { return frames_; }
  /// Frames with a result; the software gave up the others.
  std::uint64_t delivered() const { return latency_us_.count(); }
  /// Frames in which a marker was identified.
  std::uint64_t detected() const { return detected_; }
  /// Frames in which a marker was identified that the scene does not have, and not the scene's own.
  std::uint64_t mistaken() const { return mistaken_; }
  /// Frames in which something was lost.
  std::uint64_t lossy() const { return lossy_; }
  /// Frames with a result that lacks the marker of the scene.
  std::uint64_t overlooked() const { return overlooked_; }
  /// Frames that did their job: a result, nothing lost, and the marker of the scene, if it is
  /// known.
  std::uint64_t fulfilled() const { return fulfilled_; }
  /// Frames whose image was shown before, so that the threshold is its own.
  std::uint64_t settled() const { return settled_; }
  /// Frames with warnings.
  std::uint64_t warned() const { return warned_; }
  /// Results per second from the first frame's start to the last result; 0 without any.
  double mean_fps() const;
  /// The slowest and the fastest result.
  const Statistic& fps() const { return fps_; }
  const Statistic& latency_us() const { return latency_us_; }
  const std::vector<Stage>& stages() const { return stages_; }
  /// None: no result tells what its frame consists of.
  std::optional<Limit> limit() const { return limit_.limit(); }
  /// Over the markers whose truth is known.
  const Statistic& corner_px() const { return corner_px_; }
  const Statistic& translation_mm() const { return translation_mm_; }
  const Statistic& rotation_deg() const { return rotation_deg_; }

 private:
  void add_stages(const FrameReport& frame);
  void add_markers(const FrameReport& frame);

  std::uint64_t frames_ = 0;
  std::uint64_t detected_ = 0;
  std::uint64_t mistaken_ = 0;
  std::uint64_t lossy_ = 0;
  std::uint64_t overlooked_ = 0;
  std::uint64_t fulfilled_ = 0;
  std::uint64_t warned_ = 0;
  std::uint64_t settled_ = 0;
  std::uint64_t busy_ps_ = 0;  ///< until the last result
  std::uint64_t open_ps_ = 0;  ///< since then
  FramePeriods periods_;
  LimitFinder limit_;
  Statistic fps_;
  Statistic latency_us_;
  Statistic corner_px_;
  Statistic translation_mm_;
  Statistic rotation_deg_;
  std::vector<Stage> stages_;
};

}  // namespace platform::facts
