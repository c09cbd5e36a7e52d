#include <pl/blob_labelling/blob_labelling.h>

#include <algorithm>
#include <string>

#include <pl/blob_labelling/core.h>
#include <pl/blob_labelling/group_core.h>
#include <pl/common/estimate.h>
#include <pl/common/rtl_model.h>
#include <vp/report.h>

namespace pl {

Models<BlobLabelling>& BlobLabelling::models() {
  static Models<BlobLabelling> models{
      "blob_labelling",
      {model<BlobLabelling, BlobLabellingClocked>("clocked", by_pixel, no_image),
       model<BlobLabelling, BlobLabellingTlm>("tlm", by_frame, no_image)},
      rtl_model<BlobLabelling, BlobLabellingClocked>()};
  return models;
}

BlobLabelling::BlobLabelling(sc_core::sc_module_name name, const Site& site)
    : Clocked(name, site.clk),
      Ip(&site.clk),
      more_pixels("pixel", site.geometry.pixels_per_clock, this),
      geometry_(site.geometry) {
  wake_on(ena);
  wake_on(rst);
}

void BlobLabelling::connect(IpPorts& ports) {
  ports.input(ena);
  ports.input(rst);
  ports.input(pixel, more_pixels);
  ports.input(x, geometry_.words().x_bits());
  ports.input(y, geometry_.words().y_bits());
  ports.output(blob_out);
  for (vp::Signal<std::uint32_t>& point : extreme) ports.output(point, &blob_out);
  ports.output(idle);
  ports.report(label_overflow);
  ports.outputs.back().fixed = never_runs_out();
  ports.parameter("WIDTH", "pl.width", geometry_.width);
  ports.parameter("HEIGHT", "pl.height", geometry_.height);
  ports.parameter("LABELS", label_count.name(), label_count);
  ports.parameter("MINIMUM_SIDE", minimum_side.name(), minimum_side);
  ports.pixels_per_clock(geometry_.pixels_per_clock);
  if (geometry_.pixels_per_clock > 1)
    ports.parameter("RUN_FIFO_DEPTH", run_fifo_depth.name(), run_fifo_depth);
}

// Labels in use are those of components that are open, one for each two pixels of a row, and those
// that wait to leave. These are the most behind a row in which blobs that are shown end, three
// pixels apart, and then small ones: shown ones leave in 8 clocks, others in 2. With three quarters
// of the row for the former, an eighth of the width waits while the next row opens its components
// (blob_labelling_test.cpp plays that). The bound leaves as much again, and some for the pipeline.
bool BlobLabelling::never_runs_out(std::uint32_t pixels_per_clock, std::uint32_t width,
                                   std::uint32_t labels, std::uint32_t minimum_side) {
  constexpr std::uint32_t low_side = 10, pipeline = 8;
  return pixels_per_clock == 1 && minimum_side >= low_side && labels > width * 3 / 4 + pipeline;
}

bool BlobLabelling::never_runs_out() const {
  return never_runs_out(geometry_.pixels_per_clock, geometry_.width, label_count, minimum_side);
}

void BlobLabelling::show(const Extremes& extremes) {
  for (std::size_t i = 0; i < blob_stream::words_per_blob; ++i) extreme[i] = extremes.point(i);
}

void BlobLabelling::refuse(const std::string& why) const {
  vp::error(*this, "/markervp/blob_labelling/frame", why);
}

std::string BlobLabelling::too_early() const {
  return "a frame begins too early: " +
         (geometry_.pixels_per_clock == 1
              ? std::to_string(geometry_.width + 1) +
                    " clocks must lie behind the last pixel of the one before"
              : "the runs of the one before still wait for their turn");
}

namespace {

std::unique_ptr<RunLabeller> make_core(const Geometry& geometry, std::uint32_t labels,
                                       std::uint32_t minimum_side, std::uint32_t fifo_depth) {
  if (geometry.pixels_per_clock == 1)
    return std::make_unique<LabellingCore>(geometry, labels, minimum_side);
  return std::make_unique<GroupLabellingCore>(geometry, labels, minimum_side, fifo_depth);
}

}  // namespace

BlobLabellingClocked::BlobLabellingClocked(sc_core::sc_module_name name, const Site& site)
    : BlobLabelling(name, site),
      core_(make_core(geometry_, label_count, minimum_side, run_fifo_depth)) {}

void BlobLabellingClocked::edge() {
  if (rst) return reset();
  const bool frame = ena;
  if (frame) check_place();
  std::uint32_t dark = pixel;
  for (std::uint32_t lane = 1; lane < geometry_.pixels_per_clock; ++lane)
    dark |= std::uint32_t{more_pixels[lane - 1]} << lane;
  core_->clock(frame, dark, x, y);
  blob_out = core_->shows();
  if (core_->shows()) show(core_->shown());
  idle = core_->idle();
  if (core_->overflow() != label_overflow) label_overflow = core_->overflow();
  if (!frame && core_->quiescent()) sleep();
}

void BlobLabellingClocked::check_place() {
  if (next_pixel_ == 0 && !core_->ready()) refuse(too_early());
  const std::uint32_t place = y * geometry_.width + x;
  if (x >= geometry_.width || place != next_pixel_) {
    refuse("pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") came, but (" +
           std::to_string(next_pixel_ % geometry_.width) + ", " +
           std::to_string(next_pixel_ / geometry_.width) +
           ") is the next one: frames are whole, unless rst cuts them");
  }
  next_pixel_ += geometry_.pixels_per_clock;
  if (next_pixel_ == geometry_.pixels()) next_pixel_ = 0;
}

void BlobLabellingClocked::reset() {
  core_->reset();
  next_pixel_ = 0;
  blob_out = false;
  idle = true;
  label_overflow = 0;
  sleep();
}

vp::IpEstimate BlobLabelling::own_estimate() const {
  return synthesised_ip("blob_labelling", {{"LABELS", label_count},
                                           {"PIXELS_PER_CLOCK", geometry_.pixels_per_clock},
                                           {"WIDTH", geometry_.width}});
}

BlobLabellingTlm::BlobLabellingTlm(sc_core::sc_module_name name, const Site& site)
    : BlobLabelling(name, site),
      frame_(geometry_, minimum_side, run_fifo_depth),
      queue_(label_count),
      queue_before_(queue_) {}

void BlobLabellingTlm::end_of_elaboration() {
  BlobLabelling::end_of_elaboration();
  frames.channel().add_listener(*this);
}

void BlobLabellingTlm::edge() {
  sleep();
  if (rst) return reset();
  const std::uint64_t cycle = clock().cycle();
  if (ena && !ena_before_) begin(cycle);
  ena_before_ = ena;
  if (cycle >= changed_cycle_) find_again(cycle);
  emit(cycle);
  idle = cycle >= idle_cycle_;
  label_overflow = lost_until(cycle);
  wake_at(next_change(cycle));
}

void BlobLabellingTlm::settle() {
  if (begun_) label_overflow = lost_until(clock().cycle());
}

void BlobLabellingTlm::emit(std::uint64_t cycle) {
  const bool leaves = next_ < blobs_.size() && blobs_[next_].clock == cycle;
  if (leaves) show(blobs_[next_++].extremes);
  blob_out = leaves;
}

std::uint64_t BlobLabellingTlm::next_change(std::uint64_t cycle) const {
  if (blob_out.written()) return cycle + 1;
  const std::uint64_t blob = next_ < blobs_.size() ? blobs_[next_].clock : vp::Clock::never;
  const std::uint64_t idle_from = cycle < idle_cycle_ ? idle_cycle_ : vp::Clock::never;
  return std::min({blob, idle_from, changed_cycle_});
}

std::uint32_t BlobLabellingTlm::lost_until(std::uint64_t cycle) const {
  const auto later = std::upper_bound(
      losses_.begin(), losses_.end(), cycle,
      [](std::uint64_t clock, const StampedLoss& loss) { return clock < loss.clock; });
  return lost_before_ + (later == losses_.begin() ? 0 : std::prev(later)->lost);
}

// Blobs of the frame before may still wait to be shown.
void BlobLabellingTlm::begin(std::uint64_t cycle) {
  if (begun_ && cycle < frame_.next_from()) refuse(too_early());
  blobs_.erase(blobs_.begin(), blobs_.begin() + static_cast<std::ptrdiff_t>(next_));
  next_ = 0;
  first_ = blobs_.size();
  lost_before_ = lost_until(cycle);
  queue_before_ = queue_;
  begun_ = true;
  begin_ = cycle;
  changed_cycle_ = vp::Clock::never;
  find();
}

void BlobLabellingTlm::find() {
  losses_.clear();
  frame_.find(frames->data(), begin_, queue_, blobs_, losses_);
  idle_cycle_ = std::max(frame_.done_from(), queue_.empty_from());
}

void BlobLabellingTlm::pixels_changed(std::uint32_t first, std::uint32_t) {
  // A pixel of a frame that begins here only in the next clock is not known yet.
  if (!begun_ || taken_at(first) <= clock().cycle()) return;
  changed_cycle_ = std::min(changed_cycle_, taken_at(first));
  wake_at(next_change(clock().cycle()));
}

// What was shown until now follows from pixels that did not change: it is found as before.
void BlobLabellingTlm::find_again(std::uint64_t cycle) {
  changed_cycle_ = vp::Clock::never;
  blobs_.resize(first_);
  queue_ = queue_before_;
  find();
  while (next_ < blobs_.size() && blobs_[next_].clock < cycle) ++next_;
}

void BlobLabellingTlm::reset() {
  queue_ = LabelQueue(label_count);
  blobs_.clear();
  losses_.clear();
  next_ = first_ = 0;
  lost_before_ = 0;
  ena_before_ = begun_ = false;
  idle_cycle_ = 0;
  changed_cycle_ = vp::Clock::never;
  blob_out = false;
  idle = true;
  label_overflow = 0;
  wake_at(vp::Clock::never);
}

}  // namespace pl
