#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// The processing system's way to the XADC (UG585 chapter 30 and appendix B.16): commands go into
/// one FIFO, answers come from another.
namespace ps_xadc {

constexpr std::uint32_t base = 0xF8007100;
constexpr std::uint32_t interrupt_id = 39;
constexpr unsigned fifo_depth = 15;

constexpr std::uint32_t CFG = 0x00;
constexpr std::uint32_t INT_STS = 0x04;
constexpr std::uint32_t INT_MASK = 0x08;
constexpr std::uint32_t MSTS = 0x0C;
constexpr std::uint32_t CMDFIFO = 0x10;
constexpr std::uint32_t RDFIFO = 0x14;
constexpr std::uint32_t MCTL = 0x18;
constexpr std::uint32_t UNLOCK = 0x34;

/// Bits of CFG.
namespace cfg {
constexpr std::uint32_t ENABLE = 1u << 31;
constexpr unsigned CFIFOTH_shift = 20, DFIFOTH_shift = 16;
constexpr std::uint32_t CFIFOTH = 0xFu << CFIFOTH_shift;
constexpr std::uint32_t DFIFOTH = 0xFu << DFIFOTH_shift;
}  // namespace cfg

/// Bits of INT_STS and INT_MASK; 7:0 are the alarms.
namespace event {
constexpr std::uint32_t DFIFO_GTH = 1u << 8;
constexpr std::uint32_t CFIFO_LTH = 1u << 9;
constexpr std::uint32_t alarms = 0xFF;
constexpr std::uint32_t all = 0x3FF;
}  // namespace event

/// Bits of MSTS; 7:0 are the alarms.
namespace msts {
constexpr std::uint32_t DFIFOE = 1u << 8;
constexpr std::uint32_t DFIFOF = 1u << 9;
constexpr std::uint32_t CFIFOE = 1u << 10;
constexpr unsigned DFIFO_LVL_shift = 12;
}  // namespace msts

constexpr std::uint32_t mctl_RESET = 1u << 4;

/// A command: what to do, the register, and the word to write.
namespace command {
constexpr unsigned CMD_shift = 26, ADDR_shift = 16;
constexpr std::uint32_t read = 1, write = 2;
}  // namespace command

inline constexpr vp::RegisterField cfg_fields[] = {
    {"IGAP", 0x1F, vp::Access::read_write, "pause between commands: stored"},
    {"TCKRATE", 0x300, vp::Access::read_write, "clock of the serial port: stored"},
    {"REDGE", 1u << 12, vp::Access::read_write, "edge of answers: stored"},
    {"WEDGE", 1u << 13, vp::Access::read_write, "edge of commands: stored"},
    {"DFIFOTH", cfg::DFIFOTH, vp::Access::read_write, "level of the answers' FIFO"},
    {"CFIFOTH", cfg::CFIFOTH, vp::Access::read_write, "level of the commands' FIFO"},
    {"ENABLE", cfg::ENABLE, vp::Access::read_write, "1: the processing system has the XADC"},
};
inline constexpr vp::RegisterField mctl_fields[] = {
    {"FLUSH", 1u << 0, vp::Access::read_write, "stored"},
    {"RESET", 1u << 4, vp::Access::read_write, "1 holds the XADC in reset"},
};

inline constexpr vp::RegisterInfo registers[] = {
    {"CFG", CFG, 0x00001114, vp::Access::read_write, 0x80FF331F, "Enable, levels, timing",
     cfg_fields},
    {"INT_STS", INT_STS, 0x00000200, vp::Access::write_1_to_clear, event::all,
     "Events: alarms, levels of the FIFOs"},
    {"INT_MASK", INT_MASK, 0xFFFFFFFF, vp::Access::read_write, 0xFFFFFFFF, "1 masks an interrupt"},
    {"MSTS", MSTS, 0x00000500, vp::Access::read_only, 0, "Alarms and state of the FIFOs"},
    {"CMDFIFO", CMDFIFO, 0, vp::Access::write_only, 0xFFFFFFFF, "Commands"},
    {"RDFIFO", RDFIFO, 0, vp::Access::read_only, 0, "Answers"},
    {"MCTL", MCTL, 0x00000010, vp::Access::read_write, 0x00000011, "Reset and flush", mctl_fields},
    {"UNLOCK", UNLOCK, 0, vp::Access::write_only, 0xFFFFFFFF,
     "No register: the vendor's driver writes the key of devcfg here"},
};

}  // namespace ps_xadc
