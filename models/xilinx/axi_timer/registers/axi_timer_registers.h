#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// AXI timer v2.0 (PG079): two counters of 32 bits.
namespace axi_timer {

constexpr std::uint32_t TCSR0 = 0x00;
constexpr std::uint32_t TLR0 = 0x04;
constexpr std::uint32_t TCR0 = 0x08;
constexpr std::uint32_t TCSR1 = 0x10;
constexpr std::uint32_t TLR1 = 0x14;
constexpr std::uint32_t TCR1 = 0x18;
constexpr std::uint32_t timer_stride = 0x10;
constexpr unsigned address_bits = 5;

/// Bits of TCSR0 and TCSR1.
namespace tcsr {
constexpr std::uint32_t MDT = 1u << 0;
constexpr std::uint32_t UDT = 1u << 1;
constexpr std::uint32_t GENT = 1u << 2;
constexpr std::uint32_t CAPT = 1u << 3;
constexpr std::uint32_t ARHT = 1u << 4;
constexpr std::uint32_t LOAD = 1u << 5;
constexpr std::uint32_t ENIT = 1u << 6;
constexpr std::uint32_t ENT = 1u << 7;
constexpr std::uint32_t TINT = 1u << 8;
constexpr std::uint32_t PWMA = 1u << 9;
constexpr std::uint32_t ENALL = 1u << 10;
constexpr std::uint32_t CASC = 1u << 11;
}  // namespace tcsr

inline constexpr vp::RegisterField tcsr_fields[] = {
    {"MDT", tcsr::MDT, vp::Access::read_write, "1: capture, 0: generate"},
    {"UDT", tcsr::UDT, vp::Access::read_write, "1: counts down"},
    {"GENT", tcsr::GENT, vp::Access::read_write, "1: generateout is driven"},
    {"CAPT", tcsr::CAPT, vp::Access::read_write, "1: capturetrig is looked at"},
    {"ARHT", tcsr::ARHT, vp::Access::read_write, "1: reloads, or captures again"},
    {"LOAD", tcsr::LOAD, vp::Access::read_write, "1: the counter has the load value"},
    {"ENIT", tcsr::ENIT, vp::Access::read_write, "1: TINT interrupts"},
    {"ENT", tcsr::ENT, vp::Access::read_write, "1: counts"},
    {"TINT", tcsr::TINT, vp::Access::write_1_to_clear, "the event came"},
    {"PWMA", tcsr::PWMA, vp::Access::read_write, "1 in both: pulse width modulation"},
    {"ENALL", tcsr::ENALL, vp::Access::read_write, "1 starts both timers"},
    {"CASC", tcsr::CASC, vp::Access::read_write, "1 in timer 0: both are one of 64 bits"},
};

inline constexpr vp::RegisterInfo registers[] = {
    {"TCSR0", TCSR0, 0, vp::Access::read_write, 0x00000FFF, "Timer 0: control and status",
     tcsr_fields},
    {"TLR0", TLR0, 0, vp::Access::read_write, 0xFFFFFFFF, "Timer 0: load value, or capture"},
    {"TCR0", TCR0, 0, vp::Access::read_only, 0, "Timer 0: counter"},
    {"TCSR1", TCSR1, 0, vp::Access::read_write, 0x000007FF, "Timer 1: control and status",
     tcsr_fields},
    {"TLR1", TLR1, 0, vp::Access::read_write, 0xFFFFFFFF, "Timer 1: load value, or capture"},
    {"TCR1", TCR1, 0, vp::Access::read_only, 0, "Timer 1: counter"},
};

}  // namespace axi_timer
