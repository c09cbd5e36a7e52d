#include <xilinx/axi_dma/descriptor_ring.h>

#include <algorithm>
#include <unordered_set>

namespace xilinx {

namespace {

using namespace axi_dma;

/// Descriptors that are read ahead (HDL of v7.1).
constexpr std::size_t queue_size = 4;
/// Two registers between the count and the status bit (HDL of v7.1).
constexpr std::uint64_t timer_registers = 2;

/// The error bit of DMASR for a bus response to the engine; 0 for OK.
std::uint32_t error_bit(tlm::tlm_response_status response) {
  if (response == tlm::TLM_OK_RESPONSE) return 0;
  return response == tlm::TLM_ADDRESS_ERROR_RESPONSE ? dmasr::SGDecErr : dmasr::SGSlvErr;
}

std::uint32_t pointer(std::uint32_t word) {
  return word & ~(descriptor::alignment - 1);
}

}  // namespace

// ---- interrupts

std::uint32_t InterruptCoalescing::threshold() const {
  return (dmacr_ & dmacr::IRQThreshold) >> dmacr::IRQThreshold_shift;
}

std::uint32_t InterruptCoalescing::delay() const {
  return (dmacr_ & dmacr::IRQDelay) >> dmacr::IRQDelay_shift;
}

bool InterruptCoalescing::timer_on() const {
  return delay() != 0 && dmacr_.any(dmacr::Dly_IrqEn);
}

// Another threshold begins to count anew; the same one does not (HDL of v7.1).
void InterruptCoalescing::control_written(std::uint32_t before, std::uint64_t cycle) {
  const std::uint32_t changed = before ^ dmacr_;
  if (changed & dmacr::IRQThreshold) packets_left_ = threshold();
  if (!timer_on()) {
    idle_since_ = never;
  } else if ((changed & dmacr::IRQDelay) != 0 && idle_since_ != never) {
    idle_since_ = cycle;
  }
}

bool InterruptCoalescing::packet_complete() {
  if (--packets_left_ != 0) return false;
  packets_left_ = threshold();
  return true;
}

// The count passes IRQDelay before the interrupt, so a delay of 1 takes two counts (HDL of v7.1).
std::uint64_t InterruptCoalescing::delay_ends() const {
  if (idle_since_ == never) return never;
  return idle_since_ + (delay() + std::uint64_t{1}) * engine_.timer_resolution + timer_registers;
}

void InterruptCoalescing::delay_ended() {
  idle_since_ = never;
  packets_left_ = threshold();
}

std::uint32_t InterruptCoalescing::status(std::uint64_t cycle) const {
  std::uint64_t counted = 0;
  if (idle_since_ != never && cycle > idle_since_) {
    const std::uint32_t resolution = std::max<std::uint32_t>(engine_.timer_resolution, 1);
    counted = std::min<std::uint64_t>((cycle - idle_since_ - 1) / resolution, delay());
  }
  return packets_left_ << dmasr::IRQThresholdSts_shift | static_cast<std::uint32_t>(counted)
                                                             << dmasr::IRQDelaySts_shift;
}

void InterruptCoalescing::reset() {
  packets_left_ = 1;
  idle_since_ = never;
}

// ---- descriptors

void DescriptorRing::go_on(std::uint64_t cycle) {
  if (!paused_) return;
  paused_ = false;
  fetch_from_ = cycle + engine.tail_latency;
}

// They are read later, and what is wrong in them found then: a chain may loop before its tail.
void DescriptorRing::order_to_tail(WriteOrders& orders) {
  std::unordered_set<std::uint32_t> seen;
  while (seen.insert(ordered_to_).second) {
    const std::uint32_t at = ordered_to_;
    std::uint32_t words[descriptor::bytes / word_bytes];
    if (!engine.m_axi.peek(at, words, sizeof words)) return;
    if ((words[descriptor::STATUS / word_bytes] & descriptor::Cmplt) != 0) return;
    orders.add(words[descriptor::BUFFER_ADDRESS / word_bytes],
               words[descriptor::CONTROL / word_bytes] & length_mask);
    ordered_to_ = pointer(words[descriptor::NXTDESC / word_bytes]);
    if (at == taildesc_) return;
  }
}

bool DescriptorRing::wants_descriptor() const {
  return !paused_ && queue_.size() < queue_size;
}

void DescriptorRing::edge(std::uint64_t cycle, bool cyclic) {
  if (access_ != Access::none && engine.m_axi.done()) complete_access(cycle, cyclic);
  if (access_ == Access::none && engine.m_axi.done() && !updates_.empty()) {
    Update& first = updates_.front();
    if (first.shown == never && cycle >= first.due) begin_update(cycle, cyclic);
  }
  if (access_ == Access::none && engine.m_axi.done() && wants_descriptor() &&
      cycle >= fetch_from_) {
    begin_fetch(cycle, cyclic);
  }
}

void DescriptorRing::begin_update(std::uint64_t cycle, bool cyclic) {
  access_ = Access::update;
  words_[0] = updates_.front().status;
  engine.m_axi.write(updates_.front().at + descriptor::STATUS,
                     reinterpret_cast<unsigned char*>(words_), word_bytes, false);
  if (engine.m_axi.done()) complete_access(cycle, cyclic);
}

// The status of a cyclic descriptor is not checked: software may be taking it back meanwhile.
void DescriptorRing::begin_fetch(std::uint64_t cycle, bool cyclic) {
  access_ = Access::fetch;
  fetch_began_ = cycle;
  engine.m_axi.read(next_, reinterpret_cast<unsigned char*>(words_),
                    cyclic ? descriptor::STATUS : descriptor::bytes, false);
  if (engine.m_axi.done()) complete_access(cycle, cyclic);
}

void DescriptorRing::complete_access(std::uint64_t cycle, bool cyclic) {
  if (access_ == Access::fetch) {
    fetched(cycle, cyclic);
  } else {
    Update& update = updates_.front();
    std::uint64_t& bus_free = engine.m_axi.path().write_free;
    bus_free = std::max(cycle, bus_free) + 1;
    update.shown = bus_free + timing_.memory_write_latency;
    update.error = error_bit(engine.m_axi.response());
  }
  access_ = Access::none;
}

// The words come one a clock, after what other masters read; the next descriptor is asked for
// behind them.
void DescriptorRing::fetched(std::uint64_t cycle, bool cyclic) {
  std::uint64_t& bus_free = engine.m_axi.path().read_free;
  const std::uint64_t first =
      std::max({fetch_began_ + timing_.memory_read_latency, cycle, bus_free});
  bus_free = fetch_from_ = first + descriptor::bytes / word_bytes;
  if (paused_) return;  // the channel was stopped meanwhile

  Descriptor& read = queue_.emplace_back();
  read.at = next_;
  read.buffer = words_[descriptor::BUFFER_ADDRESS / word_bytes];
  read.control = words_[descriptor::CONTROL / word_bytes];
  read.ready_at = first + engine.fetch_latency;
  read.error = error_bit(engine.m_axi.response());
  if (read.error == 0 && !cyclic &&
      (words_[descriptor::STATUS / word_bytes] & descriptor::Cmplt) != 0) {
    read.error = dmasr::SGIntErr;
  }
  read.next = words_[descriptor::NXTDESC / word_bytes];
  if (read.error != 0 || (next_ == taildesc_ && !cyclic)) paused_ = true;
  next_ = pointer(read.next);
}

const Descriptor* DescriptorRing::ready(std::uint64_t cycle) const {
  if (queue_.empty() || cycle < queue_.front().ready_at) return nullptr;
  const Descriptor& first = queue_.front();
  const bool stops = first.error != 0 || (first.control & length_mask) == 0;
  return stops && !(working_.empty() && updates_.empty()) ? nullptr : &first;
}

Descriptor DescriptorRing::take() {
  const Descriptor taken = queue_.front();
  queue_.pop_front();
  curdesc_ = current_ = taken.at;
  if (taken.error == 0) working_.push_back(taken);
  return taken;
}

void DescriptorRing::done(std::uint64_t cycle, std::uint32_t status, bool ends_packet) {
  Update& update = updates_.emplace_back();
  update.at = working_.front().at;
  update.status = status;
  update.ends_packet = ends_packet;
  update.due = cycle;
  working_.pop_front();
}

std::optional<DescriptorRing::Written> DescriptorRing::take_written(std::uint64_t cycle) {
  if (updates_.empty() || updates_.front().shown > cycle) return std::nullopt;
  const Update& first = updates_.front();
  const Written written{first.at, first.ends_packet, first.error};
  updates_.pop_front();
  return written;
}

std::uint64_t DescriptorRing::next_edge(std::uint64_t cycle) const {
  if (!engine.m_axi.done()) return cycle + 1;
  std::uint64_t next = coalescing.delay_ends();
  if (wants_descriptor()) next = std::min(next, fetch_from_);
  if (!queue_.empty() && queue_.front().ready_at > cycle) {
    next = std::min(next, queue_.front().ready_at);
  }
  if (!updates_.empty()) {
    const Update& first = updates_.front();
    next = std::min(next, first.shown != never ? first.shown : first.due);
  }
  return std::max(next, cycle + 1);
}

void DescriptorRing::flush() {
  queue_.clear();
  paused_ = true;
}

bool DescriptorRing::drained() const {
  return paused_ && queue_.empty() && working_.empty() && quiet();
}

void DescriptorRing::reset() {
  flush();
  working_.clear();
  updates_.clear();
  access_ = Access::none;
  current_ = next_ = 0;
  coalescing.reset();
}

}  // namespace xilinx
