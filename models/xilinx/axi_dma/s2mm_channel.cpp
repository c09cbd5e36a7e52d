#include <xilinx/axi_dma/s2mm_channel.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace xilinx {

namespace {

using namespace axi_dma;

constexpr std::uint8_t all_bytes = 0xF;

constexpr DmaChannel::Offsets s2mm_offsets{S2MM_DMACR, S2MM_DMASR,  S2MM_CURDESC, S2MM_TAILDESC,
                                           S2MM_DA,    S2MM_DA_MSB, S2MM_LENGTH};

}  // namespace

S2mmChannel::S2mmChannel(Core& core, vp::RegisterBank& bank, vp::Clocked& owner,
                         std::uint32_t burst_beats, const DmaWidths& widths)
    : DmaChannel(core, bank, s2mm_offsets, "S2MM", widths, true),
      m_axi("m_axi_s2mm", owner.clock().scheduler()),
      s_axis("s_axis_s2mm", owner),
      burst_size_(burst_size(burst_beats, widths)),
      fifo_beats_(fifo_bursts * burst_size_ / beat_bytes_),
      beats_per_clock_(widths.beats_per_clock()),
      clocks_per_beat_(widths.clocks_per_beat()) {
  owner.wake_on(s_axis.tvalid);
  if (beat_bytes_ == word_bytes) {
    s_axis.accept_source();
  } else {
    s_axis.set_shape({std::string(owner.name()) + ".s_axis_s2mm", beat_bytes_});
  }
}

bool S2mmChannel::accepts_segment() const {
  return closed_ && transfers_.size() < command_queue;
}

void S2mmChannel::begin(const Segment& segment, std::uint64_t first_cycle) {
  write_address_ = segment.address;
  capacity_ = segment.bytes;
  received_ = 0;
  ready_from_ = first_cycle;
  closed_ = overflow_ = draining_ = false;
  transfers_.emplace_back().status = in_packet_ ? 0 : descriptor::StartOfFrame;
}

// The buffer that takes beats, if none came.
unsigned S2mmChannel::withdraw_unused() {
  if (closed_ || received_ != 0 || in_packet_) return 0;
  transfers_.pop_back();
  closed_ = true;
  ready_from_ = never;
  s_axis.tready = false;
  return 1;
}

void S2mmChannel::sample(std::uint64_t cycle) {
  beat_ = !s_axis.source() && s_axis.sample();
  if (draining_) drive_bus(cycle);
}

std::uint64_t S2mmChannel::move(std::uint64_t cycle) {
  take_beats(cycle);
  drive_bus(cycle);
  if (closed_) begin_descriptors(cycle);
  s_axis.tready = cycle >= ready_from_ && !closed_ && buffered_beats(cycle) < fifo_beats_;
  return next_edge(cycle);
}

// ---- stream side

void S2mmChannel::take_beats(std::uint64_t cycle) {
  if (!s_axis.source()) {
    if (!beat_) return;
    if (beat_bytes_ != word_bytes) return take_wide_beat(cycle);
    take_beat(s_axis.tdata, s_axis.tkeep, s_axis.tlast, cycle);
  } else if (s_axis.source_changed() || cycle >= take_from_) {
    take_from_source(cycle);
  }
}

void S2mmChannel::take_from_source(std::uint64_t cycle) {
  take_from_ = 0;
  for (auto beats = s_axis.source()->take(cycle); beats.count != 0;
       beats = s_axis.source()->take(cycle)) {
    take_words(beats, cycle);
  }
}

// Word by word where a burst or LENGTH ends inside one.
void S2mmChannel::take_words(const vp::BeatSource::Beats& beats, std::uint64_t cycle) {
  const bool aligned = !keyhole() && write_address_ % word_bytes == 0;
  for (std::uint32_t taken = 0; taken < beats.count;) {
    const std::uint32_t in_burst =
        static_cast<std::uint32_t>((write_address_ + collected_.size()) % burst_size_);
    const std::uint32_t room = std::min(burst_size_ - in_burst, capacity_ - received_);
    const std::uint32_t count = aligned ? std::min(beats.count - taken, room / word_bytes) : 0;
    const bool last = beats.last && taken + std::max(count, 1u) == beats.count;
    if (count == 0) {
      take_beat(beats.words[taken++], all_bytes, last, cycle);
      continue;
    }
    append(beats.words + taken, count);
    taken += count;
    if (in_burst + count * word_bytes == burst_size_) close_burst(cycle);
    end_beat(last, cycle);
  }
}

