#pragma once

#include <cstdint>

#include <vp/register_description.h>

/// AXI DMA v7.1 in direct register mode (PG021): the registers as software sees them.
namespace axi_dma {

constexpr std::uint32_t MM2S_DMACR = 0x00;
constexpr std::uint32_t MM2S_DMASR = 0x04;
constexpr std::uint32_t MM2S_SA = 0x18;
constexpr std::uint32_t MM2S_SA_MSB = 0x1C;
constexpr std::uint32_t MM2S_LENGTH = 0x28;
constexpr std::uint32_t S2MM_DMACR = 0x30;
constexpr std::uint32_t S2MM_DMASR = 0x34;
constexpr std::uint32_t S2MM_DA = 0x48;
constexpr std::uint32_t S2MM_DA_MSB = 0x4C;
constexpr std::uint32_t S2MM_LENGTH = 0x58;

/// Bits of MM2S_DMACR and S2MM_DMACR.
namespace dmacr {
constexpr std::uint32_t RS = 1u << 0;                ///< run; the hardware clears it on an error
constexpr std::uint32_t Reserved_1 = 1u << 1;        ///< always reads 1
constexpr std::uint32_t Reset = 1u << 2;             ///< resets the whole core; reads 1 until done
constexpr std::uint32_t Keyhole = 1u << 3;           ///< bursts to a fixed address
constexpr std::uint32_t Cyclic_BD_Enable = 1u << 4;  ///< no effect in direct register mode
constexpr std::uint32_t IOC_IrqEn = 1u << 12;
constexpr std::uint32_t Dly_IrqEn = 1u << 13;
constexpr std::uint32_t Err_IrqEn = 1u << 14;
constexpr unsigned IRQThreshold_shift = 16;
constexpr std::uint32_t IRQThreshold = 0xFFu << IRQThreshold_shift;  ///< writing 0 stores 1
constexpr unsigned IRQDelay_shift = 24;
constexpr std::uint32_t IRQDelay = 0xFFu << IRQDelay_shift;
}  // namespace dmacr

/// Bits of MM2S_DMASR and S2MM_DMASR.
namespace dmasr {
constexpr std::uint32_t Halted = 1u << 0;
constexpr std::uint32_t Idle = 1u << 1;
constexpr std::uint32_t SGIncld = 1u << 3;    ///< 0: no scatter-gather engine
constexpr std::uint32_t DMAIntErr = 1u << 4;  ///< sticky until reset
constexpr std::uint32_t DMASlvErr = 1u << 5;  ///< sticky until reset
constexpr std::uint32_t DMADecErr = 1u << 6;  ///< sticky until reset
constexpr std::uint32_t IOC_Irq = 1u << 12;
constexpr std::uint32_t Dly_Irq = 1u << 13;  ///< never set in direct register mode
constexpr std::uint32_t Err_Irq = 1u << 14;
constexpr std::uint32_t errors = DMAIntErr | DMASlvErr | DMADecErr;
constexpr std::uint32_t interrupts = IOC_Irq | Dly_Irq | Err_Irq;
}  // namespace dmasr

inline constexpr vp::RegisterField dmacr_fields[] = {
    {"RS", dmacr::RS, vp::Access::read_write, "1 runs; the hardware clears it on an error"},
    {"Reserved_1", dmacr::Reserved_1, vp::Access::read_only, "always 1"},
    {"Reset", dmacr::Reset, vp::Access::read_write,
     "1 resets the whole core; reads 1, in both channels, until that is done"},
    {"Keyhole", dmacr::Keyhole, vp::Access::read_write, "1: bursts go to one fixed address"},
    {"Cyclic_BD_Enable", dmacr::Cyclic_BD_Enable, vp::Access::read_write,
     "no effect in direct register mode"},
    {"IOC_IrqEn", dmacr::IOC_IrqEn, vp::Access::read_write, "1: a completed transfer interrupts"},
    {"Dly_IrqEn", dmacr::Dly_IrqEn, vp::Access::read_write, "no effect in direct register mode"},
    {"Err_IrqEn", dmacr::Err_IrqEn, vp::Access::read_write, "1: an error interrupts"},
    {"IRQThreshold", dmacr::IRQThreshold, vp::Access::read_write,
     "no effect in direct register mode; writing 0 stores 1"},
    {"IRQDelay", dmacr::IRQDelay, vp::Access::read_write, "no effect in direct register mode"},
};
inline constexpr vp::RegisterField dmasr_fields[] = {
    {"Halted", dmasr::Halted, vp::Access::read_only, "the channel stands: LENGTH starts nothing"},
    {"Idle", dmasr::Idle, vp::Access::read_only,
     "the last transfer is complete; 0 from RS = 1 until the first one is"},
    {"SGIncld", dmasr::SGIncld, vp::Access::read_only, "0: no scatter-gather engine"},
    {"DMAIntErr", dmasr::DMAIntErr, vp::Access::read_only,
     "the packet was longer than LENGTH; until reset"},
    {"DMASlvErr", dmasr::DMASlvErr, vp::Access::read_only, "the memory refused; until reset"},
    {"DMADecErr", dmasr::DMADecErr, vp::Access::read_only,
     "no memory has the address; until reset"},
    {"IOC_Irq", dmasr::IOC_Irq, vp::Access::write_1_to_clear, "a transfer completed"},
    {"Dly_Irq", dmasr::Dly_Irq, vp::Access::write_1_to_clear, "never set in direct register mode"},
    {"Err_Irq", dmasr::Err_Irq, vp::Access::write_1_to_clear, "an error came"},
};

/// Address bits that the slave decodes: the registers repeat every 1024 bytes of its window.
constexpr unsigned address_bits = 10;

/// Widest build: 26 length bits (the default build has 14; bits above read 0), 32 address bits (so
/// the MSB registers read 0). A channel that was not built reads 0 and ignores writes.
inline constexpr vp::RegisterInfo registers[] = {
    {"MM2S_DMACR", MM2S_DMACR, 0x00010002, vp::Access::read_write, 0xFFFF701D,
     "Memory to stream: control", dmacr_fields},
    {"MM2S_DMASR", MM2S_DMASR, 0x00000001, vp::Access::write_1_to_clear, 0x00007000,
     "Memory to stream: status", dmasr_fields},
    {"MM2S_SA", MM2S_SA, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
     "Memory to stream: source address"},
    {"MM2S_SA_MSB", MM2S_SA_MSB, 0x00000000, vp::Access::read_only, 0x00000000,
     "Memory to stream: source address, upper 32 bits (not in this build)"},
    {"MM2S_LENGTH", MM2S_LENGTH, 0x00000000, vp::Access::read_write, 0x03FFFFFF,
     "Memory to stream: bytes to send; writing it starts the transfer"},
    {"S2MM_DMACR", S2MM_DMACR, 0x00010002, vp::Access::read_write, 0xFFFF701D,
     "Stream to memory: control", dmacr_fields},
    {"S2MM_DMASR", S2MM_DMASR, 0x00000001, vp::Access::write_1_to_clear, 0x00007000,
     "Stream to memory: status", dmasr_fields},
    {"S2MM_DA", S2MM_DA, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
     "Stream to memory: destination address"},
    {"S2MM_DA_MSB", S2MM_DA_MSB, 0x00000000, vp::Access::read_only, 0x00000000,
     "Stream to memory: destination address, upper 32 bits (not in this build)"},
    {"S2MM_LENGTH", S2MM_LENGTH, 0x00000000, vp::Access::read_write, 0x03FFFFFF,
     "Stream to memory: room in bytes; writing it starts the transfer; then the bytes received"},
};

}  // namespace axi_dma
