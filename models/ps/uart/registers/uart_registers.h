#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// UART of the Zynq-7000's I/O peripherals (Cadence; UG585 chapter 19 and appendix B.33).
namespace uart {

/// Bus addresses on the Zynq-7000, and interrupts.
constexpr std::uint32_t uart0_base = 0xE0000000;
constexpr std::uint32_t uart1_base = 0xE0001000;
constexpr std::uint32_t uart0_interrupt = 59;
constexpr std::uint32_t uart1_interrupt = 82;

/// Bytes in each of the two FIFOs.
constexpr unsigned fifo_depth = 64;

constexpr std::uint32_t CR = 0x00;
constexpr std::uint32_t MR = 0x04;
constexpr std::uint32_t IER = 0x08;
constexpr std::uint32_t IDR = 0x0C;
constexpr std::uint32_t IMR = 0x10;
constexpr std::uint32_t ISR = 0x14;
constexpr std::uint32_t BAUDGEN = 0x18;
constexpr std::uint32_t RXTOUT = 0x1C;
constexpr std::uint32_t RXWM = 0x20;
constexpr std::uint32_t MODEMCR = 0x24;
constexpr std::uint32_t MODEMSR = 0x28;
constexpr std::uint32_t SR = 0x2C;
constexpr std::uint32_t FIFO = 0x30;
constexpr std::uint32_t BAUD_DIV = 0x34;
constexpr std::uint32_t FLOW_DELAY = 0x38;
constexpr std::uint32_t TX_FIFO_LEVEL = 0x44;

/// Bits of CR.
namespace cr {
constexpr std::uint32_t RXRES = 1u << 0;   ///< empties the receiver; clears itself
constexpr std::uint32_t TXRES = 1u << 1;   ///< empties the transmitter; clears itself
constexpr std::uint32_t RXEN = 1u << 2;    ///< receiver on, if RXDIS is 0
constexpr std::uint32_t RXDIS = 1u << 3;   ///< receiver off
constexpr std::uint32_t TXEN = 1u << 4;    ///< transmitter on, if TXDIS is 0
constexpr std::uint32_t TXDIS = 1u << 5;   ///< transmitter off
constexpr std::uint32_t TORST = 1u << 6;   ///< restarts the receiver's time-out; clears itself
constexpr std::uint32_t STTBRK = 1u << 7;  ///< starts a break; stored only
constexpr std::uint32_t STPBRK = 1u << 8;  ///< ends a break; stored only
}  // namespace cr

/// Fields of MR.
namespace mr {
constexpr std::uint32_t CLKS = 1u << 0;  ///< reference clock divided by 8
constexpr unsigned CHRL_shift = 1;
constexpr std::uint32_t CHRL = 3u << CHRL_shift;  ///< data bits: 0 and 1 eight, 2 seven, 3 six
constexpr unsigned PAR_shift = 3;
constexpr std::uint32_t PAR = 7u << PAR_shift;  ///< 0 even, 1 odd, 2 space, 3 mark, 4 … none
constexpr std::uint32_t PAR_none = 4u << PAR_shift;
constexpr unsigned NBSTOP_shift = 6;
constexpr std::uint32_t NBSTOP = 3u << NBSTOP_shift;  ///< stop bits: 0 one, 1 one and a half, 2 two
constexpr unsigned CHMODE_shift = 8;
constexpr std::uint32_t CHMODE = 3u << CHMODE_shift;
constexpr std::uint32_t CHMODE_normal = 0u << CHMODE_shift;
constexpr std::uint32_t CHMODE_echo = 1u << CHMODE_shift;             ///< what comes goes out, too
constexpr std::uint32_t CHMODE_local_loopback = 2u << CHMODE_shift;   ///< transmitter to receiver
constexpr std::uint32_t CHMODE_remote_loopback = 3u << CHMODE_shift;  ///< what comes only goes out
}  // namespace mr

/// Events: bits of IER, IDR, IMR and ISR. Each is set when the condition begins.
namespace event {
constexpr std::uint32_t RTRIG = 1u << 0;    ///< receive FIFO filled to RXWM
constexpr std::uint32_t REMPTY = 1u << 1;   ///< last byte read from the receive FIFO
constexpr std::uint32_t RFUL = 1u << 2;     ///< receive FIFO became full
constexpr std::uint32_t TEMPTY = 1u << 3;   ///< last byte left the transmit FIFO for the shifter
constexpr std::uint32_t TFUL = 1u << 4;     ///< transmit FIFO became full
constexpr std::uint32_t ROVR = 1u << 5;     ///< a byte came with the receive FIFO full: it is lost
constexpr std::uint32_t FRAME = 1u << 6;    ///< framing error: never on this line
constexpr std::uint32_t PARE = 1u << 7;     ///< parity error: never on this line
constexpr std::uint32_t TIMEOUT = 1u << 8;  ///< nothing came for RXTOUT × 4 + 3 bits
constexpr std::uint32_t DMSI = 1u << 9;     ///< modem status changed: no modem lines here
constexpr std::uint32_t TTRIG = 1u << 10;   ///< transmit FIFO filled to TX_FIFO_LEVEL
constexpr std::uint32_t TNFUL = 1u << 11;   ///< room for one byte only in the transmit FIFO
constexpr std::uint32_t TOVR = 1u << 12;    ///< written with the transmit FIFO full: byte lost
constexpr std::uint32_t all = 0x1FFF;
}  // namespace event

/// Bits of SR: how it is now.
namespace sr {
constexpr std::uint32_t RTRIG = 1u << 0;     ///< receive FIFO at RXWM or above (RXWM not 0)
constexpr std::uint32_t REMPTY = 1u << 1;    ///< receive FIFO empty
constexpr std::uint32_t RFUL = 1u << 2;      ///< receive FIFO full
constexpr std::uint32_t TEMPTY = 1u << 3;    ///< transmit FIFO empty
constexpr std::uint32_t TFUL = 1u << 4;      ///< transmit FIFO full
constexpr std::uint32_t RACTIVE = 1u << 10;  ///< a byte is coming
constexpr std::uint32_t TACTIVE = 1u << 11;  ///< a byte is going
constexpr std::uint32_t FDELT = 1u << 12;    ///< receive FIFO at FLOW_DELAY or above (4 or more)
constexpr std::uint32_t TTRIG = 1u << 13;    ///< transmit FIFO at TX_FIFO_LEVEL or above (not 0)
constexpr std::uint32_t TNFUL = 1u << 14;    ///< room for one byte in the transmit FIFO
}  // namespace sr

/// Bits of MODEMCR.
namespace modemcr {
constexpr std::uint32_t DTR = 1u << 0;  ///< stored only
constexpr std::uint32_t RTS = 1u << 1;  ///< stored only
constexpr std::uint32_t FCM = 1u << 5;  ///< automatic flow control: shown in MODEMSR
}  // namespace modemcr

/// Bits of MODEMSR. The lines are not wired: only FCMS is ever 1.
namespace modemsr {
constexpr std::uint32_t deltas = 0xF;  ///< changes; writing 1 clears
constexpr std::uint32_t FCMS = 1u << 8;
}  // namespace modemsr

/// Least BAUD_DIV that divides; smaller values are not taken.
constexpr std::uint32_t smallest_baud_div = 4;

inline constexpr vp::RegisterField cr_fields[] = {
    {"RXRES", cr::RXRES, vp::Access::write_only, "1 empties the receiver; clears itself"},
    {"TXRES", cr::TXRES, vp::Access::write_only, "1 empties the transmitter; clears itself"},
    {"RXEN", cr::RXEN, vp::Access::read_write, "receiver on, if RXDIS is 0"},
    {"RXDIS", cr::RXDIS, vp::Access::read_write, "receiver off"},
    {"TXEN", cr::TXEN, vp::Access::read_write, "transmitter on, if TXDIS is 0"},
    {"TXDIS", cr::TXDIS, vp::Access::read_write, "transmitter off"},
    {"TORST", cr::TORST, vp::Access::write_only,
     "1 restarts the receiver's time-out; clears itself"},
    {"STTBRK", cr::STTBRK, vp::Access::read_write, "starts a break: stored only"},
    {"STPBRK", cr::STPBRK, vp::Access::read_write, "ends a break: stored only"},
};
inline constexpr vp::RegisterField mr_fields[] = {
    {"CLKS", mr::CLKS, vp::Access::read_write, "1: reference clock divided by 8"},
    {"CHRL", mr::CHRL, vp::Access::read_write, "data bits: 0 and 1 eight, 2 seven, 3 six"},
    {"PAR", mr::PAR, vp::Access::read_write,
     "parity: 0 even, 1 odd, 2 space, 3 mark, 4 and more none"},
    {"NBSTOP", mr::NBSTOP, vp::Access::read_write, "stop bits: 0 one, 1 one and a half, 2 two"},
    {"CHMODE", mr::CHMODE, vp::Access::read_write,
     "0 normal, 1 echo, 2 local loopback, 3 remote loopback"},
};
#define UART_EVENT_FIELDS(access)                                                                \
  {"RTRIG", event::RTRIG, access, "the receive FIFO filled to RXWM"},                            \
      {"REMPTY", event::REMPTY, access, "the last byte was read from the receive FIFO"},         \
      {"RFUL", event::RFUL, access, "the receive FIFO became full"},                             \
      {"TEMPTY", event::TEMPTY, access, "the last byte left the transmit FIFO for the shifter"}, \
      {"TFUL", event::TFUL, access, "the transmit FIFO became full"},                            \
      {"ROVR", event::ROVR, access, "a byte came with the receive FIFO full, and is lost"},      \
      {"FRAME", event::FRAME, access, "framing error: never on this line"},                      \
      {"PARE", event::PARE, access, "parity error: never on this line"},                         \
      {"TIMEOUT", event::TIMEOUT, access, "nothing came for the time of RXTOUT"},                \
      {"DMSI", event::DMSI, access, "modem status changed: never, no modem lines here"},         \
      {"TTRIG", event::TTRIG, access, "the transmit FIFO filled to TX_FIFO_LEVEL"},              \
      {"TNFUL", event::TNFUL, access, "room for one byte only in the transmit FIFO"}, {          \
    "TOVR", event::TOVR, access, "written with the transmit FIFO full: a byte is lost"           \
  }
inline constexpr vp::RegisterField set_event_fields[] = {UART_EVENT_FIELDS(vp::Access::write_only)};
inline constexpr vp::RegisterField mask_event_fields[] = {UART_EVENT_FIELDS(vp::Access::read_only)};
inline constexpr vp::RegisterField status_event_fields[] = {
    UART_EVENT_FIELDS(vp::Access::write_1_to_clear)};
#undef UART_EVENT_FIELDS
inline constexpr vp::RegisterField modemcr_fields[] = {
    {"DTR", modemcr::DTR, vp::Access::read_write, "stored only"},
    {"RTS", modemcr::RTS, vp::Access::read_write, "stored only"},
    {"FCM", modemcr::FCM, vp::Access::read_write, "automatic flow control: shown in MODEMSR"},
};
inline constexpr vp::RegisterField modemsr_fields[] = {
    {"deltas", modemsr::deltas, vp::Access::write_1_to_clear, "changes of the modem lines"},
    {"FCMS", modemsr::FCMS, vp::Access::read_only, "automatic flow control is on"},
};
inline constexpr vp::RegisterField sr_fields[] = {
    {"RTRIG", sr::RTRIG, vp::Access::read_only, "receive FIFO at RXWM or above (RXWM not 0)"},
    {"REMPTY", sr::REMPTY, vp::Access::read_only, "receive FIFO empty"},
    {"RFUL", sr::RFUL, vp::Access::read_only, "receive FIFO full"},
    {"TEMPTY", sr::TEMPTY, vp::Access::read_only, "transmit FIFO empty"},
    {"TFUL", sr::TFUL, vp::Access::read_only, "transmit FIFO full"},
    {"RACTIVE", sr::RACTIVE, vp::Access::read_only, "a byte is coming"},
    {"TACTIVE", sr::TACTIVE, vp::Access::read_only, "a byte is going"},
    {"FDELT", sr::FDELT, vp::Access::read_only, "receive FIFO at FLOW_DELAY or above (4 or more)"},
    {"TTRIG", sr::TTRIG, vp::Access::read_only, "transmit FIFO at TX_FIFO_LEVEL or above (not 0)"},
    {"TNFUL", sr::TNFUL, vp::Access::read_only, "room for one byte in the transmit FIFO"},
};

/// SR reads 0x0000000A at rest: it shows the FIFOs (both empty), its own bits reset to 0.
inline constexpr vp::RegisterInfo registers[] = {
    {"CR", CR, 0x00000128, vp::Access::read_write, 0x000001FF,
     "Control: enables and resets of receiver and transmitter, break", cr_fields},
    {"MR", MR, 0x00000000, vp::Access::read_write, 0x000003FF,
     "Mode: channel mode, data, parity and stop bits, clock", mr_fields},
    {"IER", IER, 0x00000000, vp::Access::write_only, 0x00001FFF,
     "Interrupt enable: writing 1 sets the bit in IMR", set_event_fields},
    {"IDR", IDR, 0x00000000, vp::Access::write_only, 0x00001FFF,
     "Interrupt disable: writing 1 clears the bit in IMR", set_event_fields},
    {"IMR", IMR, 0x00000000, vp::Access::read_only, 0x00000000, "Events that interrupt",
     mask_event_fields},
    {"ISR", ISR, 0x00000000, vp::Access::write_1_to_clear, 0x00001FFF,
     "Events that happened, whatever IMR says", status_event_fields},
    {"BAUDGEN", BAUDGEN, 0x0000028B, vp::Access::read_write, 0x0000FFFF,
     "Baud rate = reference clock / (BAUDGEN * (BAUD_DIV + 1)); 0 stops"},
    {"RXTOUT", RXTOUT, 0x00000000, vp::Access::read_write, 0x000000FF,
     "Receiver's time-out in units of 4 bits; 0: none"},
    {"RXWM", RXWM, 0x00000020, vp::Access::read_write, 0x0000003F,
     "Fill of the receive FIFO that triggers; 0: none"},
    {"MODEMCR", MODEMCR, 0x00000000, vp::Access::read_write, 0x00000023, "Modem control",
     modemcr_fields},
    {"MODEMSR", MODEMSR, 0x00000000, vp::Access::write_1_to_clear, 0x0000000F, "Modem status",
     modemsr_fields},
    {"SR", SR, 0x00000000, vp::Access::read_only, 0x00000000, "Channel status: FIFOs and shifters",
     sr_fields},
    {"FIFO", FIFO, 0x00000000, vp::Access::read_write, 0x000000FF,
     "Writing sends a byte, reading takes one"},
    {"BAUD_DIV", BAUD_DIV, 0x0000000F, vp::Access::read_write, 0x000000FF,
     "Second divisor of the baud rate, less 1; values below 4 are not taken"},
    {"FLOW_DELAY", FLOW_DELAY, 0x00000000, vp::Access::read_write, 0x0000003F,
     "Fill of the receive FIFO that shows in SR.FDELT; below 4: none"},
    {"TX_FIFO_LEVEL", TX_FIFO_LEVEL, 0x00000020, vp::Access::read_write, 0x0000003F,
     "Fill of the transmit FIFO that triggers; 0: none"},
};

}  // namespace uart
