#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// AXI interrupt controller v4.1 (PG099) with up to 32 inputs, without fast mode.
namespace axi_intc {

constexpr std::uint32_t ISR = 0x00;
constexpr std::uint32_t IPR = 0x04;
constexpr std::uint32_t IER = 0x08;
constexpr std::uint32_t IAR = 0x0C;
constexpr std::uint32_t SIE = 0x10;
constexpr std::uint32_t CIE = 0x14;
constexpr std::uint32_t IVR = 0x18;
constexpr std::uint32_t MER = 0x1C;
constexpr unsigned address_bits = 9;

/// Bits of MER.
namespace mer {
constexpr std::uint32_t ME = 1u << 0;
constexpr std::uint32_t HIE = 1u << 1;
}  // namespace mer

inline constexpr vp::RegisterField mer_fields[] = {
    {"ME", mer::ME, vp::Access::read_write, "1: irq is driven"},
    {"HIE", mer::HIE, vp::Access::write_1_to_set, "1: the inputs count; stays until a reset"},
};

inline constexpr vp::RegisterInfo registers[] = {
    {"ISR", ISR, 0, vp::Access::read_write, 0xFFFFFFFF,
     "What came; software may set it until MER.HIE"},
    {"IPR", IPR, 0, vp::Access::read_only, 0, "What came and is enabled"},
    {"IER", IER, 0, vp::Access::read_write, 0xFFFFFFFF, "1 enables an interrupt"},
    {"IAR", IAR, 0, vp::Access::write_only, 0xFFFFFFFF, "1 acknowledges an interrupt"},
    {"SIE", SIE, 0, vp::Access::write_only, 0xFFFFFFFF, "1 sets a bit of IER"},
    {"CIE", CIE, 0, vp::Access::write_only, 0xFFFFFFFF, "1 clears a bit of IER"},
    {"IVR", IVR, 0xFFFFFFFF, vp::Access::read_only, 0, "Lowest number in IPR; all ones if none"},
    {"MER", MER, 0, vp::Access::read_write, 0x3, "Master enable", mer_fields},
};

}  // namespace axi_intc
