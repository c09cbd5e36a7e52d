#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// AXI UART Lite v2.0 (PG142).
namespace axi_uartlite {

constexpr std::uint32_t RX_FIFO = 0x00;
constexpr std::uint32_t TX_FIFO = 0x04;
constexpr std::uint32_t STAT_REG = 0x08;
constexpr std::uint32_t CTRL_REG = 0x0C;
constexpr unsigned address_bits = 4;
constexpr unsigned fifo_depth = 16;

/// Bits of STAT_REG.
namespace stat {
constexpr std::uint32_t Rx_FIFO_Valid_Data = 1u << 0;
constexpr std::uint32_t Rx_FIFO_Full = 1u << 1;
constexpr std::uint32_t Tx_FIFO_Empty = 1u << 2;
constexpr std::uint32_t Tx_FIFO_Full = 1u << 3;
constexpr std::uint32_t Intr_Enabled = 1u << 4;
constexpr std::uint32_t Overrun_Error = 1u << 5;
}  // namespace stat

/// Bits of CTRL_REG.
namespace ctrl {
constexpr std::uint32_t Rst_Tx_FIFO = 1u << 0;
constexpr std::uint32_t Rst_Rx_FIFO = 1u << 1;
constexpr std::uint32_t Enable_Intr = 1u << 4;
}  // namespace ctrl

inline constexpr vp::RegisterInfo registers[] = {
    {"RX_FIFO", RX_FIFO, 0, vp::Access::read_only, 0, "Received bytes"},
    {"TX_FIFO", TX_FIFO, 0, vp::Access::write_only, 0xFF, "Bytes to send"},
    {"STAT_REG", STAT_REG, 0x00000004, vp::Access::read_only, 0,
     "State of the FIFOs; errors, which a read clears"},
    {"CTRL_REG", CTRL_REG, 0, vp::Access::write_only, 0x13, "Resets of FIFOs, interrupt enable"},
};

}  // namespace axi_uartlite
