#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// I2C controller of the Zynq-7000's processing system, Cadence r1p10 (UG585 chapter 20 and
/// appendix B.22).
namespace ps_i2c {

constexpr std::uint32_t i2c0_base = 0xE0004000, i2c1_base = 0xE0005000;
constexpr std::uint32_t i2c0_interrupt = 57, i2c1_interrupt = 80;

constexpr unsigned fifo_depth = 16;
/// Bytes in the receive FIFO that raise DATA: two places are left.
constexpr unsigned data_level = 14;
/// SCL is the clock divided by 22 (DIV_A + 1) (DIV_B + 1).
constexpr std::uint32_t scl_divisor = 22;

constexpr std::uint32_t CR = 0x00;
constexpr std::uint32_t SR = 0x04;
constexpr std::uint32_t ADDR = 0x08;
constexpr std::uint32_t DATA = 0x0C;
constexpr std::uint32_t ISR = 0x10;
constexpr std::uint32_t TRANS_SIZE = 0x14;
constexpr std::uint32_t SLV_PAUSE = 0x18;
constexpr std::uint32_t TIME_OUT = 0x1C;
constexpr std::uint32_t IMR = 0x20;
constexpr std::uint32_t IER = 0x24;
constexpr std::uint32_t IDR = 0x28;

/// Bits of CR.
namespace cr {
constexpr std::uint32_t RW = 1u << 0;  ///< 1: the master receives
constexpr std::uint32_t MS = 1u << 1;  ///< 1: master
constexpr std::uint32_t NEA = 1u << 2;
constexpr std::uint32_t ACKEN = 1u << 3;
constexpr std::uint32_t HOLD = 1u << 4;
constexpr std::uint32_t SLVMON = 1u << 5;
constexpr std::uint32_t CLR_FIFO = 1u << 6;
constexpr unsigned DIV_B_shift = 8, DIV_A_shift = 14;
constexpr std::uint32_t DIV_B = 0x3Fu << DIV_B_shift;
constexpr std::uint32_t DIV_A = 0x3u << DIV_A_shift;
}  // namespace cr

/// Bits of SR.
namespace sr {
constexpr std::uint32_t RXRW = 1u << 3;
constexpr std::uint32_t RXDV = 1u << 5;
constexpr std::uint32_t TXDV = 1u << 6;
constexpr std::uint32_t RXOVF = 1u << 7;
constexpr std::uint32_t BA = 1u << 8;
}  // namespace sr

/// Bits of ISR, IMR, IER and IDR.
namespace event {
constexpr std::uint32_t COMP = 1u << 0;
constexpr std::uint32_t DATA = 1u << 1;
constexpr std::uint32_t NACK = 1u << 2;
constexpr std::uint32_t TO = 1u << 3;
constexpr std::uint32_t SLV_RDY = 1u << 4;
constexpr std::uint32_t RX_OVF = 1u << 5;
constexpr std::uint32_t TX_OVF = 1u << 6;
constexpr std::uint32_t RX_UNF = 1u << 7;
constexpr std::uint32_t ARB_LOST = 1u << 9;
constexpr std::uint32_t all = 0x2FF;
}  // namespace event

inline constexpr vp::RegisterField cr_fields[] = {
    {"RW", cr::RW, vp::Access::read_write, "1: the master receives"},
    {"MS", cr::MS, vp::Access::read_write, "1: master"},
    {"NEA", cr::NEA, vp::Access::read_write, "1: addresses of 7 bits"},
    {"ACKEN", cr::ACKEN, vp::Access::read_write, "1: received bytes are acknowledged"},
    {"HOLD", cr::HOLD, vp::Access::read_write, "1: the bus is held at the end of a transfer"},
    {"SLVMON", cr::SLVMON, vp::Access::read_write,
     "1: the address is polled until a slave answers"},
    {"CLR_FIFO", cr::CLR_FIFO, vp::Access::read_write, "1 clears the FIFO, and itself"},
    {"DIV_B", cr::DIV_B, vp::Access::read_write, "second stage of the clock divider"},
    {"DIV_A", cr::DIV_A, vp::Access::read_write, "first stage of the clock divider"},
};
inline constexpr vp::RegisterField sr_fields[] = {
    {"RXRW", sr::RXRW, vp::Access::read_only, "slave: the master reads"},
    {"RXDV", sr::RXDV, vp::Access::read_only, "bytes to be read in DATA"},
    {"TXDV", sr::TXDV, vp::Access::read_only, "bytes to be sent in the FIFO"},
    {"RXOVF", sr::RXOVF, vp::Access::read_only, "a byte met a full FIFO"},
    {"BA", sr::BA, vp::Access::read_only, "the bus is in use"},
};

#define PS_I2C_EVENT_FIELDS(access, what)                                            \
  {"COMP", event::COMP, access, what ": the transfer is complete"},                  \
      {"DATA", event::DATA, access, what ": more data"},                             \
      {"NACK", event::NACK, access, what ": no acknowledge"},                        \
      {"TO", event::TO, access, what ": time-out"},                                  \
      {"SLV_RDY", event::SLV_RDY, access, what ": the monitored slave answers"},     \
      {"RX_OVF", event::RX_OVF, access, what ": a received byte met a full FIFO"},   \
      {"TX_OVF", event::TX_OVF, access, what ": a byte was written to a full FIFO"}, \
      {"RX_UNF", event::RX_UNF, access, what ": an empty FIFO was read"}, {          \
    "ARB_LOST", event::ARB_LOST, access, what ": arbitration lost"                   \
  }

inline constexpr vp::RegisterField isr_fields[] = {
    PS_I2C_EVENT_FIELDS(vp::Access::write_1_to_clear, "event")};
inline constexpr vp::RegisterField ier_fields[] = {
    PS_I2C_EVENT_FIELDS(vp::Access::write_only, "enables")};
inline constexpr vp::RegisterField idr_fields[] = {
    PS_I2C_EVENT_FIELDS(vp::Access::write_only, "masks")};

#undef PS_I2C_EVENT_FIELDS

inline constexpr vp::RegisterInfo registers[] = {
    {"CR", CR, 0, vp::Access::read_write, 0xFF7F, "Control: divider, mode, hold", cr_fields},
    {"SR", SR, 0, vp::Access::read_only, 0, "Status of bus and FIFO", sr_fields},
    {"ADDR", ADDR, 0, vp::Access::read_write, 0x3FF,
     "Address; a master's write starts the transfer"},
    {"DATA", DATA, 0, vp::Access::read_write, 0xFF, "FIFO of 16 bytes"},
    {"ISR", ISR, 0, vp::Access::write_1_to_clear, event::all, "Events", isr_fields},
    {"TRANS_SIZE", TRANS_SIZE, 0, vp::Access::read_write, 0xFF,
     "Bytes to receive, or still to be sent from the FIFO"},
    {"SLV_PAUSE", SLV_PAUSE, 0, vp::Access::read_write, 0xF, "Pause of the slave monitor"},
    {"TIME_OUT", TIME_OUT, 0x1F, vp::Access::read_write, 0xFF, "Longest time of SCL low"},
    {"IMR", IMR, event::all, vp::Access::read_only, 0, "1 where the interrupt is masked"},
    {"IER", IER, 0, vp::Access::write_only, event::all, "1 enables an interrupt", ier_fields},
    {"IDR", IDR, 0, vp::Access::write_only, event::all, "1 masks an interrupt", idr_fields},
};

}  // namespace ps_i2c
