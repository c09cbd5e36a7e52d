#include <pl/blob_stream/blob_stream.h>

#include <pl/common/estimate.h>
#include <pl/common/rtl_model.h>

#include <cstddef>

namespace pl {

namespace packet = ::blob_stream;

Models<BlobStream>& BlobStream::models() {
  static Models<BlobStream> models{
      "blob_stream",
      {model<BlobStream, BlobStreamClocked>("clocked", no_image, no_image)},
      rtl_model<BlobStream, BlobStreamClocked>()};
  return models;
}

BlobStream::BlobStream(sc_core::sc_module_name name, const Site& site)
    : Clocked(name, site.clk),
      Ip(&site.clk),
      extreme{{vp::In<std::uint32_t>{"extreme_0", this}, vp::In<std::uint32_t>{"extreme_1", this},
               vp::In<std::uint32_t>{"extreme_2", this}, vp::In<std::uint32_t>{"extreme_3", this},
               vp::In<std::uint32_t>{"extreme_4", this}, vp::In<std::uint32_t>{"extreme_5", this},
               vp::In<std::uint32_t>{"extreme_6", this},
               vp::In<std::uint32_t>{"extreme_7", this}}} {
  wake_on(rst);
  m.reset_by(rst);
  wake_on(frame_ena);
  wake_on(idle);
  wake_on(blob_out);
  wake_on(m.tready);
}

void BlobStream::connect(IpPorts& ports) {
  ports.input(rst);
  ports.input(frame_ena);
  ports.input(frame_number);
  ports.input(threshold);
  ports.input(idle);
  ports.input(blob_out);
  for (vp::In<std::uint32_t>& point : extreme) ports.input(point);
  ports.input(label_overflow);
  add_stream(ports, m);
  ports.output(busy);
  ports.report(fifo_count);
  ports.report(dropped_frames);
  ports.report(dropped_blobs);
  ports.parameter("FIFO_DEPTH", fifo_depth.name(), fifo_depth);
  ports.parameter("CHECKSUM", checksum.name(), checksum);
}

void BlobStreamClocked::edge() {
  const bool frame = frame_ena, begins = frame && !frame_before_;
  frame_before_ = frame;
  if (rst) return reset();
  // Decided by the state before this clock.
  const std::size_t waits = fifo_.size();
  const bool room = waits < fifo_depth, moves = !sender_.empty() && room;
  const bool free = m.tready && !m.tvalid.get() && fifo_.empty();
  offer();
  fill_fifo(room);
  if (begins) begin_frame(free);
  if (blob_out) take_blob(waits + moves + packet::words_per_blob <= fifo_depth);
  if (busy.written() && !frame && idle && !blob_out && sender_.empty()) end_frame();
  fifo_count = static_cast<std::uint16_t>(fifo_.size());
  if (may_sleep()) sleep();
}

void BlobStreamClocked::offer() {
  if (!m.free()) return;
  if (fifo_.empty()) return m.withdraw();
  m.offer(fifo_.front().data, fifo_.front().last);
  fifo_.pop_front();
}

void BlobStreamClocked::fill_fifo(bool room) {
  if (sender_.empty() || !room) return;
  // Blobs that are lost until its word leaves count.
  const bool is_lost_word = sender_.back().last && sender_.size() == 2;
  if (is_lost_word) sender_.front().data = lost_;
  Word& word = sender_.front();
  if (word.last && checksum) word.data = packet::checked_word(sum_, word.data);
  sum_ = packet::add_to_sum(sum_, word.data);
  fifo_.push_back(word);
  sender_.pop_front();
  if (fifo_.back().last) busy = false;
}

void BlobStreamClocked::begin_frame(bool free) {
  if (busy.written() || !free) dropped_frames = dropped_frames.written() + 1;
  if (busy.written()) {
    mixed_ = true;
    return;
  }
  busy = true;
  mixed_ = false;
  dropping_ = !free;
  number_ = frame_number;
  threshold_ = threshold;
  overflow_before_ = label_overflow;
  sent_ = lost_ = sum_ = 0;
}

// The words follow each other into the FIFO without a gap: it has room for all of them, or for
// none.
void BlobStreamClocked::take_blob(bool room) {
  if (dropping_ || !busy.written()) return;
  if (mixed_ || !sender_.empty() || !room || sent_ == packet::max_blobs) {
    ++lost_;
    dropped_blobs = dropped_blobs.written() + 1;
    return;
  }
  ++sent_;
  for (const auto& point : extreme) sender_.push_back({point, false});
}

void BlobStreamClocked::end_frame() {
  if (dropping_) {
    busy = false;
    return;
  }
  lost_ += label_overflow - overflow_before_;
  sender_ = {{number_, false}, {sent_, false}, {lost_, false}, {threshold_, true}};
}

bool BlobStreamClocked::may_sleep() const {
  const bool stuck = m.tvalid.written() && !m.tready;
  const bool moves = m.tvalid.written() || !fifo_.empty();
  return sender_.empty() && (stuck || !moves);
}

void BlobStreamClocked::reset() {
  fifo_.clear();
  sender_.clear();
  m.withdraw();
  busy = false;
  fifo_count = 0;
  dropped_frames = 0;
  dropped_blobs = 0;
  sleep();
}

vp::IpEstimate BlobStream::own_estimate() const {
  vp::IpEstimate e =
      synthesised_ip("blob_stream", {{"CHECKSUM", checksum}, {"FIFO_DEPTH", fifo_depth}});
  e.bram36 = fifo_memory(fifo_depth, 33);
  return e;
}

}  // namespace pl
