#include <pl/blob_detection/blob_detection.h>

#include <algorithm>

#include <pl/common/estimate.h>
#include <pl/common/rtl_model.h>

namespace pl {

Models<BlobDetection>& BlobDetection::models() {
  static Models<BlobDetection> models{
      "blob_detection",
      {model<BlobDetection, BlobDetectionClocked>("clocked", by_pixel, no_image),
       model<BlobDetection, BlobDetectionTlm>("tlm", by_frame, no_image)},
      rtl_model<BlobDetection, BlobDetectionClocked>()};
  return models;
}

void BlobDetection::connect(IpPorts& ports) {
  ports.input(ena);
  ports.input(rst);
  ports.input(pixel);
  ports.input(x, geometry_.words().x_bits());
  ports.input(y, geometry_.words().y_bits());
  ports.output(blob_out);
  ports.output(blob_start, &blob_out);
  ports.output(blob_end, &blob_out);
  ports.output(idle);
  ports.report(label_overflow);
  ports.parameter("WIDTH", "pl.width", geometry_.width);
  ports.parameter("LABELS", label_count.name(), label_count);
  ports.parameter("MINIMUM_SIDE", minimum_side.name(), minimum_side);
}

void BlobDetectionClocked::edge() {
  if (rst) {
    reset();
    return;
  }
  const bool frame = ena;
  blob_out = retired_ && filter();
  if (frame && !ena_before_) number_ = 0;
  ena_before_ = frame;
  retired_ = core_.step(frame, pixel, x, y);
  idle = !frame && !retired_ && !core_.flushing();
  if (core_.overflow() != label_overflow) label_overflow = core_.overflow();
  if (!frame && !retired_ && !blob_out.written() && core_.quiescent()) sleep();
}

bool BlobDetectionClocked::filter() {
  const BoundingBox& box = core_.retired();
  if (!box.at_least(minimum_side)) return false;
  blob_start = geometry_.words().blob_start(number_, box.sx, box.sy);
  blob_end = geometry_.words().blob_end(number_, box.ex, box.ey);
  ++number_;
  return true;
}

void BlobDetectionClocked::reset() {
  core_.reset();
  retired_ = ena_before_ = false;
  number_ = 0;
  blob_out = false;
  idle = true;
  label_overflow = 0;
  sleep();
}

namespace {

/// Labels for which the thesis' figures are taken to hold (decision: it does not give the number).
constexpr std::uint32_t thesis_labels = 128;
/// What the thesis finds the next label with, and the widest of the neighbours' blobs, in one
/// clock: a tree over all labels. With more of them it is not faster, with fewer not slower.
constexpr std::uint64_t thesis_hz = 55 * mhz;

}  // namespace

// Grows with the labels. Its power was measured for the whole module (thesis 4.6.1).
vp::IpEstimate BlobDetection::own_estimate() const {
  const std::uint32_t labels = label_count;
  std::uint32_t label_bits = 1;
  while ((std::uint64_t{1} << label_bits) < labels) ++label_bits;

  vp::IpEstimate e = rtl_ip("blob_detection", {{"LABELS", labels}});
  e.rtl.measured = {{"LABELS", thesis_labels}};
  e.includes_memory = true;
  e.bram36 = xilinx::block_ram_36(geometry_.width, label_bits);  // labels of the line above
  e.fmax_hz = labels <= thesis_labels ? thesis_hz : 0;
  e.fmax_high_hz = 2 * labels > thesis_labels ? thesis_hz : 0;
  e.fmax_origin = vp::FmaxOrigin::published;
  e.fmax_documentation = "55 MHz with 128 labels, the slowest module of the PL (thesis 4.6.1)";
  return e;
}

BlobDetectionTlm::BlobDetectionTlm(sc_core::sc_module_name name, const Site& site)
    : BlobDetection(name, site),
      frame_(geometry_, label_count, minimum_side),
      start_(frame_),
      rest_(frame_) {}

void BlobDetectionTlm::end_of_elaboration() {
  BlobDetection::end_of_elaboration();
  frames.channel().add_listener(*this);
}

void BlobDetectionTlm::edge() {
  sleep();
  if (rst) return reset();
  const std::uint64_t cycle = clock().cycle();
  if (ena && !ena_before_) begin(cycle);
  ena_before_ = ena;
  if (cycle >= changed_cycle_) find_again(cycle);
  emit(cycle);
  idle = cycle >= idle_cycle_;
  if (!ena) label_overflow = frame_.overflow();
  wake_at(next_change(cycle));
}

// The frame is found as a whole: how many labels were missing until now, its begin tells again.
void BlobDetectionTlm::settle() {
  const std::uint64_t cycle = clock().cycle();
  if (!begun_ || cycle < begin_ || cycle >= frame_end()) return;
  BlobFrame until_now = start_;
  std::vector<StampedBlob> ignored;
  until_now.advance(frames->data(), static_cast<std::uint32_t>(cycle + 1 - begin_), ignored);
  label_overflow = until_now.overflow();
}

void BlobDetectionTlm::emit(std::uint64_t cycle) {
  const bool leaves = next_ < blobs_.size() && blobs_[next_].clock == cycle;
  if (leaves) {
    blob_start = blobs_[next_].start;
    blob_end = blobs_[next_].end;
    ++next_;
  }
  blob_out = leaves;
}

std::uint64_t BlobDetectionTlm::next_change(std::uint64_t cycle) const {
  if (blob_out.written()) return cycle + 1;
  const std::uint64_t blob = next_ < blobs_.size() ? blobs_[next_].clock : vp::Clock::never;
  const std::uint64_t idle_from = cycle < idle_cycle_ ? idle_cycle_ : vp::Clock::never;
  return std::min({blob, idle_from, changed_cycle_});
}

void BlobDetectionTlm::begin(std::uint64_t cycle) {
  blobs_.erase(blobs_.begin(), blobs_.begin() + static_cast<std::ptrdiff_t>(next_));
  next_ = 0;
  if (begun_) catch_up(cycle);
  begun_ = true;
  begin_ = cycle;
  changed_cycle_ = vp::Clock::never;
  frame_.begin();
  start_ = frame_;
  find();
}

// A frame may begin while labels of the one before still retire: what was foreseen behind this
// clock does not come then.
void BlobDetectionTlm::catch_up(std::uint64_t cycle) {
  blobs_.clear();
  frame_.rest(cycle - frame_end(), blobs_);
  stamp(0);
  forget_before(cycle, 0);
}

void BlobDetectionTlm::find() {
  const std::size_t old = blobs_.size();
  frame_.advance(frames->data(), geometry_.pixels(), blobs_);
  idle_cycle_ = frame_end() + frame_.active_labels() + 1;
  rest_ = frame_;
  rest_.finish(blobs_);
  stamp(old);
}

void BlobDetectionTlm::stamp(std::size_t from) {
  for (std::size_t i = from; i < blobs_.size(); ++i) blobs_[i].clock += begin_;
}

void BlobDetectionTlm::forget_before(std::uint64_t cycle, std::size_t from) {
  const auto first = blobs_.begin() + static_cast<std::ptrdiff_t>(from);
  blobs_.erase(first, std::find_if(first, blobs_.end(), [cycle](const StampedBlob& blob) {
                 return blob.clock >= cycle;
               }));
}

void BlobDetectionTlm::pixels_changed(std::uint32_t first, std::uint32_t) {
  // A pixel of a frame that begins here only in the next clock is not known yet.
  if (!begun_ || begin_ + first <= clock().cycle()) return;
  changed_cycle_ = std::min(changed_cycle_, begin_ + first);
  wake_at(next_change(clock().cycle()));
}

void BlobDetectionTlm::find_again(std::uint64_t cycle) {
  changed_cycle_ = vp::Clock::never;
  blobs_.clear();
  next_ = 0;
  frame_ = start_;
  find();
  forget_before(cycle, 0);
}

void BlobDetectionTlm::reset() {
  frame_.reset();
  blobs_.clear();
  next_ = 0;
  ena_before_ = begun_ = false;
  idle_cycle_ = 0;
  changed_cycle_ = vp::Clock::never;
  blob_out = false;
  idle = true;
  label_overflow = 0;
  wake_at(vp::Clock::never);
}

}  // namespace pl
