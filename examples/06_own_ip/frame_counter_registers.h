#pragma once

#include <cstdint>

#include <vp/register_description.h>

/// A counter of frames: the registers as model and software see them.
namespace frame_counter {

/// Where this design puts it, and its interrupt, unless configured otherwise.
constexpr std::uint32_t base = 0x4122'0000, interrupt = 63;

constexpr std::uint32_t CONTROL = 0x0, COUNT = 0x4, STATUS = 0x8;
constexpr std::uint32_t enable = 1;   ///< of CONTROL: frames are counted
constexpr std::uint32_t counted = 1;  ///< of STATUS: a frame was, since software cleared it

inline constexpr vp::RegisterInfo registers[] = {
    {"CONTROL", CONTROL, 0, vp::Access::read_write, enable, "bit 0: count frames"},
    {"COUNT", COUNT, 0, vp::Access::read_only, 0, "frames that began while they were counted"},
    {"STATUS", STATUS, 0, vp::Access::write_1_to_clear, counted, "bit 0: a frame was counted"},
};

}  // namespace frame_counter
