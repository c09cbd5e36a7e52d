#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// The global timer of the Cortex-A9 MPCore: a 64-bit counter with a comparator, clocked at half
/// the CPU's frequency (UG585 8.3 and appendix B.24).
namespace global_timer {

/// Bus address on the Zynq-7000.
constexpr std::uint32_t base = 0xF8F00200;

/// CPU cycles per tick of the counter, before the prescaler.
constexpr std::uint32_t cpu_cycles_per_tick = 2;

constexpr std::uint32_t COUNTER_LOW = 0x00;
constexpr std::uint32_t COUNTER_HIGH = 0x04;
constexpr std::uint32_t CONTROL = 0x08;
constexpr std::uint32_t INTERRUPT_STATUS = 0x0C;
constexpr std::uint32_t COMPARATOR_LOW = 0x10;
constexpr std::uint32_t COMPARATOR_HIGH = 0x14;
constexpr std::uint32_t AUTO_INCREMENT = 0x18;

/// Bits of CONTROL.
namespace control {
constexpr std::uint32_t Timer_Enable = 1u << 0;  ///< the counter runs; shared by both CPUs
constexpr std::uint32_t Comp_Enable = 1u << 1;   ///< the comparator raises events
constexpr std::uint32_t IRQ_Enable = 1u << 2;    ///< events raise interrupt 27
constexpr std::uint32_t Auto_Increment =
    1u << 3;  ///< an event moves the comparator on by AUTO_INCREMENT
constexpr unsigned Prescaler_shift = 8;
constexpr std::uint32_t Prescaler = 0xFFu
                                    << Prescaler_shift;  ///< one count every Prescaler + 1 ticks
}  // namespace control

/// Bits of INTERRUPT_STATUS.
namespace status {
constexpr std::uint32_t Event_Flag =
    1u << 0;  ///< the counter reached the comparator; writing 1 clears
}

inline constexpr vp::RegisterField control_fields[] = {
    {"Timer_Enable", control::Timer_Enable, vp::Access::read_write,
     "1: the counter runs; shared by both CPUs"},
    {"Comp_Enable", control::Comp_Enable, vp::Access::read_write, "1: the comparator compares"},
    {"IRQ_Enable", control::IRQ_Enable, vp::Access::read_write, "1: events raise interrupt 27"},
    {"Auto_Increment", control::Auto_Increment, vp::Access::read_write,
     "1: an event moves the comparator on by AUTO_INCREMENT"},
    {"Prescaler", control::Prescaler, vp::Access::read_write, "a count every Prescaler + 1 ticks"},
};
inline constexpr vp::RegisterField status_fields[] = {
    {"Event_Flag", status::Event_Flag, vp::Access::write_1_to_clear,
     "the counter reached the comparator"},
};

/// The boot code leaves the counter running: CONTROL reads 1 then, and the counter has moved.
inline constexpr vp::RegisterInfo registers[] = {
    {"COUNTER_LOW", COUNTER_LOW, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
     "Counter, lower half; write it with the timer disabled"},
    {"COUNTER_HIGH", COUNTER_HIGH, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
     "Counter, upper half; read high, low, high until both highs agree"},
    {"CONTROL", CONTROL, 0x00000000, vp::Access::read_write, 0x0000FF0F,
     "Enables, auto-increment and prescaler", control_fields},
    {"INTERRUPT_STATUS", INTERRUPT_STATUS, 0x00000000, vp::Access::write_1_to_clear, 0x00000001,
     "Event flag of the comparator", status_fields},
    {"COMPARATOR_LOW", COMPARATOR_LOW, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
     "Comparator, lower half; write it with the comparator disabled"},
    {"COMPARATOR_HIGH", COMPARATOR_HIGH, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
     "Comparator, upper half"},
    {"AUTO_INCREMENT", AUTO_INCREMENT, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
     "Added to the comparator at each event"},
};

}  // namespace global_timer
