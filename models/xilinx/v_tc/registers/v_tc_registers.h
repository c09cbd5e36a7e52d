#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// Video timing controller v6.2 (PG016): a detector and a generator of frame timing.
namespace v_tc {

constexpr std::uint32_t CONTROL = 0x000;
constexpr std::uint32_t STATUS = 0x004;
constexpr std::uint32_t ERROR = 0x008;
constexpr std::uint32_t IRQ_ENABLE = 0x00C;
constexpr std::uint32_t VERSION = 0x010;
constexpr std::uint32_t DETECTOR_ACTIVE_SIZE = 0x020;
constexpr std::uint32_t DETECTOR_TIMING_STATUS = 0x024;
constexpr std::uint32_t DETECTOR_ENCODING = 0x028;
constexpr std::uint32_t DETECTOR_POLARITY = 0x02C;
constexpr std::uint32_t DETECTOR_HSIZE = 0x030;
constexpr std::uint32_t DETECTOR_VSIZE = 0x034;
constexpr std::uint32_t DETECTOR_HSYNC = 0x038;
constexpr std::uint32_t DETECTOR_F0_VBLANK_H = 0x03C;
constexpr std::uint32_t DETECTOR_F0_VSYNC_V = 0x040;
constexpr std::uint32_t DETECTOR_F0_VSYNC_H = 0x044;
constexpr std::uint32_t DETECTOR_F1_VBLANK_H = 0x048;
constexpr std::uint32_t DETECTOR_F1_VSYNC_V = 0x04C;
constexpr std::uint32_t DETECTOR_F1_VSYNC_H = 0x050;
constexpr std::uint32_t GENERATOR_ACTIVE_SIZE = 0x060;
constexpr std::uint32_t GENERATOR_TIMING_STATUS = 0x064;
constexpr std::uint32_t GENERATOR_ENCODING = 0x068;
constexpr std::uint32_t GENERATOR_POLARITY = 0x06C;
constexpr std::uint32_t GENERATOR_HSIZE = 0x070;
constexpr std::uint32_t GENERATOR_VSIZE = 0x074;
constexpr std::uint32_t GENERATOR_HSYNC = 0x078;
constexpr std::uint32_t GENERATOR_F0_VBLANK_H = 0x07C;
constexpr std::uint32_t GENERATOR_F0_VSYNC_V = 0x080;
constexpr std::uint32_t GENERATOR_F0_VSYNC_H = 0x084;
constexpr std::uint32_t GENERATOR_F1_VBLANK_H = 0x088;
constexpr std::uint32_t GENERATOR_F1_VSYNC_V = 0x08C;
constexpr std::uint32_t GENERATOR_F1_VSYNC_H = 0x090;
constexpr std::uint32_t GENERATOR_F1_ACTIVE_SIZE = 0x094;
constexpr std::uint32_t FRAME_SYNC_CONFIG = 0x100;  ///< of 16, a word each
constexpr std::uint32_t GENERATOR_GLOBAL_DELAY = 0x140;
constexpr unsigned address_bits = 9;
constexpr unsigned frame_syncs = 16;

/// Bits of CONTROL. A source select is 1 for the generator's register and 0 for what the detector
/// found.
namespace control {
constexpr std::uint32_t SW_ENABLE = 1u << 0;
constexpr std::uint32_t REG_UPDATE = 1u << 1;
constexpr std::uint32_t GEN_ENABLE = 1u << 2;
constexpr std::uint32_t DET_ENABLE = 1u << 3;
constexpr std::uint32_t SYNC_ENABLE = 1u << 5;
constexpr std::uint32_t HTOTAL_SRC = 1u << 8;
constexpr std::uint32_t HACTIVE_SRC = 1u << 9;
constexpr std::uint32_t HSYNC_START_SRC = 1u << 10;
constexpr std::uint32_t HSYNC_END_SRC = 1u << 11;
constexpr std::uint32_t VTOTAL_SRC = 1u << 13;
constexpr std::uint32_t VACTIVE_SRC = 1u << 14;
constexpr std::uint32_t VSYNC_START_SRC = 1u << 15;
constexpr std::uint32_t VSYNC_END_SRC = 1u << 16;
constexpr std::uint32_t VBLANK_H_SRC = 1u << 17;
constexpr std::uint32_t CHROMA_SRC = 1u << 18;
constexpr std::uint32_t INTERLACED = 1u << 19;
constexpr std::uint32_t POLARITY_SRC = 0x7Fu << 20;
constexpr unsigned POLARITY_SRC_shift = 20;
constexpr std::uint32_t FSYNC_RESET = 1u << 30;
constexpr std::uint32_t SW_RESET = 1u << 31;
}  // namespace control

/// Bits of STATUS and IRQ_ENABLE.
namespace irq {
constexpr std::uint32_t DET_LOCK = 1u << 8;
constexpr std::uint32_t DET_LOCK_LOSS = 1u << 9;
constexpr std::uint32_t DET_VBLANK = 1u << 10;
constexpr std::uint32_t DET_ACTIVE_VIDEO = 1u << 11;
constexpr std::uint32_t GEN_VBLANK = 1u << 12;
constexpr std::uint32_t GEN_ACTIVE_VIDEO = 1u << 13;
constexpr std::uint32_t FSYNC = 0xFFFFu << 16;
constexpr unsigned FSYNC_shift = 16;
constexpr std::uint32_t all = 0xFFFF3F00;
}  // namespace irq

/// Bits of ERROR: a signal that the detector lost.
namespace error {
constexpr std::uint32_t VBLANK = 1u << 16;
constexpr std::uint32_t HBLANK = 1u << 17;
constexpr std::uint32_t VSYNC = 1u << 18;
constexpr std::uint32_t HSYNC = 1u << 19;
constexpr std::uint32_t ACTIVE_VIDEO = 1u << 20;
constexpr std::uint32_t ACTIVE_CHROMA = 1u << 21;
constexpr std::uint32_t all = 0x003F0000;
}  // namespace error

/// Bits of the timing status registers.
namespace timing {
constexpr std::uint32_t LOCKED = 1u << 0;
constexpr std::uint32_t VBLANK = 1u << 1;
constexpr std::uint32_t ACTIVE_VIDEO = 1u << 2;
}  // namespace timing

/// Bits of the polarity registers: 1 is active high.
namespace polarity {
constexpr std::uint32_t VBLANK = 1u << 0;
constexpr std::uint32_t HBLANK = 1u << 1;
constexpr std::uint32_t VSYNC = 1u << 2;
constexpr std::uint32_t HSYNC = 1u << 3;
constexpr std::uint32_t ACTIVE_VIDEO = 1u << 4;
constexpr std::uint32_t ACTIVE_CHROMA = 1u << 5;
constexpr std::uint32_t FIELD_ID = 1u << 6;
constexpr std::uint32_t all = 0x7F;
}  // namespace polarity

/// Both halves of most registers.
constexpr std::uint32_t low_half = 0x1FFF;
constexpr unsigned high_half_shift = 16;
constexpr std::uint32_t both_halves = 0x1FFF1FFF;
/// A bit of the encoding registers.
constexpr std::uint32_t encoding_INTERLACED = 1u << 6;

inline constexpr vp::RegisterField control_fields[] = {
    {"SW_ENABLE", control::SW_ENABLE, vp::Access::read_write, "the core is on"},
    {"REG_UPDATE", control::REG_UPDATE, vp::Access::read_write,
     "generator registers take effect with the next frame"},
    {"GEN_ENABLE", control::GEN_ENABLE, vp::Access::read_write, "the generator runs"},
    {"DET_ENABLE", control::DET_ENABLE, vp::Access::read_write, "the detector runs"},
    {"SYNC_ENABLE", control::SYNC_ENABLE, vp::Access::read_write,
     "the generator follows the detector: not modelled"},
    {"HTOTAL_SRC", control::HTOTAL_SRC, vp::Access::read_write, "1: register, 0: detector"},
    {"HACTIVE_SRC", control::HACTIVE_SRC, vp::Access::read_write, "1: register, 0: detector"},
    {"HSYNC_START_SRC", control::HSYNC_START_SRC, vp::Access::read_write,
     "1: register, 0: detector"},
    {"HSYNC_END_SRC", control::HSYNC_END_SRC, vp::Access::read_write, "1: register, 0: detector"},
    {"VTOTAL_SRC", control::VTOTAL_SRC, vp::Access::read_write, "1: register, 0: detector"},
    {"VACTIVE_SRC", control::VACTIVE_SRC, vp::Access::read_write, "1: register, 0: detector"},
    {"VSYNC_START_SRC", control::VSYNC_START_SRC, vp::Access::read_write,
     "1: register, 0: detector"},
    {"VSYNC_END_SRC", control::VSYNC_END_SRC, vp::Access::read_write, "1: register, 0: detector"},
    {"VBLANK_H_SRC", control::VBLANK_H_SRC, vp::Access::read_write,
     "horizontal offsets of both; 1: register, 0: detector"},
    {"CHROMA_SRC", control::CHROMA_SRC, vp::Access::read_write, "1: register, 0: detector"},
    {"INTERLACED", control::INTERLACED, vp::Access::read_write, "not modelled"},
    {"POLARITY_SRC", control::POLARITY_SRC, vp::Access::read_write,
     "of each output; 1: register, 0: detector"},
    {"FSYNC_RESET", control::FSYNC_RESET, vp::Access::write_only,
     "1 resets the core at the end of the frame"},
    {"SW_RESET", control::SW_RESET, vp::Access::write_only, "1 resets the core now"},
};

inline constexpr vp::RegisterField irq_fields[] = {
    {"DET_LOCK", irq::DET_LOCK, vp::Access::write_1_to_clear, "the detector locked"},
    {"DET_LOCK_LOSS", irq::DET_LOCK_LOSS, vp::Access::write_1_to_clear, "it lost lock"},
    {"DET_VBLANK", irq::DET_VBLANK, vp::Access::write_1_to_clear, "a vertical blank came in"},
    {"DET_ACTIVE_VIDEO", irq::DET_ACTIVE_VIDEO, vp::Access::write_1_to_clear,
     "a frame's first pixel came in"},
    {"GEN_VBLANK", irq::GEN_VBLANK, vp::Access::write_1_to_clear, "a vertical blank began"},
    {"GEN_ACTIVE_VIDEO", irq::GEN_ACTIVE_VIDEO, vp::Access::write_1_to_clear,
     "a frame's first pixel"},
    {"FSYNC", irq::FSYNC, vp::Access::write_1_to_clear, "a bit for each frame sync"},
};

#define V_TC_FRAME_SYNC(number, text)                                                         \
  {                                                                                           \
    "FRAME_SYNC" text "_CONFIG", FRAME_SYNC_CONFIG + 4 * (number), 0, vp::Access::read_write, \
        both_halves, "Frame sync " text ": line, and clock in it"                             \
  }

inline constexpr vp::RegisterInfo registers[] = {
    {"CONTROL", CONTROL, 0, vp::Access::read_write, 0x07FFEF2F, "Control", control_fields},
    {"STATUS", STATUS, 0, vp::Access::write_1_to_clear, irq::all, "Interrupts that came",
     irq_fields},
    {"ERROR", ERROR, 0, vp::Access::write_1_to_clear, error::all, "Signals that lost lock"},
    {"IRQ_ENABLE", IRQ_ENABLE, 0, vp::Access::read_write, irq::all, "A bit for each of STATUS"},
    {"VERSION", VERSION, 0x06020000, vp::Access::read_only, 0,
     "Version of the core, 6.2: its build is assumed"},
    {"DETECTOR_ACTIVE_SIZE", DETECTOR_ACTIVE_SIZE, 0, vp::Access::read_only, 0,
     "Detected lines and pixels of a frame"},
    {"DETECTOR_TIMING_STATUS", DETECTOR_TIMING_STATUS, 0, vp::Access::read_only, 0,
     "Lock, blank and active video that come in"},
    {"DETECTOR_ENCODING", DETECTOR_ENCODING, 0, vp::Access::read_only, 0, "Detected encoding"},
    {"DETECTOR_POLARITY", DETECTOR_POLARITY, 0, vp::Access::read_only, 0, "Detected polarities"},
    {"DETECTOR_HSIZE", DETECTOR_HSIZE, 0, vp::Access::read_only, 0, "Detected clocks of a line"},
    {"DETECTOR_VSIZE", DETECTOR_VSIZE, 0, vp::Access::read_only, 0, "Detected lines of a frame"},
    {"DETECTOR_HSYNC", DETECTOR_HSYNC, 0, vp::Access::read_only, 0,
     "Detected end and start of the horizontal sync"},
    {"DETECTOR_F0_VBLANK_H", DETECTOR_F0_VBLANK_H, 0, vp::Access::read_only, 0,
     "Detected clocks in a line where the vertical blank ends and starts"},
    {"DETECTOR_F0_VSYNC_V", DETECTOR_F0_VSYNC_V, 0, vp::Access::read_only, 0,
     "Detected lines in which the vertical sync ends and starts"},
    {"DETECTOR_F0_VSYNC_H", DETECTOR_F0_VSYNC_H, 0, vp::Access::read_only, 0,
     "Detected clocks in a line where the vertical sync ends and starts"},
    {"DETECTOR_F1_VBLANK_H", DETECTOR_F1_VBLANK_H, 0, vp::Access::read_only, 0,
     "The same of field 1, which is not modelled"},
    {"DETECTOR_F1_VSYNC_V", DETECTOR_F1_VSYNC_V, 0, vp::Access::read_only, 0,
     "The same of field 1, which is not modelled"},
    {"DETECTOR_F1_VSYNC_H", DETECTOR_F1_VSYNC_H, 0, vp::Access::read_only, 0,
     "The same of field 1, which is not modelled"},
    {"GENERATOR_ACTIVE_SIZE", GENERATOR_ACTIVE_SIZE, 0, vp::Access::read_write, both_halves,
     "Lines and pixels of a frame"},
    {"GENERATOR_TIMING_STATUS", GENERATOR_TIMING_STATUS, 0, vp::Access::read_only, 0,
     "Blank and active video of the generator"},
    {"GENERATOR_ENCODING", GENERATOR_ENCODING, 0, vp::Access::read_write, 0x3CF,
     "Interlaced, chroma parity, video format"},
    {"GENERATOR_POLARITY", GENERATOR_POLARITY, polarity::all, vp::Access::read_write, polarity::all,
     "Polarities of the outputs: 1 is active high"},
    {"GENERATOR_HSIZE", GENERATOR_HSIZE, 0, vp::Access::read_write, low_half, "Clocks of a line"},
    {"GENERATOR_VSIZE", GENERATOR_VSIZE, 0, vp::Access::read_write, both_halves,
     "Lines of fields 1 and 0"},
    {"GENERATOR_HSYNC", GENERATOR_HSYNC, 0, vp::Access::read_write, both_halves,
     "End and start of the horizontal sync"},
    {"GENERATOR_F0_VBLANK_H", GENERATOR_F0_VBLANK_H, 0, vp::Access::read_write, both_halves,
     "Clocks in a line where the vertical blank ends and starts"},
    {"GENERATOR_F0_VSYNC_V", GENERATOR_F0_VSYNC_V, 0, vp::Access::read_write, both_halves,
     "Lines in which the vertical sync ends and starts"},
    {"GENERATOR_F0_VSYNC_H", GENERATOR_F0_VSYNC_H, 0, vp::Access::read_write, both_halves,
     "Clocks in a line where the vertical sync ends and starts"},
    {"GENERATOR_F1_VBLANK_H", GENERATOR_F1_VBLANK_H, 0, vp::Access::read_write, both_halves,
     "The same of field 1, which is not modelled"},
    {"GENERATOR_F1_VSYNC_V", GENERATOR_F1_VSYNC_V, 0, vp::Access::read_write, both_halves,
     "The same of field 1, which is not modelled"},
    {"GENERATOR_F1_VSYNC_H", GENERATOR_F1_VSYNC_H, 0, vp::Access::read_write, both_halves,
     "The same of field 1, which is not modelled"},
    {"GENERATOR_F1_ACTIVE_SIZE", GENERATOR_F1_ACTIVE_SIZE, 0, vp::Access::read_write,
     low_half << high_half_shift, "Lines of field 1, which is not modelled"},
    V_TC_FRAME_SYNC(0, "0"),
    V_TC_FRAME_SYNC(1, "1"),
    V_TC_FRAME_SYNC(2, "2"),
    V_TC_FRAME_SYNC(3, "3"),
    V_TC_FRAME_SYNC(4, "4"),
    V_TC_FRAME_SYNC(5, "5"),
    V_TC_FRAME_SYNC(6, "6"),
    V_TC_FRAME_SYNC(7, "7"),
    V_TC_FRAME_SYNC(8, "8"),
    V_TC_FRAME_SYNC(9, "9"),
    V_TC_FRAME_SYNC(10, "10"),
    V_TC_FRAME_SYNC(11, "11"),
    V_TC_FRAME_SYNC(12, "12"),
    V_TC_FRAME_SYNC(13, "13"),
    V_TC_FRAME_SYNC(14, "14"),
    V_TC_FRAME_SYNC(15, "15"),
    {"GENERATOR_GLOBAL_DELAY", GENERATOR_GLOBAL_DELAY, 0, vp::Access::read_write, both_halves,
     "Lines and clocks behind the detector: not modelled"},
};

#undef V_TC_FRAME_SYNC

}  // namespace v_tc
