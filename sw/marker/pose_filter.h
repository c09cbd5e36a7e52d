#pragma once

#include <marker/marker_detector.h>

#include <array>
#include <cstdint>

namespace marker {

/// What is expected of a motion: how much it changes from one frame to the next. Deviations of
/// accelerations along and about each axis of the camera, constant between two frames.
struct PoseFilterOptions {
  double acceleration;       ///< m/s²
  double turn_acceleration;  ///< rad/s²
};

/// A Kalman filter for the pose of one thing that moves at a nearly constant speed.
///
/// The errors that it keeps a covariance of are a small turn about the camera's axes and a shift,
/// as BoardPose has them, and the same of the speeds. All zero: nothing was seen yet.
class PoseTrack {
 public:
  /// Takes in what a frame shows, `time` s after any moment, and not before the last one. Of two
  /// poses the likelier one counts. Afterwards `best` is the pose that all frames together say,
  /// with its covariance. A pose that the motion cannot have led to begins anew, and stays as it
  /// is.
  PoseMotion follow(BoardPoses& poses, double time, const PoseFilterOptions& options);

 private:
  struct Weighed;

  void begin(const BoardPose& seen);
  void predict(double seconds, const PoseFilterOptions& options);
  Weighed weigh(const BoardPose& seen) const;
  void correct(const Weighed& weighed);

  std::uint32_t frames_;
  double time_;
  BoardPose pose_;
  std::array<double, 6> speed_;       ///< rad/s, then m/s
  std::array<double, 36> mixed_;      ///< covariance of pose (rows) and speeds
  std::array<double, 36> of_speeds_;  ///< covariance of the speeds
};

/// Follows each ID of a dictionary and the board from frame to frame. An ID that a frame shows
/// more than once is left as it is: the occurrences cannot be told apart.
class PoseFilter {
 public:
  /// For static memory, all zero.
  void open(const PoseFilterOptions& options) { options_ = options; }

  /// Replaces the poses of a frame that was taken at `time`, s.
  void follow(Detections& found, double time);

 private:
  PoseFilterOptions options_;
  PoseTrack board_;
  std::array<PoseTrack, max_dictionary_size> markers_;         ///< by ID
  std::array<std::uint16_t, max_dictionary_size> times_seen_;  ///< in this frame, by ID
};

}  // namespace marker
