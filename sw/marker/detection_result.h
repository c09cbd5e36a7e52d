#pragma once

#include <hal/hal.h>
#include <marker/marker_detector.h>
#include <marker/result.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace marker {

/// How a frame went. Not `ok`: no marker was looked for.
enum class DetectionStatus : std::uint32_t {
  ok = 0,
  unsupported_size,  ///< more than marker_logic allows, or than the DMA's LENGTH counts
  no_memory,         ///< no DMA memory for picture and packet
  timeout,           ///< no packet in time
  packet_error,      ///< the packet's DMA reported an error
  picture_error,     ///< the picture's DMA reported an error
  picture_cut,       ///< the picture has not the bytes that it should have
  malformed_packet,  ///< a length that no packet has, or another number of blobs than it says
  wrong_frame,       ///< of another trigger than the last one
  wrong_checksum,    ///< the packet's words are not those that the logic sent
};

constexpr const char* status_name(DetectionStatus status) {
  switch (status) {
    case DetectionStatus::ok:
      return "ok";
    case DetectionStatus::unsupported_size:
      return "unsupported size";
    case DetectionStatus::no_memory:
      return "no DMA memory";
    case DetectionStatus::timeout:
      return "no packet of blobs in time";
    case DetectionStatus::packet_error:
      return "DMA error in the packet of blobs";
    case DetectionStatus::picture_error:
      return "DMA error in the picture";
    case DetectionStatus::picture_cut:
      return "picture cut short";
    case DetectionStatus::malformed_packet:
      return "malformed packet of blobs";
    case DetectionStatus::wrong_frame:
      return "frame of another trigger";
    case DetectionStatus::wrong_checksum:
      return "packet of blobs with a wrong checksum";
  }
  return "unknown";
}

/// The stages of a frame. `detection` begins when the next frame was triggered, if frames overlap.
struct DetectionTimes {
  StageTime capture;  ///< from the trigger until picture and packet are in memory
  StageTime detection;
  StageTime pose;
  StageTime frame;  ///< from the trigger to the end of `pose`
};

/// All that a program of the design `improved` knows of a frame, handed to the test bench.
struct DetectionResult {
  std::uint32_t frame;  ///< hal_frame.index
  DetectionStatus status;
  std::uint32_t width, height;  ///< px
  std::uint32_t camera_frame;   ///< the number that the camera gave it
  std::uint32_t lost_in_logic;  ///< blob_stream::lost
  std::uint32_t threshold;      ///< grey level with which the frame was made binary
  DetectionTimes times;
  Detections found;  ///< last: only the markers that there are travel
};

static_assert(std::is_trivially_copyable_v<DetectionResult>, "published as bytes");

/// The kind under which DetectionResult is published.
inline constexpr std::uint32_t detection_result_kind = HAL_KIND('M', 'K', 'I', '4');

/// So much of a result is published.
inline std::size_t published_bytes(const DetectionResult& result) {
  const std::size_t room = max_detections - result.found.count;
  return sizeof result - room * sizeof(Detection);
}

}  // namespace marker
