#pragma once

#include <cstddef>
#include <cstdint>

namespace drivers {

struct UartConfig {
  std::uint32_t base;                   ///< bus address
  std::uint32_t clock_hz = 50'000'000;  ///< of the reference clock (SLCR UART_CLK_CTRL)
  std::uint32_t baud = 115'200;
};

/// A UART of the Zynq-7000's I/O peripherals (UG585 chapter 19): 8 data bits, no parity, 1 stop
/// bit.
class Uart {
 public:
  /// Resets it, sets the baud rate, switches receiver and transmitter on; no interrupts. False, and
  /// nothing changed, if no divisors come within 3 % of the baud rate.
  bool initialise(const UartConfig& config);

  /// Puts a byte into the transmit FIFO; false if it is full.
  bool try_put(std::uint8_t byte) const;
  /// Takes a byte from the receive FIFO; false if it is empty.
  bool try_get(std::uint8_t& byte) const;

  /// Sends all bytes; waits as long as the FIFO is full.
  void write(const void* data, std::size_t size) const;
  /// Takes what has come, at most `size` bytes; returns how many.
  std::size_t read(void* data, std::size_t size) const;
  /// True if everything has left.
  bool is_idle() const;

  /// Interrupts for `events` (uart::event) and no others; the receive FIFO triggers at
  /// `receive_level` bytes (1 … 63).
  void enable_interrupts(std::uint32_t events, unsigned receive_level = 1) const;
  /// Reads the events that happened, clears them, returns them.
  std::uint32_t acknowledge() const;
  /// Empties both FIFOs: after an overflow.
  void reset() const;

 private:
  std::uint32_t at(std::uint32_t offset) const { return base_ + offset; }

  std::uint32_t base_;
};

}  // namespace drivers