void S2mmChannel::append(const std::uint32_t* words, std::uint32_t count) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(words);
  collected_.insert(collected_.end(), bytes, bytes + count * word_bytes);
  collected_beats_ += count;
  received_ += count * word_bytes;
}

// With a source: no earlier edge brings what has to be acted on. A burst, the transfer or the FIFO
// is full.
std::uint64_t S2mmChannel::next_beat_of_interest(std::uint64_t cycle) const {
  const std::uint32_t in_burst = static_cast<std::uint32_t>(
      keyhole() ? collected_.size() : (write_address_ + collected_.size()) % burst_size_);
  const std::uint32_t bytes = std::min(burst_size_ - in_burst, capacity_ - received_);
  const std::uint32_t beats = waits_for_packet() ? 1
                                                 : std::min((bytes + word_bytes - 1) / word_bytes,
                                                            fifo_beats_ - buffered_beats(cycle));
  return std::max(cycle + 1, s_axis.source()->earliest_pass(std::max(beats, 1u)));
}

void S2mmChannel::take_beat(std::uint32_t data, std::uint8_t keep, bool last, std::uint64_t cycle) {
  ++collected_beats_;
  for (unsigned lane = 0; lane < word_bytes; ++lane) {
    if ((keep >> lane & 1) == 0) continue;
    if (!take_byte(static_cast<unsigned char>(data >> (8 * lane)), cycle)) break;
  }
  if (keyhole() && collected_.size() >= burst_size_) close_burst(cycle);
  end_beat(last, cycle);
}

void S2mmChannel::take_wide_beat(std::uint64_t cycle) {
  const vp::StreamBytes beat = s_axis.link().beat();
  ++collected_beats_;
  for (unsigned lane = 0; lane < beat_bytes_; ++lane) {
    if (beat.keep[lane] && !take_byte(beat.data[lane], cycle)) break;
  }
  if (keyhole() && collected_.size() >= burst_size_) close_burst(cycle);
  end_beat(s_axis.tlast, cycle);
}

// False: the packet is longer than LENGTH, and nothing is written beyond.
bool S2mmChannel::take_byte(unsigned char byte, std::uint64_t cycle) {
  if (received_ == capacity_) {
    overflow_ = true;
    return false;
  }
  collected_.push_back(byte);
  ++received_;
  if (!keyhole() && (write_address_ + collected_.size()) % burst_size_ == 0) close_burst(cycle);
  return true;
}

// The next descriptor has room for the rest of a packet; in direct register mode nothing has.
void S2mmChannel::end_beat(bool last, std::uint64_t cycle) {
  if (!in_packet_) packet_begins();
  in_packet_ = !last;
  if (last) packet_ends(cycle);
  const bool full = received_ == capacity_;
  if (full && !last && !uses_descriptors()) overflow_ = true;
  closed_ = last || full || overflow_;
  if (!closed_) return;
  close_burst(cycle);
  ready_from_ = never;
  Transfer& transfer = transfers_.back();
  transfer.closed = true;
  transfer.overflow = overflow_;
  transfer.status |= received_ | (last ? descriptor::EndOfFrame : 0);
}

void S2mmChannel::close_burst(std::uint64_t cycle) {
  if (collected_.empty()) {
    collected_beats_ = closed_ ? 0 : collected_beats_;
    return;
  }
  Burst burst;
  burst.ready = cycle + core_.timing().write_latency;
  burst.address = write_address_;
  const auto lead = static_cast<unsigned>(write_address_ % beat_bytes_);
  burst.beats = (lead + static_cast<unsigned>(collected_.size()) + beat_bytes_ - 1) / beat_bytes_;
  burst.data.swap(collected_);
  if (!spare_.empty()) {
    collected_.swap(spare_.back());
    spare_.pop_back();
  }
  if (!keyhole()) write_address_ += burst.data.size();
  queued_beats_ += burst.beats;
  collected_beats_ = 0;
  bursts_.push_back(std::move(burst));
  ++transfers_.back().bursts;
}

// Beats in the FIFO after edge `cycle`: those of the burst on the bus leave one by one, or as many
// a clock as the memory is wide.
unsigned S2mmChannel::buffered_beats(std::uint64_t cycle) const {
  unsigned written = 0;
  if (bus_ == Bus::busy && cycle > burst_start_) {
    written = static_cast<unsigned>(std::min<std::uint64_t>(
        (cycle - burst_start_) * beats_per_clock_ / clocks_per_beat_, bursts_.front().beats));
  } else if (bus_ == Bus::answering) {
    written = bursts_.front().beats;
  }
  return collected_beats_ + queued_beats_ - written;
}

