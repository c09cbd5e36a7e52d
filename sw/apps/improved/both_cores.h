#pragma once

#include <array>
#include <cstdint>

#include <hal/hal.h>
#include <marker/camera.h>
#include <marker/marker_detector.h>

namespace improved {

/// Finds the markers of a frame on both cores: each takes some blobs off the list, reads the
/// markers there and makes their poses, until the list is empty. What is found is what one core
/// finds.
class BothCores {
 public:
  /// Starts the second core: once. Static memory only, for its thread never ends.
  void start(const marker::Dictionary& dictionary, const marker::DetectorOptions& options);

  /// As MarkerDetector::find_markers(), with the poses of markers that stand alone.
  void find(const marker::CameraFrame& frame, const marker::BlobList& blobs,
            marker::Detections& found);

 private:
  /// What one core works with, and what it has found in this frame.
  struct Part {
    marker::MarkerDetector detector;
    marker::Detections piece;
    marker::BlobCounts blobs;
    std::uint32_t count;
    std::array<std::uint32_t, marker::max_detections> pieces;  ///< where each was found, ascending
    std::array<marker::Detection, marker::max_detections> markers;
  };

  static void run_second();
  bool take(std::uint32_t& piece);
  void work(Part& part);
  void keep(Part& part, std::uint32_t piece) const;
  void merge(marker::Detections& found) const;

  bool poses_;  ///< of each marker: there is no board
  std::array<Part, 2> parts_;

  // The frame under way: core 0 writes it before it asks.
  const marker::CameraFrame* frame_;
  marker::BlobList blobs_;
  std::uint32_t blobs_each_;  ///< in a piece
  hal_lock lock_;
  std::uint32_t next_;  ///< piece; under the lock

  volatile std::uint32_t asked_, answered_;  ///< frames that the second core was given, and did
};

}  // namespace improved
