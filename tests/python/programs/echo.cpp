// Answers what is typed into UART 0, and counts a button that is wired to interrupt 63, until "q"
// is typed.
#include <drivers/gic.h>
#include <drivers/uart.h>
#include <hal/hal.h>
#include <uart_registers.h>

namespace {

constexpr std::uint32_t button = 63;

drivers::Gic interrupts;
drivers::Uart uart0;
volatile std::uint32_t presses;

void pressed(void*) {
  presses = presses + 1;
}

int run() {
  interrupts.initialise();
  if (!interrupts.connect(button, drivers::Trigger::rising_edge, pressed, nullptr)) return 1;
  hal_interrupt_enable(true);
  if (!uart0.initialise({uart::uart0_base})) return 1;
  hal_console_write("ready\n", 6);
  std::uint32_t told = 0;
  for (;;) {
    std::uint8_t key = 0;
    if (presses != told) {
      told = presses;
      hal_console_write("pressed\n", 8);
    }
    if (!uart0.try_get(key)) continue;
    if (key == 'f') return 1;
    if (key == 'q') break;
    const std::uint8_t line[] = {'<', key, '>', '\n'};
    uart0.write(line, sizeof line);
  }
  while (!uart0.is_idle()) {
  }
  hal_interrupt_enable(false);
  return 0;
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI, "echo", &run, nullptr, 0, nullptr, 0, nullptr, 0};
