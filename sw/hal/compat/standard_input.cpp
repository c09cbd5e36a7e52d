// inbyte() of xil_printf.h, and what the boot code does for it.
#include <hal/hal.h>
#include <uart_registers.h>
#include <xil_printf.h>

namespace {

constexpr std::uint32_t stdin_at(std::uint32_t offset) {
  return STDOUT_BASEADDRESS + offset;
}

}  // namespace

extern "C" {

/// Of c_input.cpp, where the program reads by the C library.
void markervp_open_input() __attribute__((weak));

/// The vendor's boot code leaves the UART of standard input on, 115 200 baud of 50 MHz, 8N1. The
/// platform calls this before the entry function of a program that reads it, so that nothing is
/// lost of what comes before its first read.
HAL_EXPORT void markervp_boot() {
  static bool done = false;
  if (done) return;
  done = true;
  if (markervp_open_input) markervp_open_input();
  const std::uint32_t control = hal_read32(stdin_at(uart::CR));
  if ((control & uart::cr::RXEN) && !(control & uart::cr::RXDIS)) return;
  if (!(control & uart::cr::TXEN) || (control & uart::cr::TXDIS)) {
    hal_write32(stdin_at(uart::MR), uart::mr::PAR_none);
    hal_write32(stdin_at(uart::BAUDGEN), 62);
    hal_write32(stdin_at(uart::BAUD_DIV), 6);
  }
  hal_write32(stdin_at(uart::CR), (control & ~std::uint32_t{uart::cr::RXDIS}) | uart::cr::RXEN);
}

char inbyte(void) {
  markervp_boot();  // if not done yet: on the chip without boot code, or in a linked program
  while (hal_read32(stdin_at(uart::SR)) & uart::sr::REMPTY) {
  }
  return static_cast<char>(hal_read32(stdin_at(uart::FIFO)));
}

}  // extern "C"
