#include <pl/local_threshold/local_threshold.h>

#include <algorithm>
#include <string>

#include <marker_logic.h>
#include <pl/common/estimate.h>
#include <pl/common/rtl_model.h>
#include <vp/error.h>
#include <vp/report.h>

namespace pl {

namespace {

class LocalThresholdClocked : public LocalThreshold {
 public:
  LocalThresholdClocked(sc_core::sc_module_name name, const Site& site)
      : LocalThreshold(name, site), core_(geometry_, radius) {}

 private:
  void edge() override;
  void begin();
  void move_pipeline();
  void take_pixels();

  LocalThresholdCore core_;
  std::uint64_t taken_ = 0;     ///< clocks since the frame began: pixels, then nothing
  bool running_ = false;        ///< a frame goes in, or leaves
  std::uint32_t pipeline_ = 0;  ///< whether the pixels that left the window last are dark
};

void LocalThresholdClocked::edge() {
  if (resets()) {
    running_ = false;
    return sleep();
  }
  const std::uint64_t frame = geometry_.clocks();
  if (taken_ == frame + lag()) running_ = false;
  if (frame_ena && (!running_ || taken_ >= frame)) begin();
  if (running_ && !frame_ena && taken_ < frame) refuse(cut);
  if (running_) move_pipeline();
  binary_ena = running_ && taken_ > lag();
  if (!running_) sleep();
}

void LocalThresholdClocked::begin() {
  if (running_) refuse(too_early);
  running_ = true;
  taken_ = 0;
  core_.begin(rule());
}

void LocalThresholdClocked::move_pipeline() {
  take_pixels();
  if (taken_ >= lag()) {
    const std::uint32_t a_clock = geometry_.pixels_per_clock;
    const auto place = static_cast<std::uint32_t>(taken_ - lag()) * a_clock;
    const std::uint32_t leaving =
        pipeline_ >> pipeline_clocks() * a_clock;  // the last one in bit 0
    binary_out = (leaving >> (a_clock - 1) & 1) != 0;
    for (std::uint32_t lane = 1; lane < a_clock; ++lane)
      more_binary[lane - 1] = (leaving >> (a_clock - 1 - lane) & 1) != 0;
    binary_x = static_cast<std::uint16_t>(place % geometry_.width);
    binary_y = static_cast<std::uint16_t>(place / geometry_.width);
  }
  ++taken_;
}

void LocalThresholdClocked::take_pixels() {
  for (std::uint32_t lane = 0; lane < geometry_.pixels_per_clock; ++lane) {
    if (taken_ < geometry_.clocks()) {
      core_.push(lane == 0 ? pixel : more_pixels[lane - 1]);
    } else {
      core_.push_nothing();
    }
    pipeline_ = pipeline_ << 1 | std::uint32_t{core_.dark()};
  }
}

/// A frame's binary image when the frame begins; it leaves later, as a whole.
class LocalThresholdTlm final : public LocalThreshold, private FrameListener {
 public:
  LocalThresholdTlm(sc_core::sc_module_name name, const Site& site) : LocalThreshold(name, site) {}

 private:
  void end_of_elaboration() override {
    LocalThreshold::end_of_elaboration();
    frames.channel().add_listener(*this);
  }
  void edge() override;
  void begin(std::uint64_t cycle);
  void pixels_changed(std::uint32_t first, std::uint32_t count) override;

