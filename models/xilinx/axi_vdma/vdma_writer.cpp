#include <xilinx/axi_vdma/vdma_writer.h>

#include <algorithm>
#include <string>
#include <utility>

#include <vp/report.h>

namespace xilinx {

namespace {

using namespace axi_vdma;

}  // namespace

const VdmaWriter::StreamError VdmaWriter::few_lines{
    vdmasr::SOFEarlyErr, 1u << 0, "a frame has fewer lines than VSIZE (SOFEarlyErr)"};
const VdmaWriter::StreamError VdmaWriter::short_line{vdmasr::EOLEarlyErr, 1u << 1,
                                                     "a line is shorter than HSIZE (EOLEarlyErr)"};
const VdmaWriter::StreamError VdmaWriter::many_lines{
    vdmasr::SOFLateErr, 1u << 2, "a frame has more lines than VSIZE (SOFLateErr)"};
const VdmaWriter::StreamError VdmaWriter::long_line{vdmasr::EOLLateErr, 1u << 3,
                                                    "a line is longer than HSIZE (EOLLateErr)"};

VdmaWriter::VdmaWriter(sc_core::sc_module_name name, vp::Clock& clock, vp::RegisterBank& bank,
                       const VdmaChannelBuild& build, std::uint32_t frame_stores,
                       vp::Signal<bool>& introut)
    : VdmaChannel(name, clock, bank, axi_vdma::s2mm, build, frame_stores, "m_axi_s2mm", introut),
      write_clocks("write_clocks", 16, vp::Unit::cycles, {1, 1000}, vp::Source::published,
                   "beat from the stream to its word on the bus: 14 and 2 (PG020)"),
      gap_clocks("gap_clocks", 11, vp::Unit::cycles, {1, 1000}, vp::Source::published,
                 "last word of a frame to its end (PG020)"),
      irq_mask_(bank[S2MM_VDMA_IRQ_MASK]) {
  vp::StreamShape shape{std::string(this->name()) + ".s_axis_s2mm", stream_bytes};
  shape.user = 1;
  shape.ignores_upper_bits = true;
  s_axis.set_shape(shape);
  wake_on(s_axis.tvalid);
}

void VdmaWriter::end_of_elaboration() {
  VdmaChannel::end_of_elaboration();
  for (auto& part : s_axis.link().parts())
    if (part.part.field == vp::StreamField::user && part.part.low == 0)
      start_of_frame_ = &part.wire;
}

void VdmaWriter::started() {
  if (!start_of_frame_) {
    vp::warn(*this, "/markervp/axi_vdma/no_start_of_frame",
             "nothing drives TUSER of its stream, so no frame ever begins: drive TUSER(0) with the "
             "first pixel");
  }
  order_stores();
  wake();
}

void VdmaWriter::abandon() {
  in_frame_ = false;
  is_closed_ = true;
  collected_.clear();
  dropped_ = bus_ != Bus::free;
  while (bursts_.size() > (dropped_ ? 1u : 0u)) bursts_.pop_back();
  buffered_ = dropped_ ? static_cast<std::uint32_t>(bursts_.front().data.size()) : 0;
  s_axis.tready = false;
}

// A dynamic master leaves out the store that is being read.
std::uint32_t VdmaWriter::next_store(const VdmaChannel* reader) const {
  const std::uint32_t next = following();
  if (!reader || !reader->has_begun() || genlock() != GenlockMode::dynamic_master) return next;
  return next == reader->store() && frame_stores() > 1 ? (next + 1) % frame_stores() : next;
}

void VdmaWriter::edge() {
  const std::uint64_t cycle = this_edge();
  if (s_axis.sample()) take_beat(cycle);
  drive_bus(cycle);
  const std::uint32_t room = std::max(line_buffer * stream_bytes, 2 * burst_beats * memory_bytes);
  const bool waits = in_frame_ && is_closed_;
  s_axis.tready = armed() && !waits && buffered_ + stream_bytes <= room;
  sleep_until(std::max(cycle + 1, next_edge(cycle)));
}

// ---- stream side

void VdmaWriter::take_beat(std::uint64_t cycle) {
  if (!armed()) return;
  if (start_of_frame_ && (start_of_frame_->get() & 1) != 0) {
    if (in_frame_ && !is_closed_) {
      report(few_lines);
      abandon();
    }
    begin();
  } else if (is_closed_) {
    if (has_begun() && !std::exchange(was_late_, true)) report(many_lines);
    return;
  }
  take_bytes(s_axis.link().beat(), cycle);
  if (s_axis.tlast) end_line(cycle);
}

void VdmaWriter::begin() {
  frame_ = begin_frame();
  in_frame_ = true;
  is_closed_ = is_too_long_ = was_late_ = false;
  line_ = byte_ = 0;
}

void VdmaWriter::take_bytes(const vp::StreamBytes& beat, std::uint64_t cycle) {
  for (std::uint32_t lane = 0; lane < stream_bytes; ++lane) {
    if (!beat.keep[lane]) continue;
    if (byte_ == frame_.bytes) {
      if (!std::exchange(is_too_long_, true)) report(long_line);
      return;
    }
    collected_.push_back(beat.data[lane]);
    ++byte_;
    ++buffered_;
    const std::uint64_t next = std::uint64_t{frame_.address} + line_ * frame_.stride + byte_;
    if (collected_.size() == burst_beats * memory_bytes || next % burst_boundary == 0)
      close_burst(cycle);
  }
}

void VdmaWriter::end_line(std::uint64_t cycle) {
  if (byte_ < frame_.bytes) report(short_line);
  close_burst(cycle);
  byte_ = 0;
  is_too_long_ = false;
  is_closed_ = ++line_ == frame_.lines;
}

void VdmaWriter::close_burst(std::uint64_t cycle) {
  if (collected_.empty()) return;
  const std::uint64_t end = std::uint64_t{frame_.address} + line_ * frame_.stride + byte_;
  bursts_.push_back({cycle + write_clocks, end - collected_.size(), std::move(collected_)});
  collected_ = {};
}

void VdmaWriter::report(const StreamError& error) {
  vp::warn(*this, "/markervp/axi_vdma/stream", std::string("S2MM: ") + error.text);
  raise(error.status, (irq_mask_ & error.irq_mask) == 0);
}

// ---- memory side

void VdmaWriter::drive_bus(std::uint64_t cycle) {
  if (bus_ == Bus::busy && cycle >= burst_end_) {
    Burst& burst = bursts_.front();
    m_axi.write(burst.address, burst.data.data(), static_cast<unsigned>(burst.data.size()), false);
    bus_ = Bus::answering;
  }
  if (bus_ == Bus::answering && m_axi.done()) {
    bus_ = Bus::free;
    const Burst burst = std::move(bursts_.front());
    bursts_.pop_front();
    buffered_ -= static_cast<std::uint32_t>(burst.data.size());
    const bool counts = !std::exchange(dropped_, false);
    if (counts && m_axi.response() != tlm::TLM_OK_RESPONSE) return fail_on_bus(burst.address);
    bus_free_at_ = cycle + (bursts_.empty() && is_closed_ ? gap_clocks.get() : 0);
  }
  if (bus_ == Bus::free && !bursts_.empty() && cycle >= bursts_.front().ready) {
    const Burst& burst = bursts_.front();
    const auto bytes = static_cast<std::uint32_t>(burst.address % memory_bytes + burst.data.size());
    burst_end_ =
        std::max(cycle, m_axi.path().write_free) + (bytes + memory_bytes - 1) / memory_bytes;
    m_axi.path().write_free = burst_end_;
    bus_ = Bus::busy;
  }
  if (in_frame_ && is_closed_ && bursts_.empty() && cycle >= bus_free_at_) {
    in_frame_ = false;
    end_frame();
  }
}

std::uint64_t VdmaWriter::next_edge(std::uint64_t cycle) const {
  if (bus_ == Bus::answering) return cycle + 1;
  if (s_axis.tvalid && armed()) return cycle + 1;
  std::uint64_t next = never;
  if (bus_ == Bus::busy) {
    next = burst_end_;
  } else if (!bursts_.empty()) {
    next = bursts_.front().ready;
  } else if (in_frame_ && is_closed_) {
    next = bus_free_at_;
  }
  return next;
}

}  // namespace xilinx
