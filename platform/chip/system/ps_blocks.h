#pragma once

#include <cstdint>

namespace platform {

/// A range of addresses of the Zynq-7000 that a program may expect something at (UG585 chapter 4
/// and appendix B).
struct PsBlock {
  std::uint64_t base, size;
  const char* name;
};

inline constexpr PsBlock ps_blocks[] = {
    {0x8000'0000, 0x4000'0000, "M_AXI_GP1"},
    {0xE000'0000, 0x1000, "UART 0"},
    {0xE000'1000, 0x1000, "UART 1"},
    {0xE000'2000, 0x1000, "USB 0"},
    {0xE000'3000, 0x1000, "USB 1"},
    {0xE000'4000, 0x1000, "I2C 0"},
    {0xE000'5000, 0x1000, "I2C 1"},
    {0xE000'6000, 0x1000, "SPI 0"},
    {0xE000'7000, 0x1000, "SPI 1"},
    {0xE000'8000, 0x1000, "CAN 0"},
    {0xE000'9000, 0x1000, "CAN 1"},
    {0xE000'A000, 0x1000, "GPIO of the PS (MIO and EMIO)"},
    {0xE000'B000, 0x1000, "Ethernet (GEM) 0"},
    {0xE000'C000, 0x1000, "Ethernet (GEM) 1"},
    {0xE000'D000, 0x1000, "Quad-SPI"},
    {0xE000'E000, 0x1000, "Static memory controller"},
    {0xE010'0000, 0x1000, "SDIO 0"},
    {0xE010'1000, 0x1000, "SDIO 1"},
    {0xE100'0000, 0x0500'0000, "Memories of the static memory controller"},
    {0xF800'0000, 0x1000, "System level control registers"},
    {0xF800'1000, 0x1000, "Triple timer counter 0"},
    {0xF800'2000, 0x1000, "Triple timer counter 1"},
    {0xF800'3000, 0x1000, "DMA controller of the PS (PL330), secure"},
    {0xF800'4000, 0x1000, "DMA controller of the PS (PL330), non-secure"},
    {0xF800'5000, 0x1000, "System watchdog"},
    {0xF800'6000, 0x1000, "DDR memory controller: boot code waits for mode_sts_reg, 0xF800_6054"},
    {0xF800'7000, 0x100, "Device configuration (bitstreams)"},
    {0xF800'7100, 0x100, "XADC interface"},
    {0xF800'8000, 0x1000, "AXI_HP 0 interface"},
    {0xF800'9000, 0x1000, "AXI_HP 1 interface"},
    {0xF800'A000, 0x1000, "AXI_HP 2 interface"},
    {0xF800'B000, 0x1000, "AXI_HP 3 interface"},
    {0xF800'C000, 0x1000, "On-chip memory control"},
    {0xF880'0000, 0x10'0000, "CoreSight debug"},
    {0xF890'0000, 0x10'0000, "Interconnect control (GPV)"},
    {0xF8F0'0000, 0x100, "Snoop control unit"},
    {0xF8F0'0100, 0x100, "Interrupt controller, CPU interface"},
    {0xF8F0'0200, 0x100, "Global timer"},
    {0xF8F0'0600, 0x100, "Private timer and watchdog"},
    {0xF8F0'1000, 0x1000, "Interrupt controller, distributor"},
    {0xF8F0'2000, 0x1000, "L2 cache controller (PL310)"},
    {0xFC00'0000, 0x0200'0000, "Flash behind Quad-SPI (memory-mapped mode)"},
};

/// The block at an address; null: the chip has none there.
inline const PsBlock* ps_block_at(std::uint64_t address) {
  for (const PsBlock& block : ps_blocks) {
    if (address >= block.base && address - block.base < block.size) return &block;
  }
  return nullptr;
}

}  // namespace platform
