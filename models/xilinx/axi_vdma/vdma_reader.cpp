#include <xilinx/axi_vdma/vdma_reader.h>

#include <algorithm>
#include <utility>

namespace xilinx {

VdmaReader::VdmaReader(sc_core::sc_module_name name, vp::Clock& clock, vp::RegisterBank& bank,
                       const VdmaChannelBuild& build, std::uint32_t frame_stores,
                       vp::Signal<bool>& introut)
    : VdmaChannel(name, clock, bank, axi_vdma::mm2s, build, frame_stores, "m_axi_mm2s", introut),
      address_clocks("address_clocks", 14, vp::Unit::cycles, {1, 1000}, vp::Source::published,
                     "start of a frame to its first address (PG020)"),
      read_clocks("read_clocks", 20, vp::Unit::cycles, {0, 1000}, vp::Source::published,
                  "address to first word from the DDR through HP (pynqz2-ram-tester)"),
      stream_clocks("stream_clocks", 4, vp::Unit::cycles, {1, 1000}, vp::Source::published,
                    "word from memory to word on the stream (PG020)"),
      gap_clocks("gap_clocks", 8, vp::Unit::cycles, {1, 1000}, vp::Source::published,
                 "last beat of a frame to the start of the next (PG020)") {
  vp::StreamShape shape{std::string(this->name()) + ".m_axis_mm2s", stream_bytes};
  shape.user = 1;
  m_axis.set_shape(shape);
  wake_on(m_axis.tready);
}

void VdmaReader::end_of_elaboration() {
  VdmaChannel::end_of_elaboration();
  for (auto& part : m_axis.link().parts())
    if (part.part.field == vp::StreamField::user && part.part.low == 0)
      start_of_frame_ = &part.wire;
}

void VdmaReader::started() {
  begin_at_ = clock().cycle() + 1;
  wake_at(begin_at_);
}

// A burst under way on the bus ends, and goes nowhere.
void VdmaReader::abandon() {
  in_frame_ = false;
  begin_at_ = never;
  buffered_ = taken_ = 0;
  std::deque<Burst> kept;
  if (!m_axi.done() && !bursts_.empty()) kept.push_back(std::move(bursts_.back()));
  bursts_.swap(kept);
  if (offering_) {
    m_axis.excuse();
    m_axis.withdraw();
  }
  offering_ = false;
}

// What the writer has completed last; what it writes now less the delay; or one after the other.
std::uint32_t VdmaReader::next_store(const VdmaChannel* writer) const {
  if (!writer || !writer->has_begun()) return following();
  if (genlock() == GenlockMode::slave) return store_behind(writer->store(), delay());
  if (genlock() != GenlockMode::dynamic_slave) return following();
  return writer->newest() >= 0 ? static_cast<std::uint32_t>(writer->newest()) : store();
}

void VdmaReader::edge() {
  const std::uint64_t cycle = this_edge();
  if (offering_ && m_axis.accepted()) {
    offering_ = false;
    if (in_frame_ && sent_.line == frame_.lines) {
      in_frame_ = false;
      begin_at_ = cycle + gap_clocks;
      end_frame();
    }
  }
  if (!bursts_.empty() && bursts_.back().pending && m_axi.done()) {
    if (!in_frame_) {  // its frame was abandoned
      bursts_.clear();
    } else if (m_axi.response() != tlm::TLM_OK_RESPONSE) {
      fail_on_bus(bursts_.back().address);
    } else {
      schedule(bursts_.back(), cycle);
    }
  }
  if (armed() && !in_frame_ && cycle >= begin_at_ && m_axi.done()) {
    frame_ = begin_frame();
    in_frame_ = true;
    begin_at_ = never;
    ask_at_ = cycle + address_clocks;
    asked_ = sent_ = {};
  }
  if (can_request(cycle)) request(cycle);
  if (!offering_ && !offer(cycle)) m_axis.withdraw();
  sleep_until(std::max(cycle + 1, next_edge(cycle)));
}

// ---- memory side

std::uint32_t VdmaReader::burst_bytes() const {
  const std::uint32_t address = frame_.address + asked_.line * frame_.stride + asked_.byte;
  return std::min({frame_.bytes - asked_.byte, burst_beats * memory_bytes,
                   burst_boundary - address % burst_boundary});
}

bool VdmaReader::can_request(std::uint64_t cycle) const {
  if (!in_frame_ || asked_.line == frame_.lines || cycle < ask_at_ || !m_axi.done()) return false;
  const std::uint32_t room = std::max(line_buffer * stream_bytes, burst_beats * memory_bytes);
  return buffered_ + burst_bytes() <= room;
}

void VdmaReader::request(std::uint64_t cycle) {
  const std::uint32_t bytes = burst_bytes();
  Burst& burst = bursts_.emplace_back();
  burst.address = frame_.address + asked_.line * frame_.stride + asked_.byte;
  burst.first = cycle + read_clocks + stream_clocks;
  burst.data.resize(bytes);
  m_axi.read(burst.address, burst.data.data(), bytes, false);
  buffered_ += bytes;
  asked_.byte += bytes;
  if (asked_.byte == frame_.bytes) asked_ = {asked_.line + 1, 0};
  ask_at_ = cycle + 1;
  if (!m_axi.done()) return;
  if (m_axi.response() != tlm::TLM_OK_RESPONSE) return fail_on_bus(burst.address);
  schedule(burst, cycle);
}

// Its place on the read channel, after what other masters read.
void VdmaReader::schedule(Burst& burst, std::uint64_t cycle) {
  burst.pending = false;
  burst.first = std::max({burst.first, cycle, m_axi.path().read_free});
  const auto bytes = static_cast<std::uint32_t>(burst.address % memory_bytes + burst.data.size());
  m_axi.path().read_free = burst.first + (bytes + memory_bytes - 1) / memory_bytes;
}

// ---- stream side

// The edge on which the last of the next `bytes` is there.
std::uint64_t VdmaReader::beat_at(std::uint32_t bytes) const {
  std::uint32_t begin = taken_;
  for (const Burst& burst : bursts_) {
    if (burst.pending) return never;
    const auto room = static_cast<std::uint32_t>(burst.data.size()) - begin;
    if (bytes <= room)
      return burst.first + (burst.address % memory_bytes + begin + bytes - 1) / memory_bytes;
    bytes -= room;
    begin = 0;
  }
  return never;
}

bool VdmaReader::offer(std::uint64_t cycle) {
  if (!in_frame_ || sent_.line == frame_.lines) return false;
  const std::uint32_t bytes = std::min(stream_bytes.get(), frame_.bytes - sent_.byte);
  if (beat_at(bytes) > cycle) return false;
  vp::StreamBytes beat;
  for (std::uint32_t i = 0; i < bytes; ++i) {
    beat.data[i] = bursts_.front().data[taken_++];
    beat.keep.set(i);
    if (taken_ == bursts_.front().data.size()) {
      bursts_.pop_front();
      taken_ = 0;
    }
  }
  if (start_of_frame_) *start_of_frame_ = sent_.line == 0 && sent_.byte == 0 ? 1 : 0;
  buffered_ -= bytes;
  sent_.byte += bytes;
  const bool last = sent_.byte == frame_.bytes;
  if (last) sent_ = {sent_.line + 1, 0};
  m_axis.offer(beat, last);
  offering_ = true;
  return true;
}

std::uint64_t VdmaReader::next_edge(std::uint64_t cycle) const {
  if (!m_axi.done()) return cycle + 1;
  if (!in_frame_ && !offering_) return armed() ? begin_at_ : never;
  if (offering_ && m_axis.tready) return cycle + 1;
  std::uint64_t next = can_request(std::max(cycle + 1, ask_at_)) ? ask_at_ : never;
  if (!offering_ && sent_.line != frame_.lines) {
    const std::uint32_t bytes = std::min(stream_bytes.get(), frame_.bytes - sent_.byte);
    next = std::min(next, beat_at(bytes));
  }
  return next;
}

}  // namespace xilinx
