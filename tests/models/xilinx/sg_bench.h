#pragma once

#include <cstdint>
#include <cstring>

#include "dma_bench.h"

namespace kit {

using namespace axi_dma;

constexpr std::uint32_t ring = DmaBench::memory_base + 0x1000;
constexpr std::uint32_t other_ring = DmaBench::memory_base + 0x2000;
constexpr std::uint32_t eof = descriptor::EndOfFrame, sof = descriptor::StartOfFrame;

inline xilinx::AxiDmaBuild with_sg() {
  xilinx::AxiDmaBuild build;
  build.include_sg = true;
  return build;
}

/// The registers of a channel.
struct Pointers {
  std::uint32_t control, status, current, tail;
};
constexpr Pointers mm2s_registers{MM2S_DMACR, MM2S_DMASR, MM2S_CURDESC, MM2S_TAILDESC};
constexpr Pointers s2mm_registers{S2MM_DMACR, S2MM_DMASR, S2MM_CURDESC, S2MM_TAILDESC};

/// The DMA with scatter-gather, and rings of descriptors in its memory.
struct SgBench : DmaBench {
  explicit SgBench(const xilinx::AxiDmaBuild& build = with_sg()) : DmaBench(build) {
    std::memset(memory.data() + 0x1000, 0, 0x2000);
  }

  /// The `index`th descriptor of the ring at `base`, linked to the next one.
  static std::uint32_t nth(std::uint32_t base, unsigned index) { return base + 0x40 * index; }
  void put(std::uint32_t address, std::uint32_t word) {
    std::memcpy(memory.data() + (address - memory_base), &word, sizeof word);
  }
  std::uint32_t get(std::uint32_t address) const { return memory.word(address - memory_base); }
  void describe(std::uint32_t at, std::uint32_t next, std::uint32_t buffer, std::uint32_t control) {
    put(at + descriptor::NXTDESC, next);
    put(at + descriptor::BUFFER_ADDRESS, buffer);
    put(at + descriptor::CONTROL, control);
    put(at + descriptor::STATUS, 0);
  }
  /// A ring of `count` descriptors whose buffers of `bytes` lie one behind the other.
  void describe_ring(std::uint32_t base, unsigned count, std::uint32_t buffers, std::uint32_t bytes,
                     std::uint32_t flags) {
    for (unsigned i = 0; i < count; ++i) {
      describe(nth(base, i), nth(base, (i + 1) % count), buffers + i * bytes, bytes | flags);
    }
  }
  std::uint32_t status_of(std::uint32_t at) const { return get(at + descriptor::STATUS); }
  void run(const Pointers& channel, std::uint32_t first, std::uint32_t control = dmacr::IOC_IrqEn) {
    write(channel.current, first);
    write(channel.control, control | dmacr::RS | 1u << dmacr::IRQThreshold_shift);
    at(clock.cycle() + 5);
  }
  /// Just after edge `cycle`, with all that ran on it.
  void settle_at(std::uint64_t cycle) {
    at(cycle);
    scheduler.synchronise();
  }
  std::uint32_t bits(std::uint32_t offset, std::uint32_t mask) { return read(offset) & mask; }
  std::uint64_t wait_for(const Pointers& channel, std::uint32_t mask) {
    return first_edge([&] { return status(channel.status, mask); });
  }
};

constexpr std::uint32_t not_counts = ~(dmasr::IRQThresholdSts | dmasr::IRQDelaySts);

}  // namespace kit
