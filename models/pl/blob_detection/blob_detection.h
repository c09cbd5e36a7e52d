#pragma once

#include <cstdint>
#include <vector>

#include <pl/blob_detection/core.h>
#include <pl/common/fidelity.h>
#include <pl/common/frame_channel.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/probe.h>

namespace pl {

class IpPorts;

/// Blob Detection (thesis 4.3.6, ports of table B.3, and `idle`, decision).
class BlobDetection : public vp::Clocked, public vp::Ip {
 public:
  static Models<BlobDetection>& models();

  vp::In<bool> ena{"ena", this};
  vp::In<bool> rst{"rst", this};
  // The image pixel by pixel.
  vp::In<bool> pixel{"pixel", this};  ///< 1 is dark
  vp::In<std::uint16_t> x{"x", this};
  vp::In<std::uint16_t> y{"y", this};
  FrameIn<BinaryFrames> frames{"frames"};  ///< the image as a whole
  vp::Signal<bool> blob_out{"blob_out"};
  vp::Signal<std::uint32_t> blob_start{"blob_start"};
  vp::Signal<std::uint32_t> blob_end{"blob_end"};
  vp::Signal<bool> idle{"idle", 1, true};  ///< no frame, and every label retired
  /// Dark pixels that found no free label since the last reset; complete at the end of the frame,
  /// and after settle().
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

  /// Brings label_overflow up to now, in the middle of a frame, too.
  virtual void settle() {}

 protected:
  BlobDetection(sc_core::sc_module_name name, const Site& site)
      : Clocked(name, site.clk), Ip(&site.clk), geometry_(site.geometry) {
    wake_on(ena);
    wake_on(rst);
  }

  const Geometry geometry_;

  /// All ports but the clock, as RTL in its place has them.
  void connect(IpPorts& ports);

 private:
  vp::IpEstimate own_estimate() const override;
};

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
