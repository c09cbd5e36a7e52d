#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// System watchdog of the Zynq-7000's processing system (UG585 chapter 8 and appendix B.31).
namespace system_watchdog {

constexpr std::uint32_t base = 0xF8005000;
constexpr std::uint32_t interrupt_id = 41;

constexpr std::uint32_t MODE = 0x00;
constexpr std::uint32_t CONTROL = 0x04;
constexpr std::uint32_t RESTART = 0x08;
constexpr std::uint32_t STATUS = 0x0C;

/// Upper bits of a write to MODE, and to CONTROL; the word of RESTART.
constexpr std::uint32_t mode_key = 0xABC, control_key = 0x248, restart_key = 0x1999;
constexpr unsigned mode_key_shift = 12, control_key_shift = 14;

/// Bits of MODE.
namespace mode {
constexpr std::uint32_t WDEN = 1u << 0;
constexpr std::uint32_t RSTEN = 1u << 1;
constexpr std::uint32_t IRQEN = 1u << 2;
constexpr std::uint32_t RSTLN = 7u << 4;
constexpr unsigned IRQLN_shift = 7;
constexpr std::uint32_t IRQLN = 3u << IRQLN_shift;
}  // namespace mode

/// Bits of CONTROL.
namespace control {
constexpr std::uint32_t CLKSEL = 3u << 0;
constexpr unsigned CRV_shift = 2;
constexpr std::uint32_t CRV = 0xFFFu << CRV_shift;
}  // namespace control

/// Bits of STATUS.
namespace status {
constexpr std::uint32_t WDZ = 1u << 0;
}

/// Cycles of CPU_1x per count, by CLKSEL.
constexpr std::uint64_t prescaler[] = {8, 64, 512, 4096};
/// Counts of the reload value below CRV.
constexpr std::uint64_t low_counts = 0xFFF;

inline constexpr vp::RegisterField mode_fields[] = {
    {"WDEN", mode::WDEN, vp::Access::read_write, "1: the watchdog counts"},
    {"RSTEN", mode::RSTEN, vp::Access::read_write, "1: at 0 the system is reset"},
    {"IRQEN", mode::IRQEN, vp::Access::read_write, "1: at 0 a pulse on interrupt 41"},
    {"RSTLN", mode::RSTLN, vp::Access::read_write, "length of the reset"},
    {"IRQLN", mode::IRQLN, vp::Access::read_write, "length of the pulse: 4, 8, 16, 32 clocks"},
};
inline constexpr vp::RegisterField control_fields[] = {
    {"CLKSEL", control::CLKSEL, vp::Access::read_write, "clocks a count: 8, 64, 512, 4096"},
    {"CRV", control::CRV, vp::Access::read_write, "upper 12 bits of the value it counts from"},
};
inline constexpr vp::RegisterField status_fields[] = {
    {"WDZ", status::WDZ, vp::Access::read_only, "the counter reached 0"},
};

inline constexpr vp::RegisterInfo registers[] = {
    {"MODE", MODE, 0x000001C0, vp::Access::read_write, 0x000001F7,
     "Mode; a write needs 0xABC in bits 23:12", mode_fields},
    {"CONTROL", CONTROL, 0x00003FFC, vp::Access::read_write, 0x00003FFF,
     "Counter; a write needs 0x248 in bits 25:14", control_fields},
    {"RESTART", RESTART, 0, vp::Access::write_only, 0x0000FFFF, "0x1999 starts the counter again"},
    {"STATUS", STATUS, 0, vp::Access::read_only, 0, "Whether it expired", status_fields},
};

}  // namespace system_watchdog
