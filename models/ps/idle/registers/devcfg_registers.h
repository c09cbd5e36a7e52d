#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// Device configuration interface of the Zynq-7000 (UG585 chapter 6 and appendix B.16): its DMA
/// carries bitstreams to the PL.
namespace devcfg {

constexpr std::uint32_t base = 0xF8007000;
constexpr std::uint32_t interrupt_id = 40;

constexpr std::uint32_t CTRL = 0x00;
constexpr std::uint32_t LOCK = 0x04;
constexpr std::uint32_t CFG = 0x08;
constexpr std::uint32_t INT_STS = 0x0C;
constexpr std::uint32_t INT_MASK = 0x10;
constexpr std::uint32_t STATUS = 0x14;
constexpr std::uint32_t DMA_SRC_ADDR = 0x18;
constexpr std::uint32_t DMA_DST_ADDR = 0x1C;
constexpr std::uint32_t DMA_SRC_LEN = 0x20;
constexpr std::uint32_t DMA_DEST_LEN = 0x24;
constexpr std::uint32_t ROM_SHADOW = 0x28;
constexpr std::uint32_t MULTIBOOT_ADDR = 0x2C;
constexpr std::uint32_t UNLOCK = 0x34;
constexpr std::uint32_t MCTRL = 0x80;

/// Bits of INT_STS.
namespace event {
constexpr std::uint32_t PCFG_DONE = 1u << 2;
constexpr std::uint32_t D_P_DONE = 1u << 12;
constexpr std::uint32_t DMA_DONE = 1u << 13;
}  // namespace event

/// Nanoseconds a word of 32 bits takes: the port's 400 MB/s (UG585 6.3).
constexpr std::uint64_t ns_per_word = 10;

inline constexpr vp::RegisterInfo registers[] = {
    {"CTRL", CTRL, 0x0C006000, vp::Access::read_write, 0x7FFFFFFF, "Control"},
    {"LOCK", LOCK, 0, vp::Access::write_1_to_set, 0x1F, "1 locks a part until power-on"},
    {"CFG", CFG, 0x00000508, vp::Access::read_write, 0x00000FFF, "Levels of FIFOs, edges"},
    {"INT_STS", INT_STS, 0, vp::Access::write_1_to_clear, 0xFFFFFFFF, "Events"},
    {"INT_MASK", INT_MASK, 0xFFFFFFFF, vp::Access::read_write, 0xFFFFFFFF, "1 masks an interrupt"},
    {"STATUS", STATUS, 0x40000820, vp::Access::read_only, 0, "State of DMA and configuration"},
    {"DMA_SRC_ADDR", DMA_SRC_ADDR, 0, vp::Access::read_write, 0xFFFFFFFF, "Source"},
    {"DMA_DST_ADDR", DMA_DST_ADDR, 0, vp::Access::read_write, 0xFFFFFFFF, "Destination"},
    {"DMA_SRC_LEN", DMA_SRC_LEN, 0, vp::Access::read_write, 0x07FFFFFF, "Words of the source"},
    {"DMA_DEST_LEN", DMA_DEST_LEN, 0, vp::Access::read_write, 0x07FFFFFF,
     "Words of the destination; a write starts the transfer"},
    {"ROM_SHADOW", ROM_SHADOW, 0, vp::Access::write_only, 0xFFFFFFFF, "Shadow of the boot ROM"},
    {"MULTIBOOT_ADDR", MULTIBOOT_ADDR, 0, vp::Access::read_write, 0x1FFF,
     "Where to boot from next"},
    {"UNLOCK", UNLOCK, 0, vp::Access::write_only, 0xFFFFFFFF, "Key 0x757BDF0D of the boot ROM"},
    {"MCTRL", MCTRL, 0x30800100, vp::Access::read_write, 0x000001F0,
     "Silicon revision, loop-back of the port"},
};

}  // namespace devcfg
