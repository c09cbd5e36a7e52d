#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// AXI VDMA v6.3 (PG020), direct registers. What it does not tell (fixed bits, values after reset)
/// is from the vendor's HDL.
namespace axi_vdma {

constexpr std::uint32_t PARK_PTR_REG = 0x28;
constexpr std::uint32_t VDMA_VERSION = 0x2C;
constexpr std::uint32_t S2MM_VDMA_IRQ_MASK = 0x3C;
constexpr unsigned address_bits = 9;
constexpr std::uint32_t most_frame_stores = 16;  ///< that one set of registers has

/// Where a channel's registers lie.
struct ChannelOffsets {
  std::uint32_t control, status, vsize, hsize, stride, first_address;
  unsigned park_shift;  ///< of its frame store in PARK_PTR_REG, five bits wide
};
constexpr ChannelOffsets mm2s{0x00, 0x04, 0x50, 0x54, 0x58, 0x5C, 0};
constexpr ChannelOffsets s2mm{0x30, 0x34, 0xA0, 0xA4, 0xA8, 0xAC, 8};
constexpr std::uint32_t park_mask = 0x1F;

/// Bits of a VDMACR.
namespace vdmacr {
constexpr std::uint32_t RS = 1u << 0;
constexpr std::uint32_t Circular_Park = 1u << 1;
constexpr std::uint32_t Reset = 1u << 2;
constexpr std::uint32_t GenlockEn = 1u << 3;
constexpr std::uint32_t FrameCntEn = 1u << 4;
constexpr std::uint32_t GenlockSrc = 1u << 7;
constexpr std::uint32_t FrmCnt_IrqEn = 1u << 12;
constexpr std::uint32_t DlyCnt_IrqEn = 1u << 13;
constexpr std::uint32_t Err_IrqEn = 1u << 14;
constexpr unsigned IRQFrameCount_shift = 16;
constexpr unsigned IRQDelayCount_shift = 24;
constexpr std::uint32_t count_mask = 0xFF;  ///< of both, shifted
}  // namespace vdmacr

/// Bits of a VDMASR.
namespace vdmasr {
constexpr std::uint32_t Halted = 1u << 0;
constexpr std::uint32_t VDMAIntErr = 1u << 4;
constexpr std::uint32_t VDMASlvErr = 1u << 5;
constexpr std::uint32_t VDMADecErr = 1u << 6;
constexpr std::uint32_t SOFEarlyErr = 1u << 7;
constexpr std::uint32_t EOLEarlyErr = 1u << 8;
constexpr std::uint32_t SOFLateErr = 1u << 11;
constexpr std::uint32_t FrmCnt_Irq = 1u << 12;
constexpr std::uint32_t DlyCnt_Irq = 1u << 13;
constexpr std::uint32_t Err_Irq = 1u << 14;
constexpr std::uint32_t EOLLateErr = 1u << 15;
constexpr std::uint32_t interrupts = FrmCnt_Irq | DlyCnt_Irq | Err_Irq;
constexpr std::uint32_t cleared_by_1 =
    SOFEarlyErr | EOLEarlyErr | SOFLateErr | EOLLateErr | interrupts;
}  // namespace vdmasr

inline constexpr vp::RegisterField vdmacr_fields[] = {
    {"RS", vdmacr::RS, vp::Access::read_write, "run"},
    {"Circular_Park", vdmacr::Circular_Park, vp::Access::read_write, "0: one frame store only"},
    {"Reset", vdmacr::Reset, vp::Access::read_write, "of the channel; it clears itself"},
    {"GenlockEn", vdmacr::GenlockEn, vp::Access::read_write,
     "frame stores follow the other channel"},
    {"FrameCntEn", vdmacr::FrameCntEn, vp::Access::read_write, "halts after IRQFrameCount frames"},
    {"GenlockSrc", vdmacr::GenlockSrc, vp::Access::read_write, "1: the other channel of this core"},
    {"FrmCnt_IrqEn", vdmacr::FrmCnt_IrqEn, vp::Access::read_write, "interrupt of FrmCnt_Irq"},
    {"DlyCnt_IrqEn", vdmacr::DlyCnt_IrqEn, vp::Access::read_write, "interrupt of DlyCnt_Irq"},
    {"Err_IrqEn", vdmacr::Err_IrqEn, vp::Access::read_write, "interrupt of Err_Irq"},
    {"IRQFrameCount", 0x00FF0000, vp::Access::read_write, "frames to an interrupt"},
    {"IRQDelayCount", 0xFF000000, vp::Access::read_write, "clocks without a frame, by 125"},
};

inline constexpr vp::RegisterField vdmasr_fields[] = {
    {"Halted", vdmasr::Halted, vp::Access::read_only, "it does not run"},
    {"VDMAIntErr", vdmasr::VDMAIntErr, vp::Access::read_only, "an order that makes no sense"},
    {"VDMASlvErr", vdmasr::VDMASlvErr, vp::Access::read_only, "the memory answered SLVERR"},
    {"VDMADecErr", vdmasr::VDMADecErr, vp::Access::read_only, "the memory answered DECERR"},
    {"SOFEarlyErr", vdmasr::SOFEarlyErr, vp::Access::write_1_to_clear, "a frame has too few lines"},
    {"EOLEarlyErr", vdmasr::EOLEarlyErr, vp::Access::write_1_to_clear, "a line is shorter"},
    {"SOFLateErr", vdmasr::SOFLateErr, vp::Access::write_1_to_clear, "a frame has too many lines"},
    {"FrmCnt_Irq", vdmasr::FrmCnt_Irq, vp::Access::write_1_to_clear, "IRQFrameCount frames passed"},
    {"DlyCnt_Irq", vdmasr::DlyCnt_Irq, vp::Access::write_1_to_clear, "no frame for long"},
    {"Err_Irq", vdmasr::Err_Irq, vp::Access::write_1_to_clear, "one of the errors"},
    {"EOLLateErr", vdmasr::EOLLateErr, vp::Access::write_1_to_clear, "a line is longer"},
    {"IRQFrameCntSts", 0x00FF0000, vp::Access::read_only, "frames left to the next interrupt"},
    {"IRQDelayCntSts", 0xFF000000, vp::Access::read_only, "not counted here"},
};

inline constexpr vp::RegisterInfo registers[] = {
    {"MM2S_VDMACR", 0x00, 0x00010002, vp::Access::read_write, 0xFFFFFFFB, "Control", vdmacr_fields},
    {"MM2S_VDMASR", 0x04, 0x00010001, vp::Access::write_1_to_clear, vdmasr::cleared_by_1, "Status",
     vdmasr_fields},
    {"MM2S_REG_INDEX", 0x14, 0, vp::Access::read_only, 0, "Frame stores above 16: not built"},
    {"MM2S_THRESHOLD", 0x1C, 0, vp::Access::read_only, 0, "Of the line buffer: not built"},
    {"PARK_PTR_REG", PARK_PTR_REG, 0, vp::Access::read_write, 0x00001F1F,
     "Frame stores: parked, and under way"},
    {"VDMA_VERSION", VDMA_VERSION, 0x62000050, vp::Access::read_only, 0, "Version 6.3"},
    {"S2MM_VDMACR", 0x30, 0x00010002, vp::Access::read_write, 0xFFFFFFFB, "Control", vdmacr_fields},
    {"S2MM_VDMASR", 0x34, 0x00010001, vp::Access::write_1_to_clear, vdmasr::cleared_by_1, "Status",
     vdmasr_fields},
    {"S2MM_REG_INDEX", 0x44, 0, vp::Access::read_only, 0, "Frame stores above 16: not built"},
    {"S2MM_THRESHOLD", 0x4C, 0, vp::Access::read_only, 0, "Of the line buffer: not built"},
    {"S2MM_VDMA_IRQ_MASK", S2MM_VDMA_IRQ_MASK, 0, vp::Access::read_write, 0xF,
     "Errors of the stream that raise no interrupt"},
    {"MM2S_VSIZE", 0x50, 0, vp::Access::read_write, 0x1FFF, "Lines of a frame; a write starts"},
    {"MM2S_HSIZE", 0x54, 0, vp::Access::read_write, 0xFFFF, "Bytes of a line"},
    {"MM2S_FRMDLY_STRIDE", 0x58, 0, vp::Access::read_write, 0x1F00FFFF, "Bytes from line to line"},
    {"MM2S_START_ADDRESS1", 0x5C, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 1, read"},
    {"MM2S_START_ADDRESS2", 0x60, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 2, read"},
    {"MM2S_START_ADDRESS3", 0x64, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 3, read"},
    {"MM2S_START_ADDRESS4", 0x68, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 4, read"},
    {"MM2S_START_ADDRESS5", 0x6C, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 5, read"},
    {"MM2S_START_ADDRESS6", 0x70, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 6, read"},
    {"MM2S_START_ADDRESS7", 0x74, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 7, read"},
    {"MM2S_START_ADDRESS8", 0x78, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 8, read"},
    {"MM2S_START_ADDRESS9", 0x7C, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 9, read"},
    {"MM2S_START_ADDRESS10", 0x80, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 10, read"},
    {"MM2S_START_ADDRESS11", 0x84, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 11, read"},
    {"MM2S_START_ADDRESS12", 0x88, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 12, read"},
    {"MM2S_START_ADDRESS13", 0x8C, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 13, read"},
    {"MM2S_START_ADDRESS14", 0x90, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 14, read"},
    {"MM2S_START_ADDRESS15", 0x94, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 15, read"},
    {"MM2S_START_ADDRESS16", 0x98, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 16, read"},
    {"S2MM_VSIZE", 0xA0, 0, vp::Access::read_write, 0x1FFF, "Lines of a frame; a write starts"},
    {"S2MM_HSIZE", 0xA4, 0, vp::Access::read_write, 0xFFFF, "Bytes of a line"},
    {"S2MM_FRMDLY_STRIDE", 0xA8, 0, vp::Access::read_write, 0x1F00FFFF, "Bytes from line to line"},
    {"S2MM_START_ADDRESS1", 0xAC, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 1, written"},
    {"S2MM_START_ADDRESS2", 0xB0, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 2, written"},
    {"S2MM_START_ADDRESS3", 0xB4, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 3, written"},
    {"S2MM_START_ADDRESS4", 0xB8, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 4, written"},
    {"S2MM_START_ADDRESS5", 0xBC, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 5, written"},
    {"S2MM_START_ADDRESS6", 0xC0, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 6, written"},
    {"S2MM_START_ADDRESS7", 0xC4, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 7, written"},
    {"S2MM_START_ADDRESS8", 0xC8, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 8, written"},
    {"S2MM_START_ADDRESS9", 0xCC, 0, vp::Access::read_write, 0xFFFFFFFF, "Frame store 9, written"},
    {"S2MM_START_ADDRESS10", 0xD0, 0, vp::Access::read_write, 0xFFFFFFFF,
     "Frame store 10, written"},
    {"S2MM_START_ADDRESS11", 0xD4, 0, vp::Access::read_write, 0xFFFFFFFF,
     "Frame store 11, written"},
    {"S2MM_START_ADDRESS12", 0xD8, 0, vp::Access::read_write, 0xFFFFFFFF,
     "Frame store 12, written"},
    {"S2MM_START_ADDRESS13", 0xDC, 0, vp::Access::read_write, 0xFFFFFFFF,
     "Frame store 13, written"},
    {"S2MM_START_ADDRESS14", 0xE0, 0, vp::Access::read_write, 0xFFFFFFFF,
     "Frame store 14, written"},
    {"S2MM_START_ADDRESS15", 0xE4, 0, vp::Access::read_write, 0xFFFFFFFF,
     "Frame store 15, written"},
    {"S2MM_START_ADDRESS16", 0xE8, 0, vp::Access::read_write, 0xFFFFFFFF,
     "Frame store 16, written"},
};

}  // namespace axi_vdma
