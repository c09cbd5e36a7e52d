// The console: one of the two UARTs, 115200 baud, 8 data bits, no parity; it sends only.
#include <cstring>

#include <hal/hal.h>
#include <slcr_registers.h>
#include <uart_registers.h>

#include "chip.h"

namespace {

#if CHIP_CONSOLE_UART == 0
constexpr std::uint32_t base = uart::uart0_base;
#else
constexpr std::uint32_t base = uart::uart1_base;
#endif
constexpr std::uint32_t baud = 115'200;
constexpr std::uint32_t samples_per_bit = 7;  ///< BAUD_DIV + 1

volatile std::uint32_t& device(std::uint32_t offset) {
  return chip::device_register(base + offset);
}

/// A field of a register of the SLCR.
std::uint32_t field(std::uint32_t offset, std::uint32_t mask, unsigned shift) {
  return (chip::device_register(slcr::base + offset) & mask) >> shift;
}

/// The UART's clock as the boot loader set it up from the IO PLL.
std::uint32_t reference_clock() {
  using namespace slcr;
  const std::uint32_t multiplier = field(IO_PLL_CTRL, pll_ctrl::PLL_FDIV, pll_ctrl::PLL_FDIV_shift);
  const std::uint32_t divisor = field(UART_CLK_CTRL, clk_ctrl::DIVISOR0, clk_ctrl::DIVISOR0_shift);
  return CHIP_PS_CLOCK / (divisor != 0 ? divisor : 1) * multiplier;
}

char last_sent = 0;

void send(char character) {
  while (device(uart::SR) & uart::sr::TFUL) {
  }
  device(uart::FIFO) = static_cast<unsigned char>(character);
  last_sent = character;
}

}  // namespace

namespace chip {

void initialise_console() {
  constexpr std::uint32_t rate = baud * samples_per_bit;
  const std::uint32_t divisor = (reference_clock() + rate / 2) / rate;
  constexpr std::uint32_t resets = uart::cr::RXRES | uart::cr::TXRES;
  device(uart::CR) = resets;
  while (device(uart::CR) & resets) {
  }
  device(uart::MR) = uart::mr::PAR_none;
  device(uart::BAUDGEN) = divisor != 0 ? divisor : 1;
  device(uart::BAUD_DIV) = samples_per_bit - 1;
  device(uart::CR) = uart::cr::TXEN | uart::cr::RXDIS;
}

void drain_console() {
  constexpr std::uint32_t sending = uart::sr::TEMPTY | uart::sr::TACTIVE;
  while ((device(uart::SR) & sending) != uart::sr::TEMPTY) {
  }
}

}  // namespace chip

// A terminal wants both characters at a line's end, whether the program sends both or not.
extern "C" void hal_console_write(const char* text, size_t length) {
  for (size_t i = 0; i < length; ++i) {
    if (text[i] == '\n' && last_sent != '\r') send('\r');
    send(text[i]);
  }
}
namespace chip {

void print(const char* text) {
  hal_console_write(text, std::strlen(text));
}

void print_number(std::uint32_t value) {
  char digits[10];
  unsigned first = sizeof digits;
  do {
    digits[--first] = static_cast<char>('0' + value % 10);
    value /= 10;
  } while (value != 0);
  hal_console_write(digits + first, sizeof digits - first);
}

void print_hexadecimal(std::uint32_t value) {
  char digits[10] = {'0', 'x'};
  for (unsigned i = 0; i < 8; ++i)
    digits[2 + i] = "0123456789abcdef"[(value >> (28 - 4 * i)) & 0xF];
  hal_console_write(digits, sizeof digits);
}

}  // namespace chip

extern "C" void hal_warn(const char* text) {
  chip::print("warning: ");
  chip::print(text);
  chip::print("\n");
}
