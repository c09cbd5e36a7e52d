#pragma once

#include <cstdint>

#include <vp/register_description.h>

/// AXI GPIO v2.0 (PG144): the registers as software sees them.
namespace axi_gpio {

constexpr std::uint32_t GPIO_DATA = 0x000;
constexpr std::uint32_t GPIO_TRI = 0x004;
constexpr std::uint32_t GPIO2_DATA = 0x008;
constexpr std::uint32_t GPIO2_TRI = 0x00C;
constexpr std::uint32_t GIER = 0x11C;
constexpr std::uint32_t IP_ISR = 0x120;
constexpr std::uint32_t IP_IER = 0x128;

/// Bits of GIER.
namespace gier {
constexpr std::uint32_t Global_Interrupt_Enable = 1u << 31;
}

/// Bits of IP_ISR and IP_IER.
namespace channel {
constexpr std::uint32_t Channel_1 = 1u << 0;
constexpr std::uint32_t Channel_2 = 1u << 1;
}  // namespace channel

inline constexpr vp::RegisterField gier_fields[] = {
    {"Global_Interrupt_Enable", gier::Global_Interrupt_Enable, vp::Access::read_write,
     "1: ip2intc_irpt shows IP_ISR & IP_IER"},
};
inline constexpr vp::RegisterField ip_isr_fields[] = {
    {"Channel_1", channel::Channel_1, vp::Access::write_1_to_toggle,
     "a pin of channel 1 changed, whatever its direction; writing 1 inverts the bit"},
    {"Channel_2", channel::Channel_2, vp::Access::write_1_to_toggle,
     "a pin of channel 2 changed, whatever its direction; writing 1 inverts the bit"},
};
inline constexpr vp::RegisterField ip_ier_fields[] = {
    {"Channel_1", channel::Channel_1, vp::Access::read_write, "1: channel 1 may interrupt"},
    {"Channel_2", channel::Channel_2, vp::Access::read_write, "1: channel 2 may interrupt"},
};

/// Address bits that the slave decodes: the registers repeat every 512 bytes of its window.
constexpr unsigned address_bits = 9;

/// The dual-channel build with interrupt and inputs and outputs mixed. Other builds show constants
/// instead (a channel of outputs or inputs only reads TRI as all ones), and reset values are build
/// options.
inline constexpr vp::RegisterInfo registers[] = {
    {"GPIO_DATA", GPIO_DATA, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
     "Channel 1 data: outputs as written, inputs as synchronised from the pins"},
    {"GPIO_TRI", GPIO_TRI, 0xFFFFFFFF, vp::Access::read_write, 0xFFFFFFFF,
     "Channel 1 direction of each bit: 0 output, 1 input"},
    {"GPIO2_DATA", GPIO2_DATA, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
     "Channel 2 data: outputs as written, inputs as synchronised from the pins"},
    {"GPIO2_TRI", GPIO2_TRI, 0xFFFFFFFF, vp::Access::read_write, 0xFFFFFFFF,
     "Channel 2 direction of each bit: 0 output, 1 input"},
    {"GIER", GIER, 0x00000000, vp::Access::read_write, 0x80000000, "Global interrupt enable",
     gier_fields},
    {"IP_ISR", IP_ISR, 0x00000000, vp::Access::write_1_to_toggle, 0x00000003,
     "Interrupt status of both channels: an input changed", ip_isr_fields},
    {"IP_IER", IP_IER, 0x00000000, vp::Access::read_write, 0x00000003,
     "Interrupt enable of both channels", ip_ier_fields},
};

}  // namespace axi_gpio
