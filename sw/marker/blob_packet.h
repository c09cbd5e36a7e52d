#pragma once

#include <marker/detection_result.h>
#include <marker/marker_detector.h>

#include <cstdint>

namespace marker {

/// A packet with the blobs of a frame as it lies in memory, and what its trailer says
/// (blob_stream.h).
struct BlobPacket {
  BlobList blobs;
  std::uint32_t camera_frame;  ///< the number that the camera gave the frame
  std::uint32_t lost;          ///< blob_stream::lost
  std::uint32_t threshold;     ///< grey level with which the frame was made binary

  /// Takes the packet of so many blobs at `words`, with its trailer, which stays there.
  /// `malformed_packet` if it says another number of blobs, `wrong_checksum` if it has a checksum
  /// that does not fit its words.
  DetectionStatus read(const std::uint32_t* words, std::uint32_t count);
};

/// The sum of a packet's words (blob_stream::add_to_sum).
std::uint32_t packet_sum(const std::uint32_t* words, std::uint32_t count);

}  // namespace marker
