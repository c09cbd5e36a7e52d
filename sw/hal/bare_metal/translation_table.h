#pragma once

#include <array>
#include <cstdint>

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