  std::uint64_t first_cycle_ = vp::Clock::never;  ///< edge that takes the frame's first pixel
  bool taking_ = false;                           ///< pixels go in
  LocalRule rule_;
  std::vector<std::uint32_t> words_;
};

void LocalThresholdTlm::edge() {
  sleep();
  if (resets()) {
    binary_frames.cut();
    first_cycle_ = vp::Clock::never;
    taking_ = false;
    return wake_at(vp::Clock::never);
  }
  const std::uint64_t cycle = clock().cycle();
  if (frame_ena && !taking_) begin(cycle);
  if (!frame_ena && taking_ && cycle < first_cycle_ + geometry_.clocks()) refuse(cut);
  taking_ = frame_ena;
  if (first_cycle_ == vp::Clock::never) return wake_at(vp::Clock::never);
  const std::uint64_t leaves = first_cycle_ + lag(), left = leaves + geometry_.clocks();
  binary_ena = leaves <= cycle && cycle < left;
  wake_at(cycle < leaves ? leaves : cycle < left ? left : vp::Clock::never);
}

void LocalThresholdTlm::begin(std::uint64_t cycle) {
  if (first_cycle_ != vp::Clock::never && cycle < first_cycle_ + geometry_.clocks() + lag())
    refuse(too_early);
  first_cycle_ = cycle;
  rule_ = rule();
  binary_frames.announce();
  find_dark(frames->data(), geometry_, rule_, words_);
  binary_frames.begin(words_.data(), static_cast<std::uint32_t>(words_.size()), cycle + lag(),
                      geometry_.pixels_per_clock);
}

void LocalThresholdTlm::pixels_changed(std::uint32_t first, std::uint32_t) {
  // A pixel of a frame that begins here only in the next clocks is not known yet.
  if (!taking_ || first_cycle_ + first / geometry_.pixels_per_clock <= clock().cycle()) return;
  find_dark(frames->data(), geometry_, rule_, words_);
  const std::uint32_t before = LocalThresholdCore::lag(geometry_, radius);
  const std::uint32_t from = std::max(first, before) - before;
  binary_frames.change(from, geometry_.pixels() - from);
}

}  // namespace

Models<GlobalThreshold>& LocalThreshold::models() {
  static Models<GlobalThreshold> models{
      "local_threshold",
      {model<GlobalThreshold, LocalThresholdClocked>("clocked", by_pixel, by_pixel),
       model<GlobalThreshold, LocalThresholdTlm>("tlm", by_frame, by_frame)},
      rtl_model<GlobalThreshold, LocalThresholdClocked, RtlModel<LocalThreshold>>()};
  return models;
}

void LocalThreshold::connect(IpPorts& ports) {
  GlobalThreshold::connect(ports);
  for (IpPorts::Output& output : ports.outputs) {
    // No words leave this one.
    output.fixed = output.name == "thresh_out" || output.name == "thresh_data";
  }
  ports.parameter("RADIUS", radius.name(), radius);
  ports.parameter("OFFSET", offset.name(), offset);
  ports.parameter("RELATIVE", relative.name(), relative);
}

// The next frame may come at once behind the lag, and the window turns into the next row while the
// last one leaves: it must be narrower than both, by the pixels that come beside the last one, too.
LocalThreshold::LocalThreshold(sc_core::sc_module_name name, const Site& site)
    : GlobalThreshold(name, site) {
  wake_on(threshold);
  const std::uint32_t window = 2 * radius + 1, beside = geometry_.pixels_per_clock - 1,
                      least = std::min(geometry_.width - beside, geometry_.height);
  if (window < least) return;
  throw vp::InputError(std::string(radius.name()) + ": a window of " + std::to_string(window) +
                       " px does not fit into frames of " + std::to_string(geometry_.width) + "x" +
                       std::to_string(geometry_.height) + ": " + std::to_string((least - 2) / 2) +
                       " px at most");
}

bool LocalThreshold::resets() {
  if (por) level_ = 0;
  const bool reset = por || rst;
  if (!reset && wr_thresh) level_ = threshold;
  active_threshold = level_;
  if (reset) binary_ena = false;
  return reset;
}

void LocalThreshold::refuse(const std::string& why) const {
  vp::error(*this, "/markervp/local_threshold/frame",
            why + ": a frame takes " + std::to_string(geometry_.clocks() + lag()) + " clocks here");
}

namespace {

/// What is synthesised; a share of another power of two takes the same logic.
constexpr std::int64_t usual_relative = 3;

}  // namespace

// The pixels of the window's rows, before and behind its middle, and the sums of all columns, as
// wide as what a clock brings.
vp::IpEstimate LocalThreshold::own_estimate() const {
  const std::uint32_t pixels = geometry_.pixels_per_clock;
  vp::IpEstimate e =
      synthesised_ip("local_threshold", {{"PIXELS_PER_CLOCK", pixels},
                                         {"RADIUS", radius},
                                         {"RELATIVE", relative == 0 ? 0 : usual_relative}});
  const std::uint32_t window = 2 * radius + 1, row = geometry_.clocks_per_row();
  const std::uint32_t lag = LocalThresholdCore::lag(geometry_, radius) / pixels;
  e.bram36 = xilinx::block_ram_36(lag, 8 * pixels) +
             xilinx::block_ram_36(window * row - lag, 8 * pixels) +
             xilinx::block_ram_36(row, marker_logic::bits_for(255 * window + 1, 1) * pixels);
  return e;
}

}  // namespace pl
