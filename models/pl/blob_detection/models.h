#pragma once

#include <cstdint>
#include <vector>

#include <pl/blob_detection/blob_detection.h>
#include <pl/blob_detection/core.h>
#include <pl/blob_detection/frame.h>
#include <vp/probe.h>

namespace pl {

/// Blob Detection clock by clock.
class BlobDetectionClocked : public BlobDetection {
 public:
  BlobDetectionClocked(sc_core::sc_module_name name, const Site& site)
      : BlobDetection(name, site), core_(geometry_, label_count) {}

  const BlobCore& core() const { return core_; }

 private:
  void edge() override;
  void reset();
  /// True if the label that retired last is large enough: its packets stand then.
  bool filter();

  BlobCore core_;
  bool retired_ = false;  ///< the core retired a label in the last clock
  bool ena_before_ = false;
  std::uint32_t number_ = 0;
  vp::Probe<BlobCore::Label> label_{"label", [this] { return core_.label(); }, 10};
  vp::Probe<BlobCore::Label> next_label_{"next_label", [this] { return core_.next_label(); }, 10};
  vp::Probe<std::uint32_t> free_labels_{"free_labels", [this] { return core_.free_labels(); }, 11};
  vp::Probe<bool> flush_{"flush", [this] { return core_.flushing(); }};
  vp::Probe<std::uint32_t> number_probe_{"number", number_, 11};
};

/// Blob Detection at transaction level: finds a frame's blobs when it begins, and shows each on its
/// clock.
///
/// `rst` is the threshold's, too.
class BlobDetectionTlm final : public BlobDetection, private FrameListener {
 public:
  BlobDetectionTlm(sc_core::sc_module_name name, const Site& site);

  void settle() override;

 private:
  void end_of_elaboration() override;
  void edge() override;
  void pixels_changed(std::uint32_t first, std::uint32_t count) override;
  void reset();
  void begin(std::uint64_t cycle);
  void catch_up(std::uint64_t cycle);
  void find();
  void find_again(std::uint64_t cycle);
  void stamp(std::size_t from);
  void forget_before(std::uint64_t cycle, std::size_t from);
  void emit(std::uint64_t cycle);
  std::uint64_t next_change(std::uint64_t cycle) const;
  std::uint64_t frame_end() const { return begin_ + geometry_.pixels(); }

  BlobFrame frame_;                 ///< after the frame's last pixel
  BlobFrame start_;                 ///< at its begin, to find it again
  BlobFrame rest_;                  ///< behind its end
  std::vector<StampedBlob> blobs_;  ///< stamped with cycles; those to come from next_ on
  std::size_t next_ = 0;
  bool ena_before_ = false;
  bool begun_ = false;                              ///< a frame since the last reset
  std::uint64_t begin_ = 0;                         ///< edge that takes the frame's first pixel
  std::uint64_t idle_cycle_ = 0;                    ///< edge from which on nothing is busy
  std::uint64_t changed_cycle_ = vp::Clock::never;  ///< edge that takes the first changed pixel
};

}  // namespace pl
