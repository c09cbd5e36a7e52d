// Translation and caches on, once on each core, before the program starts there.
#include <array>
#include <cstdint>

#include <slcr_registers.h>

#include "chip.h"
#include "memory_map.h"

/// The flat memory map: every virtual address is the physical one, in sections of 1 MiB (ARM
/// architecture v7-A, short descriptors).
namespace chip {

inline constexpr std::uint32_t section_count = 4096;
using TranslationTable = std::array<std::uint32_t, section_count>;

/// Descriptors without address.
namespace section {
inline constexpr std::uint32_t fault = 0;
inline constexpr std::uint32_t valid = 2u;
inline constexpr std::uint32_t bufferable = 1u << 2;
inline constexpr std::uint32_t cacheable = 1u << 3;
inline constexpr std::uint32_t execute_never = 1u << 4;
inline constexpr std::uint32_t full_access = 3u << 10;
inline constexpr std::uint32_t type_extension = 1u << 12;
inline constexpr std::uint32_t shareable = 1u << 16;

/// Write-back, write-allocate in both cache levels.
inline constexpr std::uint32_t cached =
    valid | bufferable | cacheable | full_access | type_extension | shareable;
inline constexpr std::uint32_t cached_data = cached | execute_never;
inline constexpr std::uint32_t uncached_data =
    valid | full_access | type_extension | shareable | execute_never;
/// Registers: in order, as often and as wide as written; writes may be under way.
inline constexpr std::uint32_t device =
    valid | bufferable | full_access | shareable | execute_never;
/// Registers of the PL: one access after the other.
inline constexpr std::uint32_t strongly_ordered = valid | full_access | shareable | execute_never;
}  // namespace section

/// Gives [first, end) the attributes `attributes`; both are multiples of 1 MiB.
constexpr void map(TranslationTable& table, std::uint64_t first, std::uint64_t end,
                   std::uint32_t attributes) {
  for (std::uint64_t address = first; address < end; address += CHIP_MEGABYTE) {
    table[address / CHIP_MEGABYTE] = static_cast<std::uint32_t>(address) | attributes;
  }
}

/// The Zynq-7000's address map (UG585 table 4-1). What is not named faults, address 0 included.
constexpr TranslationTable make_translation_table(bool cached_dma) {
  TranslationTable table{};
  map(table, CHIP_DDR_FIRST, CHIP_PROGRAM_END, section::cached);
  map(table, CHIP_SECOND_STACK_FIRST, CHIP_SECOND_STACK_END, section::cached_data);
  map(table, CHIP_STACK_FIRST, CHIP_STACK_END, section::cached_data);
  map(table, CHIP_DMA_FIRST, CHIP_DDR_END,
      cached_dma ? section::cached_data : section::uncached_data);
  map(table, 0x4000'0000, 0xC000'0000, section::strongly_ordered);    // M_AXI_GP0, M_AXI_GP1
  map(table, 0xE000'0000, 0xE030'0000, section::device);              // UART, Ethernet, GPIO…
  map(table, 0xE100'0000, 0xE600'0000, section::device);              // static memory controller
  map(table, 0xF800'0000, 0xF900'0000, section::device);              // SLCR, MPCore, L2 controller
  map(table, 0xFC00'0000, 0xFE00'0000, section::device);              // QSPI, linear
  map(table, 0xFFF0'0000, 0x1'0000'0000, section::strongly_ordered);  // OCM, through the HAL
  return table;
}

}  // namespace chip

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
  if (device_register(pl310::control) & 1u) {  // left on by the boot code: nothing in it is dirty
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

void enable_scu() {
  device_register(scu_invalidate) = 0xFFFF;
  device_register(scu_control) = device_register(scu_control) | 1u;
  barrier();
}

/// The CPU takes part in coherency: shareable memory is cached only then (Cortex-A9 TRM 2.4).
void join_coherency() {
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

extern "C" {

void chip_enable_memory() {
  chip::enable_scu();
  chip::join_coherency();
  chip::enable_l2();
  chip::enable_translation();
}

/// On the second core: what both share is on.
void chip_join_memory() {
  chip::join_coherency();
  chip::enable_translation();
}

}  // extern "C"