// ---- memory side

void S2mmChannel::drive_bus(std::uint64_t cycle) {
  if (bus_ == Bus::busy && cycle >= burst_end_) {
    Burst& burst = bursts_.front();
    m_axi.write(burst.address, burst.data.data(), static_cast<unsigned>(burst.data.size()),
                keyhole(), beat_bytes_);
    bus_ = Bus::answering;
  }
  if (bus_ == Bus::answering && m_axi.done()) end_burst(cycle);
  if (bus_ == Bus::free && !bursts_.empty() && cycle >= bursts_.front().ready &&
      cycle >= bus_free_at_) {
    start_burst(cycle);
  }
  if (!transfers_.empty() && transfers_.front().closed && transfers_.front().bursts == 0) {
    conclude(cycle);
  }
}

void S2mmChannel::start_burst(std::uint64_t cycle) {
  burst_start_ = std::max(cycle, m_axi.path().write_free);
  burst_end_ = burst_start_ +
               (bursts_.front().beats * clocks_per_beat_ + beats_per_clock_ - 1) / beats_per_clock_;
  m_axi.path().write_free = burst_end_;
  bus_ = Bus::busy;
}

void S2mmChannel::end_burst(std::uint64_t cycle) {
  bus_ = Bus::free;
  bus_free_at_ = cycle + core_.timing().write_gap;
  queued_beats_ -= bursts_.front().beats;
  spare_.push_back(std::move(bursts_.front().data));
  spare_.back().clear();
  bursts_.pop_front();
  if (!transfers_.empty()) --transfers_.front().bursts;
  const std::uint32_t error = error_bit(m_axi.response());
  if (error != 0 && !draining_) fail_transfer(cycle, error);
}

// The oldest transfer is in memory.
void S2mmChannel::conclude(std::uint64_t cycle) {
  const Transfer transfer = transfers_.front();
  if (transfer.overflow) return fail_transfer(cycle, dmasr::DMAIntErr);
  transfers_.pop_front();
  finish(shown_at(cycle), transfer.status, (transfer.status & descriptor::EndOfFrame) != 0);
}

void S2mmChannel::fail_transfer(std::uint64_t cycle, std::uint32_t error) {
  ready_from_ = never;
  closed_ = true;
  transfers_.clear();
  fail(shown_at(cycle), error);
}

std::uint64_t S2mmChannel::shown_at(std::uint64_t cycle) const {
  const DmaTiming& timing = core_.timing();
  return cycle + timing.memory_write_latency + timing.completion_latency;
}

void S2mmChannel::completed() {
  length = received_;
}

// But for beats on the wires: TVALID wakes, see expects_beat().
std::uint64_t S2mmChannel::next_edge(std::uint64_t cycle) {
  if (!m_axi.done()) return cycle + 1;
  const bool listening = cycle >= ready_from_ && !closed_;
  const bool full = listening && !s_axis.tready.written();
  if (full && (bus_ == Bus::busy || s_axis.tvalid)) return cycle + 1;
  std::uint64_t next = cycle < ready_from_ ? ready_from_ : never;
  if (listening && s_axis.source()) {
    next = next_beat_of_interest(cycle);
    take_from_ = uses_descriptors() || keyhole() ? 0 : next;
  }
  if (bus_ == Bus::busy) {
    next = std::min(next, burst_end_);
  } else if (!bursts_.empty()) {
    next = std::min(next, std::max({cycle + 1, bursts_.front().ready, bus_free_at_}));
  }
  return next;
}

bool S2mmChannel::quiet(std::uint64_t) const {
  return m_axi.done() && bus_ == Bus::free;
}

void S2mmChannel::abandon() {
  s_axis.tready = false;
  if (s_axis.source()) {
    while (s_axis.source()->take(core_.channel_clock().cycle()).count != 0) continue;
  }
  ready_from_ = never;
  take_from_ = 0;
  closed_ = draining_ = true;
  overflow_ = in_packet_ = false;
  transfers_.clear();
  collected_.clear();
  collected_beats_ = 0;
  while (bursts_.size() > (bus_ == Bus::free ? 0u : 1u)) bursts_.pop_back();
}

void S2mmChannel::forget_bursts() {
  bursts_.clear();
  queued_beats_ = 0;
  bus_ = Bus::free;
  burst_end_ = bus_free_at_ = 0;
  draining_ = false;
}

}  // namespace xilinx
