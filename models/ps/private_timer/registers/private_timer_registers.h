#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// Private timer and watchdog of a Cortex-A9 (Cortex-A9 MPCore TRM 4.2; UG585 8.2 and appendix
/// B.24): two 32-bit counters that count down at half the CPU's frequency.
namespace private_timer {

/// Bus address on the Zynq-7000.
constexpr std::uint32_t base = 0xF8F00600;

/// CPU cycles per count, before the prescaler.
constexpr std::uint32_t cpu_cycles_per_tick = 2;

constexpr std::uint32_t LOAD = 0x00;
constexpr std::uint32_t COUNTER = 0x04;
constexpr std::uint32_t CONTROL = 0x08;
constexpr std::uint32_t INTERRUPT_STATUS = 0x0C;
constexpr std::uint32_t WDT_LOAD = 0x20;
constexpr std::uint32_t WDT_COUNTER = 0x24;
constexpr std::uint32_t WDT_CONTROL = 0x28;
constexpr std::uint32_t WDT_INTERRUPT_STATUS = 0x2C;
constexpr std::uint32_t WDT_RESET_STATUS = 0x30;
constexpr std::uint32_t WDT_DISABLE = 0x34;

/// Bits of CONTROL and WDT_CONTROL.
namespace control {
constexpr std::uint32_t Enable = 1u << 0;       ///< the counter runs
constexpr std::uint32_t Auto_Reload = 1u << 1;  ///< at 0 it starts again from LOAD
constexpr std::uint32_t IRQ_Enable = 1u << 2;   ///< the event raises interrupt 29 (30)
constexpr std::uint32_t Watchdog_Mode =
    1u << 3;  ///< WDT_CONTROL only: at 0 the CPU is reset; only WDT_DISABLE clears it
constexpr unsigned Prescaler_shift = 8;
constexpr std::uint32_t Prescaler = 0xFFu
                                    << Prescaler_shift;  ///< a count every Prescaler + 1 ticks
}  // namespace control

/// Bits of INTERRUPT_STATUS and WDT_INTERRUPT_STATUS.
namespace status {
constexpr std::uint32_t Event_Flag = 1u << 0;  ///< the counter reached 0; writing 1 clears
}

/// Bits of WDT_RESET_STATUS.
namespace reset_status {
constexpr std::uint32_t Reset_Flag = 1u << 0;  ///< the watchdog expired; writing 1 clears
}

/// Written to WDT_DISABLE one after the other, they take the watchdog out of watchdog mode.
constexpr std::uint32_t disable_key_1 = 0x12345678;
constexpr std::uint32_t disable_key_2 = 0x87654321;

inline constexpr vp::RegisterField control_fields[] = {
    {"Enable", control::Enable, vp::Access::read_write, "1: the counter runs"},
    {"Auto_Reload", control::Auto_Reload, vp::Access::read_write,
     "1: at 0 it starts again from LOAD"},
    {"IRQ_Enable", control::IRQ_Enable, vp::Access::read_write, "1: the event raises interrupt 29"},
    {"Prescaler", control::Prescaler, vp::Access::read_write, "a count every Prescaler + 1 ticks"},
};
inline constexpr vp::RegisterField wdt_control_fields[] = {
    {"Enable", control::Enable, vp::Access::read_write, "1: the counter runs"},
    {"Auto_Reload", control::Auto_Reload, vp::Access::read_write,
     "1: at 0 it starts again from WDT_LOAD (timer mode)"},
    {"IRQ_Enable", control::IRQ_Enable, vp::Access::read_write,
     "1: the event raises interrupt 30 (timer mode)"},
    {"Watchdog_Mode", control::Watchdog_Mode, vp::Access::read_write,
     "1: at 0 the CPU is reset; writing 0 does not clear it, WDT_DISABLE does"},
    {"Prescaler", control::Prescaler, vp::Access::read_write, "a count every Prescaler + 1 ticks"},
};
inline constexpr vp::RegisterField status_fields[] = {
    {"Event_Flag", status::Event_Flag, vp::Access::write_1_to_clear, "the counter reached 0"},
};
inline constexpr vp::RegisterField reset_status_fields[] = {
    {"Reset_Flag", reset_status::Reset_Flag, vp::Access::write_1_to_clear, "the watchdog expired"},
};

inline constexpr vp::RegisterInfo registers[] = {
    {"LOAD", LOAD, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
     "Start value; writing it sets the counter, too"},
    {"COUNTER", COUNTER, 0x00000000, vp::Access::read_write, 0xFFFFFFFF, "Counts down to 0"},
    {"CONTROL", CONTROL, 0x00000000, vp::Access::read_write, 0x0000FF07,
     "Enable, auto-reload, interrupt enable and prescaler", control_fields},
    {"INTERRUPT_STATUS", INTERRUPT_STATUS, 0x00000000, vp::Access::write_1_to_clear, 0x00000001,
     "Event flag: the counter reached 0", status_fields},
    {"WDT_LOAD", WDT_LOAD, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
     "Watchdog: start value; writing it sets the counter, too"},
    {"WDT_COUNTER", WDT_COUNTER, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
     "Watchdog: counts down to 0; read only in watchdog mode"},
    {"WDT_CONTROL", WDT_CONTROL, 0x00000000, vp::Access::read_write, 0x0000FF0F,
     "Watchdog: enable, auto-reload, interrupt enable, mode and prescaler", wdt_control_fields},
    {"WDT_INTERRUPT_STATUS", WDT_INTERRUPT_STATUS, 0x00000000, vp::Access::write_1_to_clear,
     0x00000001, "Watchdog in timer mode: event flag", status_fields},
    {"WDT_RESET_STATUS", WDT_RESET_STATUS, 0x00000000, vp::Access::write_1_to_clear, 0x00000001,
     "Watchdog in watchdog mode: it reached 0", reset_status_fields},
    {"WDT_DISABLE", WDT_DISABLE, 0x00000000, vp::Access::write_only, 0xFFFFFFFF,
     "Writing 0x12345678 and then 0x87654321 leaves watchdog mode"},
};

}  // namespace private_timer
