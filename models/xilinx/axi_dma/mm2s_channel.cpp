#include <xilinx/axi_dma/mm2s_channel.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace xilinx {

namespace {

using namespace axi_dma;

/// Address pipeline of the DataMover: bursts requested ahead (HDL of v5.1).
constexpr unsigned outstanding_bursts = 4;

constexpr DmaChannel::Offsets mm2s_offsets{MM2S_DMACR, MM2S_DMASR,  MM2S_CURDESC, MM2S_TAILDESC,
                                           MM2S_SA,    MM2S_SA_MSB, MM2S_LENGTH};

}  // namespace

Mm2sChannel::Mm2sChannel(Core& core, vp::RegisterBank& bank, vp::Clocked& owner,
                         std::uint32_t burst_beats, const DmaWidths& widths)
    : DmaChannel(core, bank, mm2s_offsets, "MM2S", widths, false),
      m_axi("m_axi_mm2s", owner.clock().scheduler()),
      m_axis("m_axis_mm2s", owner),
      clocks_per_beat_(widths.clocks_per_beat()),
      burst_size_(burst_size(burst_beats, widths)),
      fifo_size_(fifo_bursts * burst_size_) {
  if (beat_bytes_ != word_bytes)
    m_axis.set_shape({std::string(owner.name()) + ".m_axis_mm2s", beat_bytes_});
  owner.wake_on(m_axis.tready);
}

bool Mm2sChannel::accepts_segment() const {
  return to_request_ == 0 && segments_.size() < command_queue;
}

void Mm2sChannel::begin(const Segment& segment, std::uint64_t first_cycle) {
  read_address_ = segment.address;
  to_request_ = segment.bytes;
  request_at_ = first_cycle;
  if (segments_.empty()) {
    to_send_ = segment.bytes;
    buffered_ = 0;
    taken_ = 0;
  }
  segments_.push_back(segment);
}

void Mm2sChannel::sample(std::uint64_t) {
  accepted_ = m_axis.accepted();
}

std::uint64_t Mm2sChannel::move(std::uint64_t cycle) {
  if (accepted_ && to_send_ == 0) {
    end_segment(cycle);
    if (segments_.empty()) {
      withdraw();
      return never;
    }
  }
  if (!bursts_.empty() && bursts_.back().pending && m_axi.done()) schedule(bursts_.back(), cycle);
  if (next_request_at(cycle) <= cycle) {
    if (take_whole_burst(cycle)) return never;
    request(cycle);
    if (to_request_ == 0) begin_descriptors(cycle);
  }
  if ((!offering_ || accepted_) && !offer(cycle)) withdraw();
  return next_edge(cycle);
}

// ---- memory side

// The first edge from `cycle` on at which the next burst can be requested, as things stand.
std::uint64_t Mm2sChannel::next_request_at(std::uint64_t cycle) const {
  if (to_request_ == 0 || !m_axi.done() || buffered_ + burst_size_ > fifo_size_) return never;
  if (!bursts_.empty() && bursts_.back().response != tlm::TLM_OK_RESPONSE) return never;
  unsigned outstanding = 0;
  std::uint64_t first_arrival = never;
  for (const Burst& burst : bursts_) {
    if (burst.first <= cycle) continue;
    ++outstanding;
    first_arrival = std::min(first_arrival, burst.first);
  }
  const std::uint64_t earliest = std::max(cycle, request_at_);
  return outstanding < outstanding_bursts ? earliest : std::max(earliest, first_arrival);
}

// A burst ends at a multiple of its size, so it never crosses 4 KiB.
unsigned Mm2sChannel::burst_bytes() const {
  const unsigned to_boundary = burst_size_ - static_cast<unsigned>(read_address_ % burst_size_);
  return std::min(to_request_, to_boundary);
}

