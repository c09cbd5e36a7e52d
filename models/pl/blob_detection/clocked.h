#pragma once

#include <cstdint>

#include <pl/blob_detection/blob_detection.h>
#include <pl/blob_detection/core.h>
#include <vp/probe.h>

namespace pl {

/// Blob Detection, clocked.
class BlobDetectionClocked : public BlobDetection {
 public:
  BlobDetectionClocked(sc_core::sc_module_name name, vp::Clock& clk, const Geometry& geometry);

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

}  // namespace pl
