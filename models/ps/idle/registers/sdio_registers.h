#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// SD host controller of the Zynq-7000, SDHCI 2.0 (UG585 chapter 13 and appendix B.27), without a
/// card.
namespace sdio {

constexpr std::uint32_t sd0_base = 0xE0100000, sd1_base = 0xE0101000;
constexpr std::uint32_t sd0_interrupt = 56, sd1_interrupt = 79;

constexpr std::uint32_t TRANSFER_COMMAND = 0x0C;
constexpr std::uint32_t CLOCK_RESET = 0x2C;
constexpr std::uint32_t INT_STATUS = 0x30;
constexpr std::uint32_t INT_STATUS_EN = 0x34;
constexpr std::uint32_t INT_SIGNAL_EN = 0x38;

/// Bits of CLOCK_RESET.
namespace clock_reset {
constexpr std::uint32_t Internal_Enable = 1u << 0;
constexpr std::uint32_t Internal_Stable = 1u << 1;
constexpr std::uint32_t Resets = 7u << 24;
}  // namespace clock_reset

/// Bits of INT_STATUS.
namespace event {
constexpr std::uint32_t Error = 1u << 15;
constexpr std::uint32_t Command_Timeout = 1u << 16;
}  // namespace event

inline constexpr vp::RegisterInfo registers[] = {
    {"SDMA_ADDRESS", 0x00, 0, vp::Access::read_write, 0xFFFFFFFF, "Address of simple DMA"},
    {"BLOCK", 0x04, 0, vp::Access::read_write, 0xFFFFFFFF, "Size and count of blocks"},
    {"ARGUMENT", 0x08, 0, vp::Access::read_write, 0xFFFFFFFF, "Argument of the command"},
    {"TRANSFER_COMMAND", TRANSFER_COMMAND, 0, vp::Access::read_write, 0x3FFFFFFF,
     "Transfer mode; command, whose write starts it"},
    {"RESPONSE0", 0x10, 0, vp::Access::read_only, 0, "Response 31:0"},
    {"RESPONSE1", 0x14, 0, vp::Access::read_only, 0, "Response 63:32"},
    {"RESPONSE2", 0x18, 0, vp::Access::read_only, 0, "Response 95:64"},
    {"RESPONSE3", 0x1C, 0, vp::Access::read_only, 0, "Response 127:96"},
    {"BUFFER", 0x20, 0, vp::Access::read_write, 0xFFFFFFFF, "Data port"},
    {"PRESENT_STATE", 0x24, 0x01F20000, vp::Access::read_only, 0, "State: no card is inserted"},
    {"HOST_CONTROL", 0x28, 0, vp::Access::read_write, 0x07FFFFFF, "Bus width, power, wake-up"},
    {"CLOCK_RESET", CLOCK_RESET, 0, vp::Access::read_write, 0x07FFFFFF,
     "Clock, time-out, resets that clear themselves"},
    {"INT_STATUS", INT_STATUS, 0, vp::Access::write_1_to_clear, 0xFFFFFFFF, "Events"},
    {"INT_STATUS_EN", INT_STATUS_EN, 0, vp::Access::read_write, 0xFFFFFFFF, "Events to be seen"},
    {"INT_SIGNAL_EN", INT_SIGNAL_EN, 0, vp::Access::read_write, 0xFFFFFFFF,
     "Events that interrupt"},
    {"AUTO_CMD12", 0x3C, 0, vp::Access::read_only, 0, "Errors of automatic stops"},
    {"CAPABILITIES", 0x40, 0x69EC0080, vp::Access::read_only, 0, "What the controller can do"},
    {"CAPABILITIES_HIGH", 0x44, 0, vp::Access::read_only, 0, "Reserved"},
    {"CURRENT", 0x48, 0x00000001, vp::Access::read_only, 0, "Highest currents"},
    {"FORCE_EVENT", 0x50, 0, vp::Access::write_only, 0xFFFFFFFF, "Sets events"},
    {"ADMA_ERROR", 0x54, 0, vp::Access::read_only, 0, "Error of descriptors"},
    {"ADMA_ADDRESS", 0x58, 0, vp::Access::read_write, 0xFFFFFFFF, "Address of descriptors"},
    {"VERSION", 0xFC, 0x89010000, vp::Access::read_only, 0, "Slot interrupt, version"},
};

}  // namespace sdio
