#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// AXI IIC v2.1 (PG090).
namespace axi_iic {

constexpr std::uint32_t GIE = 0x01C;
constexpr std::uint32_t ISR = 0x020;
constexpr std::uint32_t IER = 0x028;
constexpr std::uint32_t SOFTR = 0x040;
constexpr std::uint32_t CR = 0x100;
constexpr std::uint32_t SR = 0x104;
constexpr std::uint32_t TX_FIFO = 0x108;
constexpr std::uint32_t RX_FIFO = 0x10C;
constexpr std::uint32_t ADR = 0x110;
constexpr std::uint32_t TX_FIFO_OCY = 0x114;
constexpr std::uint32_t RX_FIFO_OCY = 0x118;
constexpr std::uint32_t TEN_ADR = 0x11C;
constexpr std::uint32_t RX_FIFO_PIRQ = 0x120;
constexpr std::uint32_t GPO = 0x124;
constexpr unsigned address_bits = 9;
constexpr unsigned fifo_depth = 16;
constexpr std::uint32_t reset_key = 0xA;

/// Bits of CR.
namespace cr {
constexpr std::uint32_t EN = 1u << 0;
constexpr std::uint32_t TX_FIFO_Reset = 1u << 1;
constexpr std::uint32_t MSMS = 1u << 2;
constexpr std::uint32_t TX = 1u << 3;
constexpr std::uint32_t TXAK = 1u << 4;
constexpr std::uint32_t RSTA = 1u << 5;
constexpr std::uint32_t GC_EN = 1u << 6;
}  // namespace cr

/// Bits of SR.
namespace sr {
constexpr std::uint32_t BB = 1u << 2;
constexpr std::uint32_t TX_FIFO_Full = 1u << 4;
constexpr std::uint32_t RX_FIFO_Full = 1u << 5;
constexpr std::uint32_t RX_FIFO_Empty = 1u << 6;
constexpr std::uint32_t TX_FIFO_Empty = 1u << 7;
}  // namespace sr

/// Bits of ISR and IER.
namespace event {
constexpr std::uint32_t arbitration = 1u << 0;
constexpr std::uint32_t tx_error = 1u << 1;
constexpr std::uint32_t tx_empty = 1u << 2;
constexpr std::uint32_t rx_full = 1u << 3;
constexpr std::uint32_t not_busy = 1u << 4;
constexpr std::uint32_t addressed = 1u << 5;
constexpr std::uint32_t not_addressed = 1u << 6;
constexpr std::uint32_t tx_half_empty = 1u << 7;
constexpr std::uint32_t all = 0xFF;
}  // namespace event

/// Bits of a word written to TX_FIFO.
namespace tx_word {
constexpr std::uint32_t Start = 1u << 8;
constexpr std::uint32_t Stop = 1u << 9;
}  // namespace tx_word

constexpr std::uint32_t gie_Enable = 1u << 31;

inline constexpr vp::RegisterInfo registers[] = {
    {"GIE", GIE, 0, vp::Access::read_write, gie_Enable, "Global interrupt enable"},
    {"ISR", ISR, 0x000000D0, vp::Access::write_1_to_toggle, event::all,
     "Events, which come back while their cause lasts"},
    {"IER", IER, 0, vp::Access::read_write, event::all, "Events that interrupt"},
    {"SOFTR", SOFTR, 0, vp::Access::write_only, 0xF, "0xA resets the core"},
    {"CR", CR, 0, vp::Access::read_write, 0x7F, "Control"},
    {"SR", SR, 0x000000C0, vp::Access::read_only, 0, "State of bus and FIFOs"},
    {"TX_FIFO", TX_FIFO, 0, vp::Access::write_only, 0x3FF,
     "Bytes to send; bits 9:8 are stop and start of the dynamic mode"},
    {"RX_FIFO", RX_FIFO, 0, vp::Access::read_only, 0, "Received bytes"},
    {"ADR", ADR, 0, vp::Access::read_write, 0xFE, "Own address as a slave"},
    {"TX_FIFO_OCY", TX_FIFO_OCY, 0, vp::Access::read_only, 0, "Bytes to send, less one"},
    {"RX_FIFO_OCY", RX_FIFO_OCY, 0, vp::Access::read_only, 0, "Received bytes, less one"},
    {"TEN_ADR", TEN_ADR, 0, vp::Access::read_write, 0x7, "Own address, upper bits"},
    {"RX_FIFO_PIRQ", RX_FIFO_PIRQ, 0, vp::Access::read_write, 0xF,
     "Received bytes, less one, that throttle the bus"},
    {"GPO", GPO, 0, vp::Access::read_write, 0xFF, "General purpose outputs"},
    {"TSUSTA", 0x128, 0, vp::Access::read_write, 0xFFFFFFFF, "Setup time of a repeated start"},
    {"TSUSTO", 0x12C, 0, vp::Access::read_write, 0xFFFFFFFF, "Setup time of a stop"},
    {"THDSTA", 0x130, 0, vp::Access::read_write, 0xFFFFFFFF, "Hold time of a start"},
    {"TSUDAT", 0x134, 0, vp::Access::read_write, 0xFFFFFFFF, "Setup time of data"},
    {"TBUF", 0x138, 0, vp::Access::read_write, 0xFFFFFFFF, "Free time between stop and start"},
    {"THIGH", 0x13C, 0, vp::Access::read_write, 0xFFFFFFFF, "High time of SCL"},
    {"TLOW", 0x140, 0, vp::Access::read_write, 0xFFFFFFFF, "Low time of SCL"},
    {"THDDAT", 0x144, 0, vp::Access::read_write, 0xFFFFFFFF, "Hold time of data"},
};

}  // namespace axi_iic
