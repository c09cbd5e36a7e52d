#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// Gigabit Ethernet controller of the Zynq-7000 (UG585 chapter 16 and appendix B.18), without PHY
/// and network.
namespace gem {

constexpr std::uint32_t gem0_base = 0xE000B000, gem1_base = 0xE000C000;
constexpr std::uint32_t gem0_interrupt = 54, gem1_interrupt = 77;

constexpr std::uint32_t NET_CTRL = 0x00;
constexpr std::uint32_t INTR_STATUS = 0x24;
constexpr std::uint32_t INTR_EN = 0x28;
constexpr std::uint32_t INTR_DIS = 0x2C;
constexpr std::uint32_t INTR_MASK = 0x30;
constexpr std::uint32_t PHY_MAINT = 0x34;

constexpr std::uint32_t intr_all = 0x07FFFFFF;

inline constexpr vp::RegisterInfo registers[] = {
    {"NET_CTRL", NET_CTRL, 0, vp::Access::read_write, 0x0007FFFE, "Control"},
    {"NET_CFG", 0x04, 0x00080000, vp::Access::read_write, 0xFFFFFFFF, "Configuration"},
    {"NET_STATUS", 0x08, 0x00000004, vp::Access::read_only, 0, "PHY management is idle"},
    {"DMA_CFG", 0x10, 0x00020784, vp::Access::read_write, 0x01FFFFFF, "DMA"},
    {"TX_STATUS", 0x14, 0, vp::Access::write_1_to_clear, 0x1FF, "State of sending"},
    {"RX_QBAR", 0x18, 0, vp::Access::read_write, 0xFFFFFFFC, "Descriptors for receiving"},
    {"TX_QBAR", 0x1C, 0, vp::Access::read_write, 0xFFFFFFFC, "Descriptors for sending"},
    {"RX_STATUS", 0x20, 0, vp::Access::write_1_to_clear, 0xF, "State of receiving"},
    {"INTR_STATUS", INTR_STATUS, 0, vp::Access::write_1_to_clear, intr_all, "Events"},
    {"INTR_EN", INTR_EN, 0, vp::Access::write_only, intr_all, "1 enables an interrupt"},
    {"INTR_DIS", INTR_DIS, 0, vp::Access::write_only, intr_all, "1 disables an interrupt"},
    {"INTR_MASK", INTR_MASK, 0x07FFFEFF, vp::Access::read_only, 0, "1 where it is disabled"},
    {"PHY_MAINT", PHY_MAINT, 0, vp::Access::read_write, 0xFFFFFFFF,
     "PHY management: no PHY answers, a read gives 0xFFFF"},
    {"RX_PAUSE", 0x38, 0, vp::Access::read_only, 0, "Received pause"},
    {"TX_PAUSE", 0x3C, 0xFFFF, vp::Access::read_write, 0xFFFF, "Pause to send"},
    {"HASH_BOT", 0x80, 0, vp::Access::read_write, 0xFFFFFFFF, "Hash filter 31:0"},
    {"HASH_TOP", 0x84, 0, vp::Access::read_write, 0xFFFFFFFF, "Hash filter 63:32"},
    {"SPEC_ADDR1_BOT", 0x88, 0, vp::Access::read_write, 0xFFFFFFFF, "Address 1, low"},
    {"SPEC_ADDR1_TOP", 0x8C, 0, vp::Access::read_write, 0xFFFF, "Address 1, high"},
    {"SPEC_ADDR2_BOT", 0x90, 0, vp::Access::read_write, 0xFFFFFFFF, "Address 2, low"},
    {"SPEC_ADDR2_TOP", 0x94, 0, vp::Access::read_write, 0xFFFF, "Address 2, high"},
    {"SPEC_ADDR3_BOT", 0x98, 0, vp::Access::read_write, 0xFFFFFFFF, "Address 3, low"},
    {"SPEC_ADDR3_TOP", 0x9C, 0, vp::Access::read_write, 0xFFFF, "Address 3, high"},
    {"SPEC_ADDR4_BOT", 0xA0, 0, vp::Access::read_write, 0xFFFFFFFF, "Address 4, low"},
    {"SPEC_ADDR4_TOP", 0xA4, 0, vp::Access::read_write, 0xFFFF, "Address 4, high"},
    {"MODULE_ID", 0xFC, 0x00020118, vp::Access::read_only, 0, "Number and revision"},
};

}  // namespace gem
