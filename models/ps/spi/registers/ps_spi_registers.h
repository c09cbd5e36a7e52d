#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// SPI controller of the Zynq-7000's processing system (UG585 chapter 17 and appendix B.30).
namespace ps_spi {

constexpr std::uint32_t spi0_base = 0xE0006000, spi1_base = 0xE0007000;
constexpr std::uint32_t spi0_interrupt = 58, spi1_interrupt = 81;
constexpr unsigned fifo_depth = 128;

constexpr std::uint32_t CR = 0x00;
constexpr std::uint32_t ISR = 0x04;
constexpr std::uint32_t IER = 0x08;
constexpr std::uint32_t IDR = 0x0C;
constexpr std::uint32_t IMR = 0x10;
constexpr std::uint32_t ENABLE = 0x14;
constexpr std::uint32_t DELAY = 0x18;
constexpr std::uint32_t TXD = 0x1C;
constexpr std::uint32_t RXD = 0x20;
constexpr std::uint32_t SLAVE_IDLE = 0x24;
constexpr std::uint32_t TX_THRES = 0x28;
constexpr std::uint32_t RX_THRES = 0x2C;
constexpr std::uint32_t MOD_ID = 0xFC;

/// Bits of CR.
namespace cr {
constexpr std::uint32_t MSTREN = 1u << 0;
constexpr std::uint32_t CPOL = 1u << 1;
constexpr std::uint32_t CPHA = 1u << 2;
constexpr unsigned PRESC_shift = 3;
constexpr std::uint32_t PRESC = 7u << PRESC_shift;
constexpr std::uint32_t DECODE = 1u << 9;
constexpr unsigned SSCTRL_shift = 10;
constexpr std::uint32_t SSCTRL = 0xFu << SSCTRL_shift;
constexpr std::uint32_t SSFORCE = 1u << 14;
constexpr std::uint32_t MANSTRTEN = 1u << 15;
constexpr std::uint32_t MANSTRT = 1u << 16;
constexpr std::uint32_t MODF_GEN = 1u << 17;
}  // namespace cr

/// Bits of ISR, IER, IDR and IMR.
namespace event {
constexpr std::uint32_t RXOVR = 1u << 0;
constexpr std::uint32_t MODF = 1u << 1;
constexpr std::uint32_t TXOW = 1u << 2;
constexpr std::uint32_t TXFULL = 1u << 3;
constexpr std::uint32_t RXNEMPTY = 1u << 4;
constexpr std::uint32_t RXFULL = 1u << 5;
constexpr std::uint32_t TXUF = 1u << 6;
constexpr std::uint32_t all = 0x7F;
constexpr std::uint32_t cleared_by_writing = RXOVR | MODF | TXUF;
}  // namespace event

inline constexpr vp::RegisterField cr_fields[] = {
    {"MSTREN", cr::MSTREN, vp::Access::read_write, "1: master"},
    {"CPOL", cr::CPOL, vp::Access::read_write, "level of the clock at rest"},
    {"CPHA", cr::CPHA, vp::Access::read_write, "phase of the clock"},
    {"PRESC", cr::PRESC, vp::Access::read_write, "divides the clock by 2 to the power n + 1"},
    {"DECODE", cr::DECODE, vp::Access::read_write, "1: the selects go to a decoder"},
    {"SSCTRL", cr::SSCTRL, vp::Access::read_write, "the lowest bit that is 0 selects a slave"},
    {"SSFORCE", cr::SSFORCE, vp::Access::read_write, "1: software controls the selects"},
    {"MANSTRTEN", cr::MANSTRTEN, vp::Access::read_write, "1: transfers wait for MANSTRT"},
    {"MANSTRT", cr::MANSTRT, vp::Access::write_only, "1 starts a transfer"},
    {"MODF_GEN", cr::MODF_GEN, vp::Access::read_write, "1: mode faults are detected"},
};
inline constexpr vp::RegisterField isr_fields[] = {
    {"RXOVR", event::RXOVR, vp::Access::write_1_to_clear, "a byte met a full receive FIFO"},
    {"MODF", event::MODF, vp::Access::write_1_to_clear, "another master selected it"},
    {"TXOW", event::TXOW, vp::Access::read_only, "fewer bytes to send than TX_THRES"},
    {"TXFULL", event::TXFULL, vp::Access::read_only, "the send FIFO is full"},
    {"RXNEMPTY", event::RXNEMPTY, vp::Access::read_only, "RX_THRES bytes have come"},
    {"RXFULL", event::RXFULL, vp::Access::read_only, "the receive FIFO is full"},
    {"TXUF", event::TXUF, vp::Access::write_1_to_clear, "a slave had nothing to send"},
};

inline constexpr vp::RegisterInfo registers[] = {
    {"CR", CR, 0x00020000, vp::Access::read_write, 0x0003FE3F, "Configuration", cr_fields},
    {"ISR", ISR, 0x00000004, vp::Access::write_1_to_clear, event::cleared_by_writing,
     "Events and state of the FIFOs", isr_fields},
    {"IER", IER, 0, vp::Access::write_only, event::all, "1 enables an interrupt"},
    {"IDR", IDR, 0, vp::Access::write_only, event::all, "1 disables an interrupt"},
    {"IMR", IMR, 0, vp::Access::read_only, 0, "1 where an interrupt is enabled"},
    {"ENABLE", ENABLE, 0, vp::Access::read_write, 0x1, "1: the controller works"},
    {"DELAY", DELAY, 0, vp::Access::read_write, 0xFFFFFFFF, "Delays between bytes and selects"},
    {"TXD", TXD, 0, vp::Access::write_only, 0xFF, "Send FIFO of 128 bytes"},
    {"RXD", RXD, 0, vp::Access::read_only, 0, "Receive FIFO of 128 bytes"},
    {"SLAVE_IDLE", SLAVE_IDLE, 0xFF, vp::Access::read_write, 0xFF, "Slave: clocks of a pause"},
    {"TX_THRES", TX_THRES, 1, vp::Access::read_write, 0xFFFFFFFF, "Level of the send FIFO"},
    {"RX_THRES", RX_THRES, 1, vp::Access::read_write, 0xFFFFFFFF, "Level of the receive FIFO"},
    {"MOD_ID", MOD_ID, 0x00090106, vp::Access::read_only, 0, "Number of the module"},
};

}  // namespace ps_spi
