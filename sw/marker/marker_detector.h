#pragma once

#include <marker/board_pose.h>
#include <marker/camera.h>
#include <marker/code_book.h>
#include <marker/images.h>
#include <marker/marker_reader.h>
#include <marker/optics.h>

#include <array>
#include <cstdint>

namespace marker {

/// Blobs as the logic sends them (blob_stream.h), at rest in memory.
struct BlobList {
  const std::uint32_t* words;
  std::uint32_t count;  ///< blobs
};

/// Which places the markers have to each other.
struct Board {
  enum class Kind : std::uint32_t { none, grid, charuco };

  Kind kind = Kind::none;
  double marker_side = 0.3;  ///< m, where the markers stand alone
  GridBoard grid{};
  CharucoBoard charuco{};

  /// The corners of a marker on the board. False if the board does not have it, or without a board.
  bool find(std::uint32_t id, Places& places) const;
};

struct DetectorOptions {
  DetectionOptions detection;
  /// A blob whose box is narrower or lower is not looked at, px: six cells of the smallest size
  /// that can be measured.
  std::uint32_t minimum_side = 9;
  Board board;
};

/// What became of a frame's blobs. Each is in exactly one count, or among the markers.
struct BlobCounts {
  std::uint32_t received;
  std::uint32_t malformed;  ///< outside of the picture, or no extremes of any blob
  std::uint32_t small;
  std::array<std::uint32_t, refusal_count> refused;  ///< by Refusal
  std::uint32_t lost;                                ///< markers for which there was no room
  std::uint32_t background;  ///< of those refused: what is around the markers
};

/// More markers of a frame are counted as lost.
inline constexpr std::uint32_t max_detections = 256;

/// How a pose moves, along and about the camera's axes. A filter tells it (PoseFilter).
struct PoseMotion {
  std::uint32_t frames;             ///< that the pose is made of; 0: no filter
  std::array<double, 3> velocity;   ///< m/s
  std::array<double, 3> turn_rate;  ///< rad/s
};

struct Detection {
  DetectedMarker marker;
  BoardPoses pose;  ///< of the marker alone; not valid where a board is looked for
  PoseMotion motion;
};

/// How the grey levels of a frame were taken for light.
struct ResponseUse {
  bool is_said;  ///< false: levels are known to be light
  ResponseOrigin origin;
  double exponent;  ///< of what was found; 0: none was
};

/// All that was found in a frame.
struct Detections {
  ResponseUse response;
  BlobCounts blobs;
  BoardPoses board;             ///< not valid: no board was asked for, or none is seen
  std::uint32_t board_markers;  ///< used for its pose
  PoseMotion board_motion;
  std::uint32_t count;
  std::array<Detection, max_detections> markers;  ///< in the order of the blobs
};

/// Makes `found` that of a new frame. Markers beyond the count keep what they held.
inline void clear(Detections& found) {
  found.response = {};
  found.blobs = {};
  found.board.valid = false;
  found.board_markers = found.count = 0;
  found.board_motion = {};
}

/// Adds a marker to those of the frame. Something that lies across a marker may cut it into two
/// blobs, both of which lead to it: the one with the smaller variance stays, in the place of the
/// first. Each blob is counted.
void add_marker(const Detection& marker, Detections& found);

/// From the blobs of a frame to its markers, and from those to poses.
///
/// What a blob's words can decide is decided before a pixel is read: in a picture in DMA memory,
/// each pixel read costs a cache line.
class MarkerDetector {
 public:
  /// The dictionary must outlive the detector.
  void open(const Dictionary& dictionary, const DetectorOptions& options);

  /// Finds the markers; `found` has no poses yet. The words may hold anything.
  void find_markers(const CameraFrame& frame, const BlobList& blobs, Detections& found);

  /// Finds further ones in other blobs of the same frame.
  void add_markers(const CameraFrame& frame, const BlobList& blobs, Detections& found);

  /// Measures those markers once more, as the frame's optics are now: poses are to be found anew.
  void measure_again(const CameraFrame& frame, Detections& found) const;

  /// The pose of each marker, or of the board. If an ID is seen more than once, it is unknown which
  /// one is the board's: none of them counts.
  void find_poses(const Camera& camera, Detections& found);

 private:
  /// `near`: of which no more is looked at than what is around the blob.
  Refusal read_blob(const CameraFrame& near, const Extremes& extremes,
                    DetectedMarker& marker) const;
  /// A blob that is no quadrilateral itself, or too narrow a one.
  bool read_outline(const CameraFrame& near, const Extremes& extremes,
                    DetectedMarker& marker) const;

  CodeBook book_;
  DetectorOptions options_;
  std::array<SeenMarker, max_detections> seen_;
};

}  // namespace marker
