#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <pl/blob_labelling/frame.h>
#include <pl/blob_labelling/run_labeller.h>
#include <pl/common/fidelity.h>
#include <pl/common/frame_channel.h>
#include <pl/common/lanes.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/probe.h>

namespace pl {

class IpPorts;

/// Blob Labelling: what Blob Detection is for in the design `improved`. One blob for each connected
/// component of dark pixels, with its eight outermost pixels.
///
/// Pixels come in raster order, one a clock or with any pause between them. A frame is whole unless
/// `rst` cuts it, and the next one begins at least width + 1 clocks behind its last pixel; anything
/// else ends the run with an error. A blob whose last run ends in column x of row y is shown 9
/// clocks behind the edge that takes pixel (x, y + 1), if nothing else waits; at most one is shown
/// in RunLabeller::clocks_per_blob clocks, in the order in which they are complete.
///
/// Where more than a pixel comes a clock, runs wait in a FIFO for their turn (GroupLabellingCore):
/// the blob is shown 10 clocks behind the edge that takes the end of the first run beyond (x, y +
/// 1), or of that row, if no other run waits, and the next frame begins when all runs had their
/// turn.
class BlobLabelling : public vp::Clocked, public vp::Ip {
 public:
  static Models<BlobLabelling>& models();

  vp::In<bool> ena{"ena", this};
  vp::In<bool> rst{"rst", this};
  // The image pixel by pixel.
  vp::In<bool> pixel{"pixel", this};  ///< 1 is dark
  Lanes<vp::In<bool>> more_pixels;
  vp::In<std::uint16_t> x{"x", this};
  vp::In<std::uint16_t> y{"y", this};
  FrameIn<BinaryFrames> frames{"frames"};  ///< the image as a whole
  vp::Signal<bool> blob_out{"blob_out"};   ///< for one clock
  /// The blob: a blob_stream::point() for each blob_stream::Extreme.
  vp::Signal<std::uint32_t> extreme[blob_stream::words_per_blob] = {
      vp::Signal<std::uint32_t>{"extreme_0"}, vp::Signal<std::uint32_t>{"extreme_1"},
      vp::Signal<std::uint32_t>{"extreme_2"}, vp::Signal<std::uint32_t>{"extreme_3"},
      vp::Signal<std::uint32_t>{"extreme_4"}, vp::Signal<std::uint32_t>{"extreme_5"},
      vp::Signal<std::uint32_t>{"extreme_6"}, vp::Signal<std::uint32_t>{"extreme_7"}};
  vp::Signal<bool> idle{"idle", 1, true};  ///< no frame, and every blob was shown
  /// Dark pixels of runs that found no free label, or no room in the FIFO of runs, since the last
  /// reset; complete when `idle` rises, and after settle().
  vp::Signal<std::uint32_t> label_overflow{"label_overflow"};

  vp::Parameter<std::uint32_t> label_count{
      "label_count",
      512,
      vp::Unit::none,
      {4, 2048},
      vp::Source::decision,
      "labels, one of which means none: blobs in the row that is looked at and those that wait to "
      "be shown; 512 fill the depth of a block memory"};
  vp::Parameter<std::uint32_t> run_fifo_depth{
      "run_fifo_depth",
      64,
      vp::Unit::none,
      {4, 4096},
      vp::Source::decision,
      "runs of dark pixels that wait where more than a pixel comes a clock: 64 fill the depth of a "
      "memory in LUT"};
  vp::Parameter<std::uint32_t> minimum_side{
      "minimum_side",       10,
      vp::Unit::pixels,     {1, 2047},
      vp::Source::decision, "smallest side of a blob's bounding box (last - first) that is shown"};

  /// Brings label_overflow up to now, in the middle of a frame, too.
  virtual void settle() {}

  /// Whether no picture can take more labels than there are: label_overflow stays 0 then. False
  /// where that is not known.
  static bool never_runs_out(std::uint32_t pixels_per_clock, std::uint32_t width,
                             std::uint32_t labels, std::uint32_t minimum_side);

 protected:
  BlobLabelling(sc_core::sc_module_name name, const Site& site);

  const Geometry geometry_;

  /// All ports but the clock, as RTL in its place has them.
  void connect(IpPorts& ports);
  void show(const Extremes& extremes);
  [[noreturn]] void refuse(const std::string& why) const;
  bool never_runs_out() const;
  /// What must lie behind a frame's last pixel.
  std::string too_early() const;

 private:
  vp::IpEstimate own_estimate() const override;
};

/// Blob Labelling clock by clock.
class BlobLabellingClocked : public BlobLabelling {
 public:
  BlobLabellingClocked(sc_core::sc_module_name name, const Site& site);

 private:
  void edge() override;
  void reset();
  void check_place();

  const std::unique_ptr<RunLabeller> core_;
  std::uint32_t next_pixel_ = 0;  ///< raster index of the frame's next one
  vp::Probe<std::uint16_t> label_{"label", [this] { return core_->label(); }, 11};
  vp::Probe<std::uint16_t> free_labels_{
      "free_labels", [this] { return static_cast<std::uint16_t>(core_->free_labels()); }, 12};
  vp::Probe<std::uint16_t> waiting_{
      "waiting", [this] { return static_cast<std::uint16_t>(core_->waiting()); }, 12};
  vp::Probe<std::uint16_t> open_components_{
      "open_components", [this] { return static_cast<std::uint16_t>(core_->open_components()); },
      11};
};

/// Blob Labelling at transaction level: finds a frame's blobs when it begins, and shows each on its
/// clock.
class BlobLabellingTlm final : public BlobLabelling, private FrameListener {
 public:
  BlobLabellingTlm(sc_core::sc_module_name name, const Site& site);

  void settle() override;

 private:
  void end_of_elaboration() override;
  void edge() override;
  void pixels_changed(std::uint32_t first, std::uint32_t count) override;
  void reset();
  void begin(std::uint64_t cycle);
  void find();
  void find_again(std::uint64_t cycle);
  void emit(std::uint64_t cycle);
  std::uint64_t next_change(std::uint64_t cycle) const;
  std::uint32_t lost_until(std::uint64_t cycle) const;
  /// The edge that takes this pixel.
  std::uint64_t taken_at(std::uint32_t pixel) const {
    return begin_ + pixel / geometry_.pixels_per_clock;
  }

  LabellingFrame frame_;
  LabelQueue queue_, queue_before_;     ///< after the frame; and before it, to find it again
  std::vector<StampedExtremes> blobs_;  ///< those to come from next_ on
  std::size_t next_ = 0;
  std::size_t first_ = 0;            ///< of the present frame in blobs_
  std::vector<StampedLoss> losses_;  ///< of the present frame
  std::uint32_t lost_before_ = 0;    ///< it began
  bool ena_before_ = false;
  bool begun_ = false;                              ///< a frame since the last reset
  std::uint64_t begin_ = 0;                         ///< edge that takes the frame's first pixel
  std::uint64_t idle_cycle_ = 0;                    ///< edge behind which nothing is busy
  std::uint64_t changed_cycle_ = vp::Clock::never;  ///< edge that takes the first changed pixel
};

}  // namespace pl
