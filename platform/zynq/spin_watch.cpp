#include <zynq/spin_watch.h>

#include <axi_dma_registers.h>
#include <vp/hierarchy.h>
#include <vp/report.h>
#include <vp/text.h>
#include <algorithm>
#include <string>

namespace platform {

SpinWatch::SpinWatch(Zynq& zynq) : zynq_(zynq) {
  for (xilinx::AxiDma* dma : vp::all_below<xilinx::AxiDma>(zynq.pl())) {
    if (!dma->include_s2mm) continue;
    writers_.push_back({dma, {}, {}, {}});
    dma->s2mm().m_axi.link.add_observer(*this);
  }
  zynq.ps.cpu.on_loop([this](ps::MemoryWatch& memory) { loop_noticed(memory); });
}

SpinWatch::~SpinWatch() {
  zynq_.ps.cpu.on_loop(nullptr);
  for (const Writer& writer : writers_) writer.dma->s2mm().m_axi.link.remove_observer(*this);
}

void SpinWatch::after(vp::MmLink& link, tlm::tlm_generic_payload& payload, sc_core::sc_time&) {
  if (!payload.is_response_ok()) return;
  direct(link, payload.get_command(), payload.get_address(), payload.get_data_length());
}

// Packets that follow each other in memory are one buffer; of others the last counts.
void SpinWatch::direct(vp::MmLink& link, tlm::tlm_command, std::uint64_t address,
                       std::uint64_t bytes) {
  forget_what_was_made_visible();
  for (Writer& writer : writers_) {
    if (&writer.dma->s2mm().m_axi.link != &link) continue;
    const bool follows = !writer.written.empty() && address == writer.written.end;
    if (!follows) writer.written.first = address;
    writer.written.end = address + bytes;
  }
}

void SpinWatch::forget_what_was_made_visible() {
  if (barriers_ == zynq_.ps.cpu.barriers) return;
  barriers_ = zynq_.ps.cpu.barriers;
  for (Writer& writer : writers_) writer.written = {};
}

void SpinWatch::loop_noticed(ps::MemoryWatch& memory) {
  look_at();
  if (warned_) return;
  forget_what_was_made_visible();
  where_ = zynq_.ps.cpu.where();
  memory_ = &memory;
  std::vector<ps::MemoryWatch::Range> ranges;
  for (Writer& writer : writers_) {
    writer.watched_armed = armed(*writer.dma);
    writer.watched_written = clipped(writer.written.first, writer.written.end);
    for (const Buffer& buffer : {writer.watched_written, writer.watched_armed}) {
      if (!buffer.empty()) ranges.emplace_back(buffer.first, buffer.end);
    }
  }
  memory.watch(std::move(ranges));
}

void SpinWatch::look_at() {
  if (warned_ || !memory_ || !memory_->touched()) return;
  const std::uint64_t address = *memory_->touched();
  for (const Writer& writer : writers_) {
    const bool is_armed = writer.watched_armed.has(address);
    if (!is_armed && !writer.watched_written.has(address)) continue;
    warned_ = true;
    const std::string dma = writer.dma->basename();
    vp::warn(zynq_.ps.cpu, "/markervp/cpu/spins_on_memory",
             "a loop without HAL call reads " + vp::hex(address) + ", a DMA buffer that " + dma +
                 (is_armed ? " is about to write" : " wrote, and nothing made it visible") +
                 ": it works here, and may never end on the chip; call hal_cache_invalidate() "
                 "(hal_barrier(), if DMA memory is not cached) before each look" +
                 where_);
    return;
  }
}

// A transfer has been asked for and is not complete: PG021, DMASR.Idle.
SpinWatch::Buffer SpinWatch::armed(xilinx::AxiDma& dma) const {
  const auto value = [&dma](std::uint32_t offset) { return dma.s_axi_lite.peek(offset); };
  const bool runs = (value(axi_dma::S2MM_DMACR) & axi_dma::dmacr::RS) != 0;
  const std::uint32_t status = value(axi_dma::S2MM_DMASR);
  if (!runs || (status & (axi_dma::dmasr::Idle | axi_dma::dmasr::Halted)) != 0) return {};
  const std::uint64_t first = value(axi_dma::S2MM_DA);
  return clipped(first, first + value(axi_dma::S2MM_LENGTH));
}

// The part in DMA memory that was given out: an address there is a pointer.
SpinWatch::Buffer SpinWatch::clipped(std::uint64_t first, std::uint64_t end) const {
  const ps::DmaAllocator& memory = zynq_.ps.ddr.dma_memory();
  first = std::max(first, memory.first());
  end = std::min(end, memory.first() + memory.used());
  return first < end ? Buffer{first, end} : Buffer{};
}

}  // namespace platform
