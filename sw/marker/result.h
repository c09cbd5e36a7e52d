#pragma once

#include <hal/hal.h>
#include <marker/feature_evaluation.h>
#include <marker/identification.h>
#include <marker/posit.h>

#include <array>
#include <cstdint>
#include <type_traits>

namespace marker {

/// How a frame went. Not `ok`: what was received until then is in the result, and no marker was
/// looked for.
enum class Status : std::uint32_t {
  ok = 0,
  unsupported_size,   ///< the PL's packet format or whole bursts do not allow it
  no_memory,          ///< no DMA memory for the binary image
  upload_error,       ///< DMA 0 reported an error
  upload_timeout,     ///< DMA 0 did not finish in time
  feature_timeout,    ///< no new feature word in time
  too_many_features,  ///< the word store was full before the end word
  binary_error,       ///< DMA 1 reported an error
  binary_timeout,     ///< the binary image did not become complete in time
};

constexpr const char* status_name(Status status) {
  switch (status) {
    case Status::ok:
      return "ok";
    case Status::unsupported_size:
      return "unsupported size";
    case Status::no_memory:
      return "no DMA memory";
    case Status::upload_error:
      return "DMA error during the upload";
    case Status::upload_timeout:
      return "upload timed out";
    case Status::feature_timeout:
      return "feature words timed out";
    case Status::too_many_features:
      return "too many features";
    case Status::binary_error:
      return "DMA error in the binary image";
    case Status::binary_timeout:
      return "binary image timed out";
  }
  return "unknown";
}

/// One stage in counts of the global timer (2 CPU cycles each). 0, 0: the stage was not reached.
struct StageTime {
  std::uint64_t start, end;
};

/// The stages follow each other; `frame` reaches from the start of feature_extraction to the end of
/// pose. Stages that a system does not have are 0, 0.
struct StageTimes {
  StageTime upload;              ///< image into the PL (thesis 4.5.1.1)
  StageTime feature_extraction;  ///< `ena` to the end word (thesis 4.5.1.3); on the PS the four
                                 ///< stages at the end of this list together
  StageTime receive;     ///< rest of the binary image, cache maintenance, decoding (4.5.1.2, 4.5.2)
  StageTime evaluation;  ///< algorithm 1 (4.5.3)
  StageTime
      identification;  ///< rectification and identification until the first marker (4.5.4, 4.5.5)
  StageTime pose;      ///< POSIT (4.5.6)
  StageTime frame;
  // Features found on the PS.
  StageTime capture;           ///< the camera's frame into memory (thesis 5.4)
  StageTime corner_detection;  ///< FAST
  StageTime threshold;         ///< binary image and histogram
  StageTime blob_detection;    ///< grouping
};

/// A marker with its pose.
struct Marker {
  std::uint32_t candidate;  ///< index into FrameResult::candidates
  Identification identity;
  Quad corners;  ///< px, centre of pixel (0, 0) at (0.5, 0.5), clockwise from the marker's own top
                 ///< left
  Pose pose;
};

/// Markers of one frame. The first marker found ends the search, so one is used by the thesis'
/// software.
inline constexpr std::uint32_t max_markers = 16;

/// All that a program knows of a frame, handed to the test bench.
struct FrameResult {
  std::uint32_t frame;  ///< hal_frame.index
  Status status;
  std::uint32_t width, height;   ///< px
  std::uint32_t feature_words;   ///< received, the end word and those without room included
  std::uint32_t lost_words;      ///< of them, those without room
  std::uint32_t binary_packets;  ///< packets of 32 words that arrived in memory
  std::uint32_t examined;        ///< candidates rectified
  FeatureSet features;           ///< corners and boxes, with the counts of those lost
  CandidateList candidates;
  std::uint32_t marker_count;
  std::array<Marker, max_markers> markers;
  StageTimes times;
  // Known to the software only where it finds the features itself.
  bool has_threshold;            ///< the next two are set
  std::uint32_t threshold;       ///< grey level with which the image was made binary
  std::uint32_t label_overflow;  ///< dark pixels that found no free label
};

static_assert(std::is_trivially_copyable_v<FrameResult>, "published as bytes");

/// The kind under which FrameResult is published.
inline constexpr std::uint32_t frame_result_kind = HAL_KIND('M', 'K', 'F', '2');

/// Makes `result` that of a new frame. Entries beyond the counts keep what they held.
inline void clear(FrameResult& result) {
  result.frame = result.width = result.height = 0;
  result.status = Status::ok;
  result.feature_words = result.lost_words = result.binary_packets = result.examined = 0;
  result.features.clear();
  result.candidates.count = result.candidates.lost = 0;
  result.marker_count = 0;
  result.times = {};
  result.has_threshold = false;
  result.threshold = result.label_overflow = 0;
}

}  // namespace marker
