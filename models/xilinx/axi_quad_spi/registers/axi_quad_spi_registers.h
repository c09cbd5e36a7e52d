#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// AXI Quad SPI v3.2 (PG153) in standard mode, AXI4-Lite.
namespace axi_quad_spi {

constexpr std::uint32_t DGIER = 0x1C;
constexpr std::uint32_t IPISR = 0x20;
constexpr std::uint32_t IPIER = 0x28;
constexpr std::uint32_t SRR = 0x40;
constexpr std::uint32_t SPICR = 0x60;
constexpr std::uint32_t SPISR = 0x64;
constexpr std::uint32_t SPI_DTR = 0x68;
constexpr std::uint32_t SPI_DRR = 0x6C;
constexpr std::uint32_t SPISSR = 0x70;
constexpr std::uint32_t TX_OCY = 0x74;
constexpr std::uint32_t RX_OCY = 0x78;
constexpr unsigned address_bits = 7;
constexpr std::uint32_t reset_key = 0xA;
constexpr std::uint32_t dgier_GIE = 1u << 31;

/// Bits of SPICR.
namespace spicr {
constexpr std::uint32_t LOOP = 1u << 0;
constexpr std::uint32_t SPE = 1u << 1;
constexpr std::uint32_t Master = 1u << 2;
constexpr std::uint32_t TX_Reset = 1u << 5;
constexpr std::uint32_t RX_Reset = 1u << 6;
constexpr std::uint32_t Manual_SS = 1u << 7;
constexpr std::uint32_t Inhibit = 1u << 8;
constexpr std::uint32_t LSB_First = 1u << 9;
}  // namespace spicr

/// Bits of SPISR.
namespace spisr {
constexpr std::uint32_t RX_Empty = 1u << 0;
constexpr std::uint32_t RX_Full = 1u << 1;
constexpr std::uint32_t TX_Empty = 1u << 2;
constexpr std::uint32_t TX_Full = 1u << 3;
constexpr std::uint32_t Slave_Mode_Select = 1u << 5;
}  // namespace spisr

/// Bits of IPISR and IPIER.
namespace event {
constexpr std::uint32_t MODF = 1u << 0;
constexpr std::uint32_t DTR_Empty = 1u << 2;
constexpr std::uint32_t DRR_Full = 1u << 4;
constexpr std::uint32_t DRR_Overrun = 1u << 5;
constexpr std::uint32_t TX_Half_Empty = 1u << 6;
constexpr std::uint32_t DRR_Not_Empty = 1u << 8;
constexpr std::uint32_t all = 0x1FF;
}  // namespace event

inline constexpr vp::RegisterInfo registers[] = {
    {"DGIER", DGIER, 0, vp::Access::read_write, dgier_GIE, "Global interrupt enable"},
    {"IPISR", IPISR, 0, vp::Access::write_1_to_toggle, event::all, "Events"},
    {"IPIER", IPIER, 0, vp::Access::read_write, event::all, "Events that interrupt"},
    {"SRR", SRR, 0, vp::Access::write_only, 0xF, "0xA resets the core"},
    {"SPICR", SPICR, 0x00000180, vp::Access::read_write, 0x3FF, "Control"},
    {"SPISR", SPISR, 0x00000025, vp::Access::read_only, 0, "State of the FIFOs"},
    {"SPI_DTR", SPI_DTR, 0, vp::Access::write_only, 0xFFFFFFFF, "Send FIFO"},
    {"SPI_DRR", SPI_DRR, 0, vp::Access::read_only, 0, "Receive FIFO"},
    {"SPISSR", SPISSR, 0xFFFFFFFF, vp::Access::read_write, 0xFFFFFFFF, "0 selects a slave"},
    {"TX_OCY", TX_OCY, 0, vp::Access::read_only, 0, "Words to send, less one"},
    {"RX_OCY", RX_OCY, 0, vp::Access::read_only, 0, "Received words, less one"},
};

}  // namespace axi_quad_spi
