#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// AXI4-Stream FIFO v4.2 (PG080) with AXI4-Lite data, store and forward.
namespace axi_fifo_mm_s {

constexpr std::uint32_t ISR = 0x00;
constexpr std::uint32_t IER = 0x04;
constexpr std::uint32_t TDFR = 0x08;
constexpr std::uint32_t TDFV = 0x0C;
constexpr std::uint32_t TDFD = 0x10;
constexpr std::uint32_t TLR = 0x14;
constexpr std::uint32_t RDFR = 0x18;
constexpr std::uint32_t RDFO = 0x1C;
constexpr std::uint32_t RDFD = 0x20;
constexpr std::uint32_t RLR = 0x24;
constexpr std::uint32_t SRR = 0x28;
constexpr std::uint32_t TDR = 0x2C;
constexpr std::uint32_t RDR = 0x30;
constexpr unsigned address_bits = 7;
constexpr std::uint32_t reset_key = 0xA5;

/// Bits of ISR and IER.
namespace event {
constexpr std::uint32_t RPURE = 1u << 31;
constexpr std::uint32_t RPORE = 1u << 30;
constexpr std::uint32_t RPUE = 1u << 29;
constexpr std::uint32_t TPOE = 1u << 28;
constexpr std::uint32_t TC = 1u << 27;
constexpr std::uint32_t RC = 1u << 26;
constexpr std::uint32_t TSE = 1u << 25;
constexpr std::uint32_t TRC = 1u << 24;
constexpr std::uint32_t RRC = 1u << 23;
constexpr std::uint32_t all = 0xFFF80000;
}  // namespace event

inline constexpr vp::RegisterInfo registers[] = {
    {"ISR", ISR, 0x01800000, vp::Access::write_1_to_clear, event::all, "Events"},
    {"IER", IER, 0, vp::Access::read_write, event::all, "Events that interrupt"},
    {"TDFR", TDFR, 0, vp::Access::write_only, 0xFF, "0xA5 resets the send FIFO"},
    {"TDFV", TDFV, 0x000001FC, vp::Access::read_only, 0, "Free words of the send FIFO"},
    {"TDFD", TDFD, 0, vp::Access::write_only, 0xFFFFFFFF, "Words to send"},
    {"TLR", TLR, 0, vp::Access::write_only, 0x007FFFFF, "Bytes of the packet; a write sends it"},
    {"RDFR", RDFR, 0, vp::Access::write_only, 0xFF, "0xA5 resets the receive FIFO"},
    {"RDFO", RDFO, 0, vp::Access::read_only, 0, "Received words, of whole packets"},
    {"RDFD", RDFD, 0, vp::Access::read_only, 0, "Received words"},
    {"RLR", RLR, 0, vp::Access::read_only, 0, "Bytes of the next packet"},
    {"SRR", SRR, 0, vp::Access::write_only, 0xFF, "0xA5 resets both streams"},
    {"TDR", TDR, 0, vp::Access::write_only, 0xF, "TDEST to send: stored"},
    {"RDR", RDR, 0, vp::Access::read_only, 0, "Received TDEST"},
};

}  // namespace axi_fifo_mm_s
