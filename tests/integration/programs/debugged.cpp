// A PS program to stop in: its variables say how far it is.
#include <hal/hal.h>

#include <axi_gpio_registers.h>
#include <drivers/platform_addresses.h>

#include <cstdint>

namespace {

enum class End { well, data_abort, segmentation_fault };
const hal_option_info options[] = {{"end", "well|data_abort|segmentation_fault", 0, 0, 2, ""}};

volatile unsigned stage;

std::uint32_t output() {
  return drivers::addresses::gpio_control() + axi_gpio::GPIO_DATA;
}

[[gnu::noinline]] void write(std::uint32_t value) {
  stage = value;
  hal_write32(output(), value << 8);  // the threshold, without wr_thresh
}

[[gnu::noinline]] void rest() {
  stage = 100;
  hal_poll_until_changed(output(), 0x300, 100, 1000);
  stage = 200;
}

[[gnu::noinline]] void fail(End end) {
  if (end == End::data_abort) hal_read32(0x5000'0000);
  if (end == End::segmentation_fault) *reinterpret_cast<volatile int*>(std::uintptr_t{8}) = 1;
}

int run() {
  for (unsigned i = 1; i <= 3; ++i) write(i);
  hal_warn("the first");
  rest();
  hal_warn("the second");
  fail(static_cast<End>(hal_option(0)));
  return 0;
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI, "debugged", run, nullptr, 0, nullptr, 0, options, 1};
