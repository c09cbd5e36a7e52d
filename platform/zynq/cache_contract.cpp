#include <zynq/cache_contract.h>

#include <vp/hierarchy.h>
#include <vp/report.h>
#include <vp/text.h>
#include <xilinx/axi_dma/memory_port.h>
#include <algorithm>

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
    contract_.mark(address, bytes, current | written);
  }
}

CacheContract::CacheContract(Zynq& zynq)
    : zynq_(zynq), first_(zynq.ps.ddr.dma_memory().first()), end_(zynq.ps.ddr.dma_memory().end()) {
  for (xilinx::MemoryPort* port : vp::all_below<xilinx::MemoryPort>(zynq.pl())) {
    watches_.emplace_back(*this, port->link);
  }
  zynq.ps.cpu.on_cache_call(
      [this](ps::Cpu::CacheCall call, std::uintptr_t address, std::size_t bytes) {
        mark(address, bytes, call == ps::Cpu::CacheCall::flush ? current : invalidated);
      });
}

CacheContract::~CacheContract() {
  zynq_.ps.cpu.on_cache_call(nullptr);
}

void CacheContract::mark(std::uint64_t address, std::uint64_t bytes, unsigned marks) {
  if (bytes == 0 || address < first_ || address >= end_) return;
  const std::uint64_t from = (address - first_) / line;
  const std::uint64_t to = (std::min(address + bytes, end_) - 1 - first_) / line;
  if (lines_.size() <= to) lines_.resize(to + 1);
  const auto bits = static_cast<unsigned char>(marks);
  unsigned char* const lines = lines_.data();
  for (std::uint64_t i = from; i <= to; ++i) lines[i] = static_cast<unsigned char>(lines[i] | bits);
}

void CacheContract::device_reads(std::uint64_t address, std::uint64_t bytes) {
  if (warned_of_read_ || bytes == 0 || address < first_ || address >= end_) return;
  const std::uint64_t to = (std::min(address + bytes, end_) - 1 - first_) / line;
  const std::uint64_t known = lines_.size();
  const unsigned char* const lines = lines_.data();
  for (std::uint64_t i = (address - first_) / line; i <= to; ++i) {
    if (i < known && (lines[i] & current) != 0) continue;
    warned_of_read_ = true;
    vp::warn(zynq_.ps.cpu, "/markervp/cpu/not_flushed",
             "a DMA reads " + vp::hex(first_ + i * line) +
                 ", which the program never flushed: it works here, and fails on the chip; call "
                 "hal_cache_flush() before the transfer");
    return;
  }
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

}  // namespace platform
