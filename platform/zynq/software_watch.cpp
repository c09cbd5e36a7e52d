#include <zynq/software_watch.h>

#include <algorithm>
#include <cstring>
#include <string>

#include <axi_dma_registers.h>
#include <vp/ip.h>
#include <vp/report.h>
#include <vp/text.h>
#include <xilinx/axi_dma/dma_channel.h>

namespace platform {

namespace {

constexpr std::uint64_t line = ps::DmaAllocator::cache_line;

/// std::any_of without an early end: nearly always there is none, and so it is vectorised.
template <class Predicate>
bool any_of_all(const std::vector<unsigned char>& values, Predicate predicate) {
  unsigned char any = 0;
  for (const unsigned char value : values) any |= static_cast<unsigned char>(predicate(value));
  return any != 0;
}

}  // namespace

CacheContract::Watch::Watch(CacheContract& contract, vp::MmLink& link)
    : contract_(contract), link_(link) {
  link_.add_observer(*this);
}

void CacheContract::Watch::after(vp::MmLink& link, tlm::tlm_generic_payload& payload,
                                 sc_core::sc_time&) {
  if (!payload.is_response_ok()) return;
  direct(link, payload.get_command(), payload.get_address(), payload.get_data_length());
}

void CacheContract::Watch::direct(vp::MmLink&, tlm::tlm_command command, std::uint64_t address,
                                  std::uint64_t bytes) {
  if (command == tlm::TLM_READ_COMMAND) {
    contract_.device_reads(address, bytes);
  } else {
    contract_.device_wrote(address, bytes);
  }
}

CacheContract::CacheContract(Zynq& zynq)
    : zynq_(zynq), first_(zynq.ps.ddr.dma_memory().first()), end_(zynq.ps.ddr.dma_memory().end()) {
  for (xilinx::MemoryPort* port : vp::all_below<xilinx::MemoryPort>(zynq.pl())) {
    watches_.emplace_back(*this, port->link);
  }
  zynq.ps.cpu.on_cache_call(
      [this](ps::Cpu::CacheCall call, std::uintptr_t address, std::size_t bytes) {
        if (call == ps::Cpu::CacheCall::flush) {
          flushed(address, bytes);
        } else {
          mark(address, bytes, invalidated);
        }
      });
  zynq.on_poke([this](std::uint32_t address) { placed(address, sizeof address); });
  check_transfers();
}

CacheContract::~CacheContract() {
  zynq_.ps.cpu.on_cache_call(nullptr);
  zynq_.on_poke(nullptr);
  for (xilinx::AxiDma* dma : vp::all_below<xilinx::AxiDma>(zynq_.pl())) dma->check_buffers(nullptr);
}

// What is not of hal_dma_allocate() is the program's own affair.
void CacheContract::check_transfers() {
  const ps::DmaAllocator& memory = zynq_.ps.ddr.dma_memory();
  const auto check = [&memory](std::uint64_t address, std::uint64_t bytes) -> std::string {
    const auto buffer = memory.buffer_at(address);
    if (!buffer || address + bytes <= buffer->end) return {};
    return "leaves its buffer, " + std::to_string(buffer->end - buffer->first) + " bytes at " +
           vp::hex(buffer->first) + ", by " + std::to_string(address + bytes - buffer->end) +
           " bytes: allocate more, or transfer less";
  };
  for (xilinx::AxiDma* dma : vp::all_below<xilinx::AxiDma>(zynq_.pl())) dma->check_buffers(check);
}

bool CacheContract::watches(std::uint64_t address, std::uint64_t bytes) const {
  return bytes != 0 && address >= first_ && address < end_;
}

void CacheContract::mark(std::uint64_t address, std::uint64_t bytes, unsigned marks,
                         unsigned cleared) {
  if (!watches(address, bytes)) return;
  const std::uint64_t from = (address - first_) / line;
  const std::uint64_t to = (std::min(address + bytes, end_) - 1 - first_) / line;
  if (lines_.size() <= to) {
    lines_.resize(to + 1);
    memory_.resize((to + 1) * line);
  }
  const auto bits = static_cast<unsigned char>(marks);
  const auto kept = static_cast<unsigned char>(~cleared);
  unsigned char* const lines = lines_.data();
  for (std::uint64_t i = from; i <= to; ++i)
    lines[i] = static_cast<unsigned char>((lines[i] & kept) | bits);
}

// Whole lines leave the cache.
void CacheContract::flushed(std::uint64_t address, std::uint64_t bytes) {
  if (!watches(address, bytes)) return;
  mark(address, bytes, current, given);
  const std::uint64_t from = address / line * line;
  copy(from, (address + bytes + line - 1) / line * line - from);
}

void CacheContract::device_wrote(std::uint64_t address, std::uint64_t bytes) {
  if (!watches(address, bytes)) return;
  mark(address, bytes, current | written);
  copy(address, bytes);
}

// From what the program sees to what lies behind the caches.
void CacheContract::copy(std::uint64_t address, std::uint64_t bytes) {
  bytes = std::min(address + bytes, end_) - address;
  std::memcpy(memory_.data() + (address - first_),
              zynq_.ps.ddr.at(static_cast<std::uint32_t>(address), bytes), bytes);
}

// The first address whose byte a device does not see as the program does.
std::optional<std::uint64_t> CacheContract::first_stale(std::uint64_t address,
                                                        std::uint64_t bytes) const {
  const std::uint64_t end = std::min(address + bytes, end_);
  for (std::uint64_t at = address; at < end;) {
    const std::uint64_t number = (at - first_) / line;
    const std::uint64_t next = std::min(end, first_ + (number + 1) * line);
    const unsigned marks = number < lines_.size() ? lines_[number] : 0u;
    if ((marks & current) == 0) return at;
    if ((marks & given) == 0) {
      const unsigned char* const seen = memory_.data() + (at - first_);
      const unsigned char* const wrote = zynq_.ps.ddr.at(static_cast<std::uint32_t>(at), next - at);
      const auto* const here = std::mismatch(seen, seen + (next - at), wrote).first;
      if (here != seen + (next - at)) return at + static_cast<std::uint64_t>(here - seen);
    }
    at = next;
  }
  return std::nullopt;
}

void CacheContract::device_reads(std::uint64_t address, std::uint64_t bytes) {
  if (warned_of_read_ || !watches(address, bytes)) return;
  const std::optional<std::uint64_t> stale = first_stale(address, bytes);
  if (!stale) return;
  warned_of_read_ = true;
  const std::uint64_t number = (*stale - first_) / line;
  const bool once = number < lines_.size() && (lines_[number] & current) != 0;
  vp::warn(zynq_.ps.cpu, "/markervp/cpu/not_flushed",
           "a DMA reads " + vp::hex(*stale) +
               (once ? ", which the program wrote after it was flushed"
                     : ", which the program never flushed") +
               ": it works here, and fails on the chip; call hal_cache_flush() " +
               (once ? "between the last write and the transfer" : "before the transfer"));
}

void CacheContract::published() {
  if (warned_of_write_) return;
  const auto stale = [](unsigned char marks) {
    return (marks & (written | invalidated)) == written;
  };
  if (!any_of_all(lines_, stale)) return;
  for (std::uint64_t i = 0; i < lines_.size(); ++i) {
    if (!stale(lines_[i])) continue;
    warned_of_write_ = true;
    vp::warn(zynq_.ps.cpu, "/markervp/cpu/not_invalidated",
             "a DMA wrote " + vp::hex(first_ + i * line) +
                 ", which the program never invalidated before it published a result: it works "
                 "here, and fails on the chip; call hal_cache_invalidate() after the transfer");
    return;
  }
}

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
