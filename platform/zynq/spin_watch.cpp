#include <zynq/spin_watch.h>

#include <axi_dma_registers.h>
#include <vp/hex.h>
#include <vp/report.h>
#include <algorithm>
#include <cstring>
#include <string>

namespace platform {

SpinWatch::SpinWatch(Zynq& zynq) : zynq_(zynq) {
  for (const vp::Router::Region& region : zynq.pl.axi_interconnect.regions()) {
    if (region.name == "axi_dma_1") dma_base_ = static_cast<std::uint32_t>(region.base);
  }
  zynq.pl.axi_dma_1.s2mm().m_axi.link.add_observer(*this);
  zynq.ps.cpu.on_loop([this](ps::MemoryWatch& memory) { loop_noticed(memory); });
}

SpinWatch::~SpinWatch() {
  zynq_.ps.cpu.on_loop(nullptr);
  zynq_.pl.axi_dma_1.s2mm().m_axi.link.remove_observer(*this);
}

void SpinWatch::after(vp::MmLink& link, tlm::tlm_generic_payload& payload, sc_core::sc_time&) {
  if (!payload.is_response_ok()) return;
  direct(link, payload.get_command(), payload.get_address(), payload.get_data_length());
}

// Packets that follow each other in memory are one buffer; of others the last counts.
void SpinWatch::direct(vp::MmLink&, tlm::tlm_command, std::uint64_t address, std::uint64_t bytes) {
  forget_what_was_made_visible();
  const bool follows = !written_.empty() && address == written_.end;
  if (!follows) written_.first = address;
  written_.end = address + bytes;
}

void SpinWatch::forget_what_was_made_visible() {
  if (barriers_ != zynq_.ps.cpu.barriers) written_ = {};
  barriers_ = zynq_.ps.cpu.barriers;
}

void SpinWatch::loop_noticed(ps::MemoryWatch& memory) {
  look_at();
  if (warned_) return;
  forget_what_was_made_visible();
  watched_armed_ = armed();
  watched_written_ = clipped(written_.first, written_.end);
  where_ = zynq_.ps.cpu.where();
  memory_ = &memory;
  std::vector<ps::MemoryWatch::Range> ranges;
  for (const Buffer& buffer : {watched_written_, watched_armed_}) {
    if (!buffer.empty()) ranges.emplace_back(buffer.first, buffer.end);
  }
  memory.watch(std::move(ranges));
}

void SpinWatch::look_at() {
  if (warned_ || !memory_ || !memory_->touched()) return;
  const std::uint64_t address = *memory_->touched();
  const bool is_armed = watched_armed_.has(address);
  if (!is_armed && !watched_written_.has(address)) return;
  warned_ = true;
  vp::warn(zynq_.ps.cpu, "/markervp/cpu/spins_on_memory",
           "a loop without HAL call reads " + vp::hex(address) +
               (is_armed ? ", a DMA buffer that axi_dma_1 is about to write"
                         : ", a DMA buffer that axi_dma_1 wrote, and nothing made it visible") +
               ": it works here, and may never end on the chip; call hal_cache_invalidate() "
               "(hal_barrier(), if DMA memory is not cached) before each look" +
               where_);
}

// A transfer has been asked for and is not complete: PG021, DMASR.Idle.
SpinWatch::Buffer SpinWatch::armed() const {
  const bool runs = (peek(axi_dma::S2MM_DMACR) & axi_dma::dmacr::RS) != 0;
  const std::uint32_t status = peek(axi_dma::S2MM_DMASR);
  if (!runs || (status & (axi_dma::dmasr::Idle | axi_dma::dmasr::Halted)) != 0) return {};
  const std::uint64_t first = peek(axi_dma::S2MM_DA);
  return clipped(first, first + peek(axi_dma::S2MM_LENGTH));
}

// The part in DMA memory that was given out: an address there is a pointer.
SpinWatch::Buffer SpinWatch::clipped(std::uint64_t first, std::uint64_t end) const {
  const ps::DmaAllocator& memory = zynq_.ps.ddr.dma_memory();
  first = std::max(first, memory.first());
  end = std::min(end, memory.first() + memory.used());
  return first < end ? Buffer{first, end} : Buffer{};
}

std::uint32_t SpinWatch::peek(std::uint32_t offset) const {
  std::uint32_t word = 0;
  unsigned char bytes[sizeof word] = {};
  tlm::tlm_generic_payload payload;
  payload.set_command(tlm::TLM_READ_COMMAND);
  payload.set_address(dma_base_ + offset);
  payload.set_data_ptr(bytes);
  payload.set_data_length(sizeof bytes);
  payload.set_streaming_width(sizeof bytes);
  zynq_.ps.cpu.m_axi.transport_debug(payload);
  std::memcpy(&word, bytes, sizeof word);
  return word;
}

}  // namespace platform
