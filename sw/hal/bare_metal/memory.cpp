// Translation and caches on, once, before the program starts.
#include <slcr_registers.h>

#include "device_register.h"
#include "pl310.h"
#include "translation_table.h"

namespace chip {
namespace {

#ifdef CHIP_UNCACHED_DMA
constexpr bool cached_dma = false;
#else
constexpr bool cached_dma = true;
#endif

alignas(0x4000) constexpr TranslationTable table = make_translation_table(cached_dma);

/// The table's own memory is shareable, write-back, write-allocate.
constexpr std::uint32_t table_attributes = 0x4A;

/// UG585 3.4.10: the L2 cache's RAMs need this value in the SLCR before the cache is used.
constexpr std::uint32_t slcr_l2c_ram = slcr::base + 0xA1C;
constexpr std::uint32_t l2c_ram_value = 0x0002'0202;

/// Snoop control unit of the MPCore.
constexpr std::uint32_t scu_control = 0xF8F0'0000;
constexpr std::uint32_t scu_invalidate = 0xF8F0'000C;

/// Cycles of the L2 RAMs (UG585 3.4.10): setup, read, write, each minus one.
constexpr std::uint32_t tag_cycles = 0x111;
constexpr std::uint32_t data_cycles = 0x121;
/// 8 ways of 64 KiB, early write response, prefetch of instructions and data, shared lines stay
/// cached.
constexpr std::uint32_t l2_auxiliary = 0x7276'0000;

void enable_l2() {
  device_register(slcr::base + slcr::SLCR_UNLOCK) = slcr::unlock_key;
  device_register(slcr_l2c_ram) = l2c_ram_value;
  if (device_register(pl310::control) & 1u) {  // left on by who started us: nothing of it is dirty
    device_register(pl310::control) = 0;
    barrier();
  }
  device_register(pl310::auxiliary_control) = l2_auxiliary;
  device_register(pl310::tag_latency) = tag_cycles;
  device_register(pl310::data_latency) = data_cycles;
  device_register(pl310::invalidate_ways) = pl310::all_ways;
  while (device_register(pl310::invalidate_ways) & pl310::all_ways) {
  }
  device_register(pl310::cache_sync) = 0;
  device_register(pl310::interrupt_clear) = 0x1FF;
  device_register(pl310::control) = 1;
  barrier();
}

/// The CPU takes part in coherency: shareable memory is cached only then (Cortex-A9 TRM 2.4).
void join_coherency() {
  device_register(scu_invalidate) = 0xFFFF;
  device_register(scu_control) = device_register(scu_control) | 1u;
  barrier();
  std::uint32_t auxiliary = 0;
  asm volatile("mrc p15, 0, %0, c1, c0, 1" : "=r"(auxiliary));
  auxiliary |= 1u << 6 | 1u << 0;  // SMP, and maintenance is broadcast
  asm volatile("mcr p15, 0, %0, c1, c0, 1" ::"r"(auxiliary));
  asm volatile("isb" ::: "memory");
}

void enable_translation() {
  const std::uint32_t base = reinterpret_cast<std::uint32_t>(table.data()) | table_attributes;
  asm volatile("mcr p15, 0, %0, c2, c0, 2" ::"r"(0));     // TTBCR: TTBR0 only
  asm volatile("mcr p15, 0, %0, c2, c0, 0" ::"r"(base));  // TTBR0
  asm volatile("mcr p15, 0, %0, c3, c0, 0" ::"r"(1));     // DACR: domain 0 is checked
  barrier();
  std::uint32_t control = 0;
  asm volatile("mrc p15, 0, %0, c1, c0, 0" : "=r"(control));
  control &= ~(1u << 28);                         // no TEX remap
  control |= 1u << 12 | 1u << 11 | 1u << 2 | 1u;  // I cache, branch prediction, D cache, MMU
  asm volatile("mcr p15, 0, %0, c1, c0, 0" ::"r"(control));
  asm volatile("isb" ::: "memory");
}

}  // namespace
}  // namespace chip

extern "C" void chip_enable_memory() {
  chip::join_coherency();
  chip::enable_l2();
  chip::enable_translation();
}
