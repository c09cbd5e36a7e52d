#pragma once

#include <apps/improved/both_cores.h>
#include <apps/improved/capture.h>
#include <apps/improved/frame_optics.h>
#include <apps/improved/options.h>
#include <apps/improved/own_dictionary.h>
#include <hal/hal.h>
#include <marker/blob_packet.h>
#include <marker/detection_result.h>
#include <marker/local_blobs.h>
#include <marker/marker_detector.h>
#include <marker/pose_filter.h>

#include <array>
#include <cstdint>

namespace improved {

/// The PS side of the design `improved`: the logic sends each frame's picture and its blobs into
/// memory, and takes the next frame into other buffers while the software works on this one.
class Application {
 public:
  /// Works on all frames of the run. 0: every frame went well; 1: some did not, the console says
  /// which and why.
  int run();

 private:
  /// A frame under way.
  struct Slot {
    Buffers buffers;
    hal_frame frame;
    Status status;                    ///< so far
    std::uint64_t started, captured;  ///< counts of the global timer
    DmaStatus dma;                    ///< of a frame that went wrong
    marker::BlobPacket packet;
  };

  bool initialise();
  void open_filter();
  bool begin_next();
  Status admit(const Slot& slot);
  void finish(Slot& slot);
  Status read_packet(Slot& slot);
  void process(Slot& slot);
  void find_markers(const Slot& slot);
  bool look_behind(const marker::CameraFrame& picture, const marker::BlobList& logic);
  void report(const Slot& slot) const;

  Capture capture_;
  Options options_;
  std::array<Slot, 2> slots_;
  std::uint32_t next_slot_;
  bool knows_camera_frame_;     ///< false after a failed frame
  std::uint32_t camera_frame_;  ///< the number of the last one
  OwnDictionary dictionary_;
  marker::MarkerDetector detector_;
  marker::PoseFilter pose_filter_;
  double seconds_per_count_;  ///< of the global timer; with the filter only
  BothCores both_cores_;
  FrameOptics optics_;
  marker::LocalBlobs local_blobs_;
  marker::DetectionResult result_;
};

}  // namespace improved
