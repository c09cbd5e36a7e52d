#include <xilinx/axi_dma/dma_channel.h>

#include <vp/text.h>
#include <xilinx/axi_dma/descriptor_ring.h>

#include <algorithm>
#include <utility>

namespace xilinx {

namespace {

constexpr std::uint32_t port_bytes = 8;

}  // namespace

using namespace axi_dma;

std::uint32_t DmaWidths::beats_per_clock() const {
  return std::max(std::min(memory_bytes, port_bytes) / stream_bytes, 1u);
}

std::uint32_t DmaWidths::clocks_per_beat() const {
  return std::max(stream_bytes / port_bytes, 1u);
}

DmaChannel::DmaChannel(Core& core, vp::RegisterBank& bank, const Offsets& offsets, std::string name,
                       const DmaWidths& widths, bool counts_at_rest)
    : dmacr(bank[offsets.dmacr]),
      dmasr(bank[offsets.dmasr]),
      curdesc(bank[offsets.curdesc]),
      taildesc(bank[offsets.taildesc]),
      address(bank[offsets.address]),
      address_msb(bank[offsets.address_msb]),
      length(bank[offsets.length]),
      core_(core),
      beat_bytes_(widths.stream_bytes),
      clock_(core.channel_clock()),
      name_(std::move(name)),
      counts_at_rest_(counts_at_rest) {
  dmacr.after_write([this](std::uint32_t word) { control_written(word); });
  dmasr.after_write([this](std::uint32_t word) { status_written(word); });
  address.after_write([this](std::uint32_t) { latch_address(); });
  length.after_write([this](std::uint32_t word) { length_written(word); });
}

DmaChannel::~DmaChannel() = default;

unsigned DmaChannel::burst_size(std::uint32_t beats, const DmaWidths& widths) {
  constexpr unsigned largest = 4'096;
  return std::min(beats * widths.stream_bytes, largest);
}

void DmaChannel::configure(std::uint32_t length_width, unsigned alignment) {
  length_width_ = length_width;
  length.set_writable((1u << length_width) - 1);
  alignment_ = alignment;
}

void DmaChannel::use(ScatterGather& engine) {
  const std::uint32_t length_mask = (1u << length_width_) - 1;
  ring_ = std::make_unique<DescriptorRing>(engine, core_.timing(), dmacr, curdesc, taildesc,
                                           length_mask);
  curdesc.after_write([this](std::uint32_t word) { current_written(word); });
  taildesc.after_write([this](std::uint32_t word) { tail_written(word); });
  dmasr.set_reset_value(dmasr.reset_value() | dmasr::SGIncld);
  control_ = dmacr;
  dmasr.computed_by([this] { return dmasr.value() | ring_->coalescing.status(now()); });
}

// ---- what software does

void DmaChannel::control_written(std::uint32_t word) {
  if ((dmacr & dmacr::IRQThreshold) == 0) dmacr.set_bits(1u << dmacr::IRQThreshold_shift);
  if (word & dmacr::Reset) core_.request_soft_reset();
  if (core_.in_soft_reset()) dmacr.set_bits(dmacr::Reset);  // a write does not take it back
  if (core_.stopped() || core_.in_soft_reset()) {
    dmacr.clear_bits(dmacr::RS);  // an error holds RS at 0 until a reset
  } else if (running()) {
    halt_at_ = never;
    if (dmasr.any(dmasr::Halted) && run_at_ == never) {
      run_at_ = now() + core_.timing().run_latency;
      if (ring_) ring_->start();
    }
  } else {
    run_at_ = never;
    if (ring_) pause_ring(now());
    if (phase_ == Phase::idle && !in_order_ && !dmasr.any(dmasr::Halted)) halt_after(now());
  }
  if (ring_) ring_->coalescing.control_written(std::exchange(control_, dmacr), now());
  plan_after_write();
}

// The next edge on which registers or the interrupt output follow what software wrote.
void DmaChannel::plan_after_write() {
  const std::uint64_t next = std::min(run_at_, halt_at_);
  if (next != never) core_.plan_edge(std::max(next, now() + 1));
  core_.plan_interrupts();
}

// A bit that the hardware sets on the same edge stays set.
void DmaChannel::status_written(std::uint32_t word) {
  if (fresh_at_ == now()) dmasr.set_bits(word & fresh_interrupts_);
  plan_after_write();
}

void DmaChannel::length_written(std::uint32_t word) {
  if (core_.in_soft_reset()) {
    core_.warn("/markervp/axi_dma/length_in_reset",
               name_ + " LENGTH written during a soft reset: it is lost");
    return;
  }
  const auto written = [&] { return name_ + " LENGTH = " + std::to_string(word); };
  if (word != length) {
    core_.warn(
        "/markervp/axi_dma/length_too_wide",
        written() + " has more bits than this build: it is stored as " + std::to_string(length));
  }
  if (length == 0) {
    core_.warn("/markervp/axi_dma/length_zero", written() + ": a transfer of 0 bytes never starts");
  } else if (!running()) {
    core_.warn("/markervp/axi_dma/length_while_halted",
               written() +
                   " written while the channel is halted: no transfer starts; set DMACR.RS before");
  } else if (phase_ != Phase::idle) {
    core_.warn(
        "/markervp/axi_dma/length_while_busy",
        written() + " written while a transfer is running: it is lost; wait for it to complete");
  } else {
    phase_ = Phase::accepted;
    requested_bytes_ = length;
    accepted_at_ = now();
    sampled_address_ = address;
    dmasr.clear_bits(dmasr::Idle);
    core_.check_buffer(name_, address, length);
    if (orders()) orders()->add(address, length);
    if (transfer_listener_) transfer_listener_(true);
    core_.plan_edge(std::max(accepted_at_ + 1, starts_at()));
  }
}

// The address register is sampled some edges after LENGTH was written; until then it may change.
void DmaChannel::latch_address() {
  if (phase_ == Phase::accepted && now() < accepted_at_ + core_.timing().address_latency) {
    sampled_address_ = address;
  }
}

std::uint64_t DmaChannel::starts_at() const {
  const DmaTiming& timing = core_.timing();
  return accepted_at_ + std::max<std::uint32_t>(timing.address_latency, timing.start_latency);
}

// ---- what the hardware does

std::uint64_t DmaChannel::edge(std::uint64_t cycle) {
  sample(cycle);
  if (at_rest() || core_.in_soft_reset()) return never;
  if (ring_) run_ring(cycle);
  std::uint64_t next = never;
  if (phase_ == Phase::accepted) {
    if (cycle < starts_at()) {
      next = starts_at();
    } else {
      start(cycle);
    }
  }
  if (phase_ == Phase::moving) {
    next = finish_at_ == never ? move(cycle) : never;
    bring_up_to(cycle);
    next = std::min(next, shows_at());
  }
  if (ring_) next = std::min(next, ring_->next_edge(cycle));
  return std::min(next, run_and_halt(cycle));
}

void DmaChannel::start(std::uint64_t cycle) {
  phase_ = Phase::moving;
  finish_at_ = never;
  error_ = 0;
  begin({aligned(sampled_address_), requested_bytes_, true}, cycle);
}

std::string DmaChannel::what_moves() const {
  if (cyclic()) return "a ring of descriptors that has no end";
  if (uses_descriptors()) return "what descriptors say";
  return std::to_string(requested_bytes_) + " bytes";
}

std::uint32_t DmaChannel::aligned(std::uint32_t address) const {
  if (address % alignment_ == 0) return address;
  core_.warn("/markervp/axi_dma/unaligned",
             name_ + " address " + vp::hex(address) + " is not a multiple of " +
                 std::to_string(alignment_) +
                 " and this build has no realignment engine: the low bits are dropped");
  return address - address % alignment_;
}

void DmaChannel::finish(std::uint64_t cycle, std::uint32_t status, bool ends_packet) {
  if (!ring_) {
    finish_at_ = cycle;
    return;
  }
  ring_->done(cycle, descriptor::Cmplt | status, ends_packet);
  if (orders()) orders()->end();
  leave(1);
}

// So many descriptors' data moves no more.
void DmaChannel::leave(unsigned count) {
  under_way_ -= count;
  if (under_way_ != 0) return;
  phase_ = Phase::idle;
  if (transfer_listener_) transfer_listener_(false);
}

// The edge that has to run for the end of the transfer: the one on which the interrupt output
// rises.
std::uint64_t DmaChannel::shows_at() const {
  const bool raises = error_ == 0 && running() && dmacr.any(dmacr::IOC_IrqEn) && !interrupt();
  return finish_at_ == never || core_.watched() || !raises ? finish_at_ : finish_at_ + 1;
}

void DmaChannel::report_status(std::uint64_t cycle) {
  finish_at_ = never;
  if (transfer_listener_) transfer_listener_(false);
  if (error_ != 0) {
    warn_of_bus_error();
    if (ring_) ring_->done(cycle, descriptor::Cmplt | error_ << descriptor::error_shift, false);
    report_error(cycle, error_);
    return;
  }
  phase_ = Phase::idle;
  completed();
  if (orders()) orders()->end();
  set_interrupt(dmasr::IOC_Irq, cycle);
  if (running()) {
    dmasr.set_bits(dmasr::Idle);
  } else {
    halt_after(cycle);
  }
}

void DmaChannel::report_error(std::uint64_t cycle, std::uint32_t error) {
  dmasr.set_bits(error);
  set_interrupt(dmasr::Err_Irq, cycle);
  core_.stop_channels();
}

void DmaChannel::warn_of_bus_error() const {
  if ((error_ & (dmasr::DMADecErr | dmasr::DMASlvErr)) == 0) return;
  const bool nothing = (error_ & dmasr::DMADecErr) != 0;
  const std::uint32_t bytes =
      ring_ ? ring_->oldest().control & ring_->length_mask : requested_bytes_;
  core_.warn("/markervp/axi_dma/bus_error",
             name_ + " transfer of " + std::to_string(bytes) + " bytes at " +
                 vp::hex(ring_ ? ring_->oldest().buffer : address.value()) +
                 (nothing ? " leaves the memory that the DMA reaches (DECERR)"
                          : " is refused by the memory (SLVERR)") +
                 ": take DMA buffers from hal_dma_allocate and use their bus_address");
}

void DmaChannel::set_interrupt(std::uint32_t bit, std::uint64_t cycle) {
  dmasr.set_bits(bit);
  if (fresh_at_ != cycle) fresh_interrupts_ = 0;
  fresh_at_ = cycle;
  fresh_interrupts_ |= bit;
}

void DmaChannel::stop() {
  dmacr.clear_bits(dmacr::RS);
  run_at_ = never;
  halting_ = !dmasr.any(dmasr::Halted);
  complete_on_halt_ = !ring_ && phase_ != Phase::idle;
  if (ring_) ring_->flush();
  drop();
}

void DmaChannel::drop() {
  if (phase_ == Phase::moving) abandon();
  if (ring_) ring_->drop_work();
  if (orders()) orders()->drop();
  under_way_ = 0;
  in_order_ = false;
  phase_ = Phase::idle;
  finish_at_ = never;
  error_ = 0;
}

void DmaChannel::halt_after(std::uint64_t cycle) {
  halt_at_ = cycle + core_.timing().run_latency;
}

// Returns the next edge on which something changes by itself.
std::uint64_t DmaChannel::run_and_halt(std::uint64_t cycle) {
  if (run_at_ != never && cycle >= run_at_) {
    dmasr.clear_bits(dmasr::Halted);
    run_at_ = never;
  }
  if (halting_) {
    if (!settled(cycle)) return cycle + 1;
    halting_ = false;
    halt_after(cycle);
  }
  if (halt_at_ != never && cycle >= halt_at_) {
    dmasr.set_bits(dmasr::Halted);
    dmasr.clear_bits(dmasr::Idle);
    if (complete_on_halt_) set_interrupt(dmasr::IOC_Irq, cycle);
    complete_on_halt_ = false;
    halt_at_ = never;
  }
  return std::min(run_at_, halt_at_);
}

bool DmaChannel::settled(std::uint64_t cycle) const {
  return quiet(cycle) && (!ring_ || ring_->quiet());
}

void DmaChannel::reset() {
  abandon();
  forget_bursts();
  if (ring_) ring_->reset();
  if (orders()) orders()->drop();
  under_way_ = 0;
  in_order_ = false;
  control_ = dmacr;
  phase_ = Phase::idle;
  finish_at_ = run_at_ = halt_at_ = fresh_at_ = never;
  error_ = fresh_interrupts_ = 0;
  halting_ = complete_on_halt_ = false;
}

// ---- descriptors

void DmaChannel::warn_of_pointer(const std::string& pointer, std::uint32_t word) const {
  if (word % descriptor::alignment == 0) return;
  core_.warn("/markervp/axi_dma/descriptor_unaligned",
             name_ + " " + pointer + " = " + vp::hex(word) +
                 " is not a multiple of 64: the low bits are dropped");
}

void DmaChannel::current_written(std::uint32_t word) {
  if (!running() && dmasr.any(dmasr::Halted)) {
    warn_of_pointer("CURDESC", word);
    return ring_->accept_current();
  }
  ring_->restore_current();
  core_.warn("/markervp/axi_dma/curdesc_while_running",
             name_ + " CURDESC = " + vp::hex(word) +
                 " written while the channel runs: ignored; write it before DMACR.RS");
}

void DmaChannel::tail_written(std::uint32_t word) {
  const auto written = [&] { return name_ + " TAILDESC = " + vp::hex(word); };
  if (!cyclic()) warn_of_pointer("TAILDESC", word);
  if (core_.in_soft_reset()) {
    core_.warn("/markervp/axi_dma/taildesc_in_reset",
               written() + " written during a soft reset: it is lost");
  } else if (!running()) {
    core_.warn(
        "/markervp/axi_dma/taildesc_while_halted",
        written() + " written while the channel is halted: nothing starts; set DMACR.RS before");
  } else {
    in_order_ = true;
    dmasr.clear_bits(dmasr::Idle);
    if (orders() && !cyclic()) ring_->order_to_tail(*orders());
    ring_->go_on(now());
    core_.plan_edge(std::max(now() + 1, ring_->next_edge(now())));
  }
}

bool DmaChannel::ring_rests() const {
  return !in_order_ && ring_->drained() && ring_->coalescing.delay_ends() == never;
}

// RS fell: transfers that have begun continue.
void DmaChannel::pause_ring(std::uint64_t cycle) {
  ring_->flush();
  const unsigned unused = withdraw_unused();
  ring_->drop_newest(unused);
  if (unused != 0) leave(unused);
  if (orders()) orders()->drop(under_way_);
  core_.plan_edge(cycle + 1);
}

void DmaChannel::run_ring(std::uint64_t cycle) {
  ring_->edge(cycle, cyclic());
  while (const auto written = ring_->take_written(cycle)) {
    if (written->error != 0) {
      warn_of_descriptor(written->at, written->error);
      return report_error(cycle, written->error);
    }
    if (written->ends_packet && ring_->coalescing.packet_complete()) {
      set_interrupt(dmasr::IOC_Irq, cycle);
    }
  }
  if (cycle >= ring_->coalescing.delay_ends()) {
    ring_->coalescing.delay_ended();
    set_interrupt(dmasr::Dly_Irq, cycle);
  }
  begin_descriptors(cycle);
  if (!in_order_ || !ring_->drained()) return;
  in_order_ = false;
  if (running()) {
    dmasr.set_bits(dmasr::Idle);
  } else {
    halt_after(cycle);
  }
}

void DmaChannel::begin_descriptors(std::uint64_t cycle) {
  if (!ring_) return;
  while (finish_at_ == never && accepts_segment()) {
    const Descriptor* next = ring_->ready(cycle);
    if (!next) return;
    begin_descriptor(ring_->take(), cycle);
  }
}

void DmaChannel::begin_descriptor(const Descriptor& next, std::uint64_t cycle) {
  warn_of_pointer("descriptor at " + vp::hex(next.at) + ": NXTDESC", next.next);
  if (next.error != 0) {
    warn_of_descriptor(next.at, next.error);
    return report_error(cycle, next.error);
  }
  if (under_way_++ == 0) {
    phase_ = Phase::moving;
    error_ = 0;
    if (transfer_listener_) transfer_listener_(true);
  }
  const Segment segment = segment_of(next);
  core_.check_buffer(name_, segment.address, segment.bytes);
  order(segment);
  if (segment.bytes == 0) {
    fail(cycle + core_.timing().completion_latency, dmasr::DMAIntErr);
  } else {
    const bool waited = next.ready_at < cycle;
    begin(segment, waited ? cycle + ring_->engine.descriptor_gap : cycle);
  }
}

// A tail has ordered it, but for that of a cyclic chain.
void DmaChannel::order(const Segment& segment) {
  WriteOrders* const kept = orders();
  if (!kept) return;
  kept->is_cyclic = cyclic();
  if (kept->open().size() < under_way_) kept->add(segment.address, segment.bytes);
}

DmaChannel::Segment DmaChannel::segment_of(const Descriptor& from) const {
  Segment segment;
  segment.address = aligned(from.buffer);
  segment.bytes = from.control & ring_->length_mask;
  segment.ends_packet = (from.control & descriptor::EndOfFrame) != 0;
  const auto described = [&] {
    return name_ + " descriptor at " + vp::hex(from.at) + ": CONTROL = " + vp::hex(from.control);
  };
  if (segment.bytes != (from.control & descriptor::length)) {
    core_.warn("/markervp/axi_dma/length_too_wide",
               described() + " has more bits of length than this build: they are dropped");
  }
  if (segment.bytes == 0) {
    core_.warn("/markervp/axi_dma/length_zero",
               described() + " has a length of 0: the engine stops with DMAIntErr");
  } else if (segment.bytes % beat_bytes_ != 0 && !segment.ends_packet) {
    core_.warn("/markervp/axi_dma/partial_word",
               described() +
                   " ends within a beat of the packet: buffers before the last hold "
                   "multiples of " +
                   std::to_string(beat_bytes_) + " bytes");
  }
  return segment;
}

void DmaChannel::warn_of_descriptor(std::uint32_t at, std::uint32_t error) const {
  std::string reason = " is refused by the memory (SGSlvErr)";
  if (error == dmasr::SGIntErr) {
    reason =
        " is complete already (SGIntErr): the chain loops before TAILDESC, or software did not "
        "take Cmplt out of its status";
  } else if (error == dmasr::SGDecErr) {
    reason = " leaves the memory that the DMA reaches (SGDecErr)";
  }
  core_.warn("/markervp/axi_dma/descriptor_error",
             name_ + " descriptor at " + vp::hex(at) + reason);
}

void DmaChannel::packet_begins() {
  if (ring_) ring_->coalescing.packet_begins();
}

void DmaChannel::packet_ends(std::uint64_t cycle) {
  if (ring_) ring_->coalescing.packet_ends(cycle);
}

bool DmaChannel::waits_for_packet() const {
  return ring_ && ring_->coalescing.waits_for_packet();
}

std::uint32_t DmaChannel::error_bit(tlm::tlm_response_status response) {
  if (response == tlm::TLM_OK_RESPONSE) return 0;
  return response == tlm::TLM_ADDRESS_ERROR_RESPONSE ? dmasr::DMADecErr : dmasr::DMASlvErr;
}

}  // namespace xilinx
