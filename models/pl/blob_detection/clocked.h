#pragma once

#include <cstdint>

#include <pl/blob_detection/core.h>
#include <vp/clock.h>
#include <vp/parameter.h>
#include <vp/probe.h>

namespace pl {

/// Blob Detection, clocked (thesis 4.3.6, ports of table B.3, and `idle`, decision).
class BlobDetectionClocked : public vp::Clocked {
 public:
  BlobDetectionClocked(sc_core::sc_module_name name, vp::Clock& clk, const Geometry& geometry);

  vp::In<bool> ena{"ena", this};
  vp::In<bool> rst{"rst", this};
  vp::In<bool> pixel{"pixel", this};  ///< 1 is dark
  vp::In<std::uint16_t> x{"x", this};
  vp::In<std::uint16_t> y{"y", this};
  vp::Signal<bool> blob_out{"blob_out"};
  vp::Signal<std::uint32_t> blob_start{"blob_start"};
  vp::Signal<std::uint32_t> blob_end{"blob_end"};
  vp::Signal<bool> idle{"idle", 1, true};  ///< no frame, and every label retired
  /// Dark pixels that found no free label since the last reset.
  vp::Signal<std::uint32_t> label_overflow{"label_overflow"};

  vp::Parameter<std::uint32_t> label_count{
      "label_count",
      128,
      vp::Unit::none,
      {4, 1024},
      vp::Source::decision,
      "labels, the background's included; the thesis does not give its number"};
  vp::Parameter<std::uint32_t> minimum_side{
      "minimum_side",
      24,
      vp::Unit::pixels,
      {1, 1023},
      vp::Source::published,
      "smallest Ex - Sx and Ey - Sy of a blob that is reported (thesis 4.3.6.4)"};

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
