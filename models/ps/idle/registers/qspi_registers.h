#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// Quad-SPI controller of the Zynq-7000 (UG585 chapter 12 and appendix B.26).
namespace qspi {

constexpr std::uint32_t base = 0xE000D000;
constexpr std::uint32_t interrupt_id = 51;
constexpr unsigned fifo_words = 63;

constexpr std::uint32_t CONFIG = 0x00;
constexpr std::uint32_t INTR_STATUS = 0x04;
constexpr std::uint32_t INTR_EN = 0x08;
constexpr std::uint32_t INTR_DIS = 0x0C;
constexpr std::uint32_t INTR_MASK = 0x10;
constexpr std::uint32_t EN = 0x14;
constexpr std::uint32_t TXD0 = 0x1C;
constexpr std::uint32_t RX_DATA = 0x20;
constexpr std::uint32_t TX_THRES = 0x28;
constexpr std::uint32_t RX_THRES = 0x2C;
constexpr std::uint32_t TXD1 = 0x80;
constexpr std::uint32_t TXD2 = 0x84;
constexpr std::uint32_t TXD3 = 0x88;

/// Bits of CONFIG.
namespace config {
constexpr std::uint32_t PCS = 1u << 10;  ///< 0: the flash is selected
constexpr std::uint32_t Manual_CS = 1u << 14;
constexpr std::uint32_t Man_start_en = 1u << 15;
constexpr std::uint32_t Man_start_com = 1u << 16;
}  // namespace config

/// Bits of INTR_STATUS.
namespace event {
constexpr std::uint32_t RX_OVERFLOW = 1u << 0;
constexpr std::uint32_t TX_FIFO_not_full = 1u << 2;
constexpr std::uint32_t TX_FIFO_full = 1u << 3;
constexpr std::uint32_t RX_FIFO_not_empty = 1u << 4;
constexpr std::uint32_t RX_FIFO_full = 1u << 5;
constexpr std::uint32_t TX_FIFO_underflow = 1u << 6;
constexpr std::uint32_t all = 0x7F;
constexpr std::uint32_t cleared_by_writing = RX_OVERFLOW | TX_FIFO_underflow;
}  // namespace event

inline constexpr vp::RegisterField intr_status_fields[] = {
    {"RX_OVERFLOW", event::RX_OVERFLOW, vp::Access::write_1_to_clear, "a word met a full FIFO"},
    {"TX_FIFO_not_full", event::TX_FIFO_not_full, vp::Access::read_only,
     "fewer words to send than TX_THRES"},
    {"TX_FIFO_full", event::TX_FIFO_full, vp::Access::read_only, "the send FIFO is full"},
    {"RX_FIFO_not_empty", event::RX_FIFO_not_empty, vp::Access::read_only,
     "RX_THRES words have come"},
    {"RX_FIFO_full", event::RX_FIFO_full, vp::Access::read_only, "the receive FIFO is full"},
    {"TX_FIFO_underflow", event::TX_FIFO_underflow, vp::Access::write_1_to_clear,
     "the send FIFO ran empty"},
};

inline constexpr vp::RegisterInfo registers[] = {
    {"CONFIG", CONFIG, 0x80020000, vp::Access::read_write, 0xFFFFFFFF, "Configuration"},
    {"INTR_STATUS", INTR_STATUS, 0x00000004, vp::Access::write_1_to_clear,
     event::cleared_by_writing, "Events and state of the FIFOs", intr_status_fields},
    {"INTR_EN", INTR_EN, 0, vp::Access::write_only, event::all, "1 enables an interrupt"},
    {"INTR_DIS", INTR_DIS, 0, vp::Access::write_only, event::all, "1 disables an interrupt"},
    {"INTR_MASK", INTR_MASK, 0, vp::Access::read_only, 0, "1 where an interrupt is enabled"},
    {"EN", EN, 0, vp::Access::read_write, 0x1, "1: the controller works"},
    {"DELAY", 0x18, 0, vp::Access::read_write, 0xFFFFFFFF, "Delays"},
    {"TXD0", TXD0, 0, vp::Access::write_only, 0xFFFFFFFF, "Four bytes to send, the lowest first"},
    {"RX_DATA", RX_DATA, 0, vp::Access::read_only, 0, "Received word"},
    {"SLAVE_IDLE", 0x24, 0xFF, vp::Access::read_write, 0xFF, "Clocks of a pause"},
    {"TX_THRES", TX_THRES, 1, vp::Access::read_write, 0xFFFFFFFF, "Level of the send FIFO"},
    {"RX_THRES", RX_THRES, 1, vp::Access::read_write, 0xFFFFFFFF, "Level of the receive FIFO"},
    {"GPIO", 0x30, 1, vp::Access::read_write, 0x1, "Write protection"},
    {"LPBK_DLY", 0x38, 0x33, vp::Access::read_write, 0x3F, "Delay of the looped-back clock"},
    {"TXD1", TXD1, 0, vp::Access::write_only, 0xFFFFFFFF, "One byte to send"},
    {"TXD2", TXD2, 0, vp::Access::write_only, 0xFFFFFFFF, "Two bytes to send"},
    {"TXD3", TXD3, 0, vp::Access::write_only, 0xFFFFFFFF, "Three bytes to send"},
    {"LQSPI_CFG", 0xA0, 0x03A002EB, vp::Access::read_write, 0xFFFFFFFF, "Memory-mapped mode"},
    {"LQSPI_STS", 0xA4, 0, vp::Access::read_write, 0x1FF, "Its errors"},
    {"MOD_ID", 0xFC, 0x01090101, vp::Access::read_only, 0, "Number of the module"},
};

}  // namespace qspi
