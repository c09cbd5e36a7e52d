#pragma once

#include <cstdint>

#include <vp/register_description.h>

/// AXI DMA v7.1 (PG021): the registers and descriptors as software sees them. Direct register mode
/// has address and LENGTH, scatter-gather the pointers to descriptors instead.
namespace axi_dma {

constexpr std::uint32_t MM2S_DMACR = 0x00;
constexpr std::uint32_t MM2S_DMASR = 0x04;
constexpr std::uint32_t MM2S_CURDESC = 0x08;
constexpr std::uint32_t MM2S_CURDESC_MSB = 0x0C;
constexpr std::uint32_t MM2S_TAILDESC = 0x10;
constexpr std::uint32_t MM2S_TAILDESC_MSB = 0x14;
constexpr std::uint32_t MM2S_SA = 0x18;
constexpr std::uint32_t MM2S_SA_MSB = 0x1C;
constexpr std::uint32_t MM2S_LENGTH = 0x28;
constexpr std::uint32_t S2MM_DMACR = 0x30;
constexpr std::uint32_t S2MM_DMASR = 0x34;
constexpr std::uint32_t S2MM_CURDESC = 0x38;
constexpr std::uint32_t S2MM_CURDESC_MSB = 0x3C;
constexpr std::uint32_t S2MM_TAILDESC = 0x40;
constexpr std::uint32_t S2MM_TAILDESC_MSB = 0x44;
constexpr std::uint32_t S2MM_DA = 0x48;
constexpr std::uint32_t S2MM_DA_MSB = 0x4C;
constexpr std::uint32_t S2MM_LENGTH = 0x58;

/// Bits of MM2S_DMACR and S2MM_DMACR.
namespace dmacr {
constexpr std::uint32_t RS = 1u << 0;                ///< run; the hardware clears it on an error
constexpr std::uint32_t Reserved_1 = 1u << 1;        ///< always reads 1
constexpr std::uint32_t Reset = 1u << 2;             ///< resets the whole core; reads 1 until done
constexpr std::uint32_t Keyhole = 1u << 3;           ///< bursts to a fixed address
constexpr std::uint32_t Cyclic_BD_Enable = 1u << 4;  ///< scatter-gather: the chain has no end
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
constexpr std::uint32_t SGIncld = 1u << 3;    ///< 1: built with the scatter-gather engine
constexpr std::uint32_t DMAIntErr = 1u << 4;  ///< sticky until reset
constexpr std::uint32_t DMASlvErr = 1u << 5;  ///< sticky until reset
constexpr std::uint32_t DMADecErr = 1u << 6;  ///< sticky until reset
constexpr std::uint32_t SGIntErr = 1u << 8;   ///< a complete descriptor; sticky until reset
constexpr std::uint32_t SGSlvErr = 1u << 9;   ///< sticky until reset
constexpr std::uint32_t SGDecErr = 1u << 10;  ///< sticky until reset
constexpr std::uint32_t IOC_Irq = 1u << 12;
constexpr std::uint32_t Dly_Irq = 1u << 13;  ///< never set in direct register mode
constexpr std::uint32_t Err_Irq = 1u << 14;
constexpr unsigned IRQThresholdSts_shift = 16;
constexpr std::uint32_t IRQThresholdSts = 0xFFu << IRQThresholdSts_shift;
constexpr unsigned IRQDelaySts_shift = 24;
constexpr std::uint32_t IRQDelaySts = 0xFFu << IRQDelaySts_shift;
constexpr std::uint32_t errors = DMAIntErr | DMASlvErr | DMADecErr | SGIntErr | SGSlvErr | SGDecErr;
constexpr std::uint32_t interrupts = IOC_Irq | Dly_Irq | Err_Irq;
}  // namespace dmasr

/// A descriptor: eight words in memory, at a multiple of 64 bytes. Offsets of its words, and their
/// bits. Those of user applications, behind them, belong to build options that are not modelled.
namespace descriptor {
constexpr std::uint32_t NXTDESC = 0x00;  ///< address of the next one
constexpr std::uint32_t NXTDESC_MSB = 0x04;
constexpr std::uint32_t BUFFER_ADDRESS = 0x08;
constexpr std::uint32_t BUFFER_ADDRESS_MSB = 0x0C;
constexpr std::uint32_t CONTROL = 0x18;
constexpr std::uint32_t STATUS = 0x1C;
constexpr std::uint32_t bytes = 0x20;      ///< what the engine reads
constexpr std::uint32_t alignment = 0x40;  ///< low bits of pointers are not looked at

constexpr std::uint32_t length = 0x03FF'FFFF;     ///< CONTROL: of the buffer; STATUS: transferred
constexpr std::uint32_t EndOfFrame = 1u << 26;    ///< TXEOF in CONTROL, RXEOF in STATUS
constexpr std::uint32_t StartOfFrame = 1u << 27;  ///< TXSOF in CONTROL, RXSOF in STATUS
constexpr std::uint32_t DMAIntErr = 1u << 28;     ///< STATUS
constexpr std::uint32_t DMASlvErr = 1u << 29;     ///< STATUS
constexpr std::uint32_t DMADecErr = 1u << 30;     ///< STATUS
constexpr std::uint32_t Cmplt = 1u << 31;         ///< STATUS; software takes it back
/// From the error bits of DMASR to those of STATUS.
constexpr unsigned error_shift = 24;
}  // namespace descriptor

inline constexpr vp::RegisterField dmacr_fields[] = {
    {"RS", dmacr::RS, vp::Access::read_write, "1 runs; the hardware clears it on an error"},
    {"Reserved_1", dmacr::Reserved_1, vp::Access::read_only, "always 1"},
    {"Reset", dmacr::Reset, vp::Access::read_write,
     "1 resets the whole core; reads 1, in both channels, until that is done"},
    {"Keyhole", dmacr::Keyhole, vp::Access::read_write, "1: bursts go to one fixed address"},
    {"Cyclic_BD_Enable", dmacr::Cyclic_BD_Enable, vp::Access::read_write,
     "scatter-gather, 1: TAILDESC ends nothing, complete descriptors are used again"},
    {"IOC_IrqEn", dmacr::IOC_IrqEn, vp::Access::read_write, "1: a completed transfer interrupts"},
    {"Dly_IrqEn", dmacr::Dly_IrqEn, vp::Access::read_write,
     "scatter-gather, 1: the delay timer runs and interrupts"},
    {"Err_IrqEn", dmacr::Err_IrqEn, vp::Access::read_write, "1: an error interrupts"},
    {"IRQThreshold", dmacr::IRQThreshold, vp::Access::read_write,
     "scatter-gather: packets an interrupt; writing 0 stores 1"},
    {"IRQDelay", dmacr::IRQDelay, vp::Access::read_write,
     "scatter-gather: time from a packet's end to Dly_Irq, 125 clocks each; 0: none"},
};
inline constexpr vp::RegisterField dmasr_fields[] = {
    {"Halted", dmasr::Halted, vp::Access::read_only,
     "the channel is halted: writing LENGTH starts nothing"},
    {"Idle", dmasr::Idle, vp::Access::read_only,
     "the last transfer is complete; 0 from RS = 1 until the first one is"},
    {"SGIncld", dmasr::SGIncld, vp::Access::read_only, "1: built with the scatter-gather engine"},
    {"DMAIntErr", dmasr::DMAIntErr, vp::Access::read_only,
     "the packet was longer than LENGTH, or a descriptor has no bytes; until reset"},
    {"DMASlvErr", dmasr::DMASlvErr, vp::Access::read_only, "the memory refused; until reset"},
    {"DMADecErr", dmasr::DMADecErr, vp::Access::read_only,
     "no memory has the address; until reset"},
    {"SGIntErr", dmasr::SGIntErr, vp::Access::read_only,
     "a descriptor that was complete already was read; until reset"},
    {"SGSlvErr", dmasr::SGSlvErr, vp::Access::read_only,
     "the memory refused a descriptor; until reset"},
    {"SGDecErr", dmasr::SGDecErr, vp::Access::read_only,
     "no memory has the descriptor's address; until reset"},
    {"IOC_Irq", dmasr::IOC_Irq, vp::Access::write_1_to_clear,
     "a transfer completed; scatter-gather: IRQThreshold packets"},
    {"Dly_Irq", dmasr::Dly_Irq, vp::Access::write_1_to_clear,
     "the delay timer ran out; never set in direct register mode"},
    {"Err_Irq", dmasr::Err_Irq, vp::Access::write_1_to_clear, "an error came"},
    {"IRQThresholdSts", dmasr::IRQThresholdSts, vp::Access::read_only,
     "packets up to the next interrupt; 0 in direct register mode"},
    {"IRQDelaySts", dmasr::IRQDelaySts, vp::Access::read_only,
     "what the delay timer has counted; 0 in direct register mode"},
};

/// Address bits that the slave decodes: the registers repeat every 1024 bytes of its window.
constexpr unsigned address_bits = 10;

/// Widest build: 26 length bits (the default build has 14; bits above read 0), 32 address bits (so
/// the MSB registers read 0). A channel that was not built reads 0 and ignores writes, and so do
/// the registers of the mode that was not built. Reset values are those of direct register mode.
inline constexpr vp::RegisterInfo registers[] = {
    {"MM2S_DMACR", MM2S_DMACR, 0x00010002, vp::Access::read_write, 0xFFFF701D,
     "Memory to stream: control", dmacr_fields},
    {"MM2S_DMASR", MM2S_DMASR, 0x00000001, vp::Access::write_1_to_clear, 0x00007000,
     "Memory to stream: status", dmasr_fields},
    {"MM2S_CURDESC", MM2S_CURDESC, 0x00000000, vp::Access::read_write, 0xFFFFFFC0,
     "Memory to stream: the descriptor in work; writable while halted"},
    {"MM2S_CURDESC_MSB", MM2S_CURDESC_MSB, 0x00000000, vp::Access::read_only, 0x00000000,
     "Memory to stream: the descriptor in work, upper 32 bits (not in this build)"},
    {"MM2S_TAILDESC", MM2S_TAILDESC, 0x00000000, vp::Access::read_write, 0xFFFFFFC0,
     "Memory to stream: the descriptor to pause after; writing it starts"},
    {"MM2S_TAILDESC_MSB", MM2S_TAILDESC_MSB, 0x00000000, vp::Access::read_only, 0x00000000,
     "Memory to stream: the descriptor to pause after, upper 32 bits (not in this build)"},
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
    {"S2MM_CURDESC", S2MM_CURDESC, 0x00000000, vp::Access::read_write, 0xFFFFFFC0,
     "Stream to memory: the descriptor in work; writable while halted"},
    {"S2MM_CURDESC_MSB", S2MM_CURDESC_MSB, 0x00000000, vp::Access::read_only, 0x00000000,
     "Stream to memory: the descriptor in work, upper 32 bits (not in this build)"},
    {"S2MM_TAILDESC", S2MM_TAILDESC, 0x00000000, vp::Access::read_write, 0xFFFFFFC0,
     "Stream to memory: the descriptor to pause after; writing it starts"},
    {"S2MM_TAILDESC_MSB", S2MM_TAILDESC_MSB, 0x00000000, vp::Access::read_only, 0x00000000,
     "Stream to memory: the descriptor to pause after, upper 32 bits (not in this build)"},
    {"S2MM_DA", S2MM_DA, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
     "Stream to memory: destination address"},
    {"S2MM_DA_MSB", S2MM_DA_MSB, 0x00000000, vp::Access::read_only, 0x00000000,
     "Stream to memory: destination address, upper 32 bits (not in this build)"},
    {"S2MM_LENGTH", S2MM_LENGTH, 0x00000000, vp::Access::read_write, 0x03FFFFFF,
     "Stream to memory: room in bytes; writing it starts the transfer; then the bytes received"},
};

}  // namespace axi_dma