void Mm2sChannel::request(std::uint64_t cycle) {
  const unsigned bytes = burst_bytes();
  Burst& burst = bursts_.emplace_back();
  burst.lead = static_cast<unsigned>(read_address_ % beat_bytes_);
  burst.data.resize(bytes);
  m_axi.read(read_address_, burst.data.data(), bytes, keyhole(), beat_bytes_);
  to_request_ -= bytes;
  buffered_ += bytes;
  if (!keyhole()) read_address_ += bytes;
  const DmaTiming& t = core_.timing();
  burst.first = cycle + t.read_latency + t.memory_read_latency;
  burst.pending = !m_axi.done();
  request_at_ = cycle + 1;
  if (!burst.pending) schedule(burst, cycle);
}

// The data is there: its place on the read channel, after what other masters read.
void Mm2sChannel::schedule(Burst& burst, std::uint64_t cycle) {
  burst.pending = false;
  burst.response = m_axi.response();
  burst.first = std::max({burst.first, cycle, m_axi.path().read_free});
  const unsigned beats =
      (burst.lead + static_cast<unsigned>(burst.data.size()) + beat_bytes_ - 1) / beat_bytes_;
  m_axi.path().read_free = bus_busy_until_ = burst.first + beats * clocks_per_beat_;
}

bool Mm2sChannel::quiet(std::uint64_t cycle) const {
  return m_axi.done() && cycle >= bus_busy_until_;
}

// ---- stream side

// The edge on which the last byte of the next beat is in the FIFO.
std::uint64_t Mm2sChannel::next_beat_at() const {
  unsigned needed = std::min<std::uint32_t>(to_send_, beat_bytes_);
  unsigned begin = taken_;
  for (const Burst& burst : bursts_) {
    if (burst.pending) return never;
    if (burst.response != tlm::TLM_OK_RESPONSE) return burst.first;
    const unsigned room = static_cast<unsigned>(burst.data.size()) - begin;
    if (needed <= room) {
      const unsigned beats = (burst.lead + begin + needed - 1) / beat_bytes_;
      return burst.first + (beats + 1) * clocks_per_beat_ - 1;
    }
    needed -= room;
    begin = 0;
  }
  return never;
}

void Mm2sChannel::end_segment(std::uint64_t cycle) {
  const Segment sent = segments_.front();
  segments_.pop_front();
  to_send_ = segments_.empty() ? 0 : segments_.front().bytes;
  if (sent.ends_packet) packet_ends(cycle);
  in_packet_ = !sent.ends_packet;
  finish(cycle + core_.timing().completion_latency, sent.bytes, sent.ends_packet);
  begin_descriptors(cycle);
}

// Offers the next beat if its data has arrived. Returns false if no beat can be offered.
bool Mm2sChannel::offer(std::uint64_t cycle) {
  if (to_send_ == 0 || next_beat_at() > cycle) return false;
  const unsigned bytes = std::min<std::uint32_t>(to_send_, beat_bytes_);
  unsigned char beat[vp::most_stream_bytes];
  if (!collect(beat, bytes)) {
    fail(cycle + core_.timing().completion_latency, error_bit(bursts_.front().response));
    return false;
  }
  to_send_ -= bytes;
  buffered_ -= bytes;
  offering_ = true;
  if (!in_packet_) packet_begins();
  in_packet_ = true;
  const bool last = to_send_ == 0 && segments_.front().ends_packet;
  show(beat, bytes, last);
  return true;
}

// Takes the next bytes out of the FIFO. False: the memory answered with an error.
bool Mm2sChannel::collect(unsigned char* beat, unsigned bytes) {
  for (unsigned done = 0; done < bytes;) {
    const Burst& burst = bursts_.front();
    if (burst.response != tlm::TLM_OK_RESPONSE) return false;
    const unsigned count =
        std::min(bytes - done, static_cast<unsigned>(burst.data.size()) - taken_);
    std::memcpy(beat + done, burst.data.data() + taken_, count);
    done += count;
    taken_ += count;
    if (taken_ == burst.data.size()) {
      bursts_.pop_front();
      taken_ = 0;
    }
  }
  return true;
}

void Mm2sChannel::show(const unsigned char* beat, unsigned bytes, bool last) {
  if (beat_bytes_ == word_bytes) {
    std::uint32_t data = 0;
    std::memcpy(&data, beat, bytes);
    return m_axis.offer(data, last, static_cast<std::uint8_t>((1u << bytes) - 1));
  }
  vp::StreamBytes all;
  std::copy(beat, beat + bytes, all.data.begin());
  for (unsigned lane = 0; lane < bytes; ++lane) all.keep.set(lane);
  m_axis.offer(all, last);
}

void Mm2sChannel::withdraw() {
  if (offering_) m_axis.withdraw();
  offering_ = false;
}

std::uint64_t Mm2sChannel::next_edge(std::uint64_t cycle) const {
  if (!m_axi.done()) return cycle + 1;
  const std::uint64_t next = next_request_at(cycle + 1);
  if (offering_ && m_axis.tready) return cycle + 1;
  if (offering_) return next;  // wakes when tready changes
  return std::min(next, std::max(cycle + 1, next_beat_at()));
}

// ---- bursts as a whole

// A transfer of one burst of whole words whose data is there at once: its time is known.
bool Mm2sChannel::take_whole_burst(std::uint64_t cycle) {
  if (uses_descriptors() || beat_bytes_ != word_bytes) return false;
  const std::uint32_t bytes = to_request_;
  if (bytes != to_send_ || !bursts_.empty() || offering_) return false;
  if (burst_bytes() != bytes || keyhole()) return false;
  if ((read_address_ | bytes) % word_bytes != 0) return false;
  const vp::BurstSink* sink = m_axis.sink();
  if (!sink || !sink->takes_bursts()) return false;
  if (whole_burst_.size() < bytes / word_bytes) whole_burst_.resize(bytes / word_bytes);
  if (!m_axi.read_directly(read_address_, whole_burst_.data(), bytes)) return false;
  whole_words_ = bytes / word_bytes;
  const DmaTiming& t = core_.timing();
  std::uint64_t& bus_free = m_axi.path().read_free;
  whole_first_ = std::max(cycle + t.read_latency + t.memory_read_latency, bus_free);
  bus_free = bus_busy_until_ = whole_first_ + whole_words_;
  finish(bus_busy_until_ + t.completion_latency, bytes, true);
  return true;
}

void Mm2sChannel::completed() {
  if (whole_words_ == 0) return;
  m_axis.send_burst(whole_burst_.data(), whole_words_, true);
  whole_words_ = 0;
  to_request_ = to_send_ = 0;
  segments_.clear();
}

// What passed so far is given; the state is that of single beats from here on.
void Mm2sChannel::settle(std::uint64_t cycle) {
  if (whole_words_ == 0) return;
  if (cycle >= whole_first_ + whole_words_) return completed();
  unfinish();
  core_.plan_edge(cycle + 1);
  const std::uint32_t count = std::exchange(whole_words_, 0);
  to_request_ = 0;
  buffered_ = to_send_;
  Burst& burst = bursts_.emplace_back();
  burst.first = whole_first_;
  burst.data.resize(to_send_);
  std::memcpy(burst.data.data(), whole_burst_.data(), to_send_);
  if (cycle < whole_first_) return;
  const auto passed = static_cast<std::uint32_t>(cycle - whole_first_);
  if (passed != 0) m_axis.send_burst(whole_burst_.data(), passed, false);
  taken_ = (passed + 1) * word_bytes;
  to_send_ -= taken_;
  buffered_ -= taken_;
  if (taken_ == burst.data.size()) {
    bursts_.pop_front();
    taken_ = 0;
  }
  offering_ = true;
  m_axis.offer(whole_burst_[passed], passed + 1 == count);
}

void Mm2sChannel::abandon() {
  settle(core_.channel_clock().cycle());
  m_axis.excuse();
  withdraw();
  to_request_ = to_send_ = buffered_ = 0;
  segments_.clear();
  in_packet_ = false;
  if (m_axi.done()) bursts_.clear();
}

void Mm2sChannel::forget_bursts() {
  bursts_.clear();
  bus_busy_until_ = 0;
}

}  // namespace xilinx
