// A first PS program: it says hello, toggles an output, and counts the interrupts of a timer.
//
// It is ordinary C++ that runs natively, and it reaches the hardware through <hal/hal.h> alone: the
// drivers below do, too. A pointer to a device's address would point into the simulator, not to the
// device. The same file is meant for the chip, where the HAL is a few lines of bare metal.
#include <hal/hal.h>
#include <xil_printf.h>

#include <drivers/axi_gpio.h>
#include <drivers/gic.h>
#include <drivers/platform_addresses.h>
#include <drivers/timers.h>
#include <gic_registers.h>

namespace {

// The control packet's field `threshold` is a place to play: the programmable logic looks at it
// only when another bit (wr_thresh) is raised.
constexpr std::uint32_t led = 1u << 8;

// The Cortex-A9's private timer counts every second CPU cycle.
constexpr std::uint32_t counts_per_ms = 333'333;
constexpr unsigned ticks_wanted = 3;

// Static variables are what they were after loading, in every run.
drivers::AxiGpio gpio;
drivers::Gic gic;
drivers::GlobalTimer stopwatch;
drivers::PrivateTimer timer;

// Shared with the handler: volatile, since on the chip it may change between any two instructions.
volatile unsigned ticks;

// Runs in interrupt context. It takes the reason away, or the interrupt would come again at once.
void on_tick(void*) {
  timer.acknowledge();
  gpio.write(++ticks % 2 != 0 ? led : 0);
}

void set_up() {
  stopwatch.initialise();
  gpio.initialise({drivers::addresses::gpio_control(), 0});  // no bit is an input
  gic.initialise();
  gic.connect(gic::private_timer_id, drivers::Trigger::rising_edge, &on_tick, nullptr);
  timer.initialise({1, true, true});  // every tick, again and again, with interrupt
}

// Sleeps until there were `count` ticks. IRQ is masked between the look at `ticks` and the sleep:
// otherwise a tick could slip in between, and nothing would wake us. A masked interrupt still ends
// the sleep; its handler runs when IRQ is unmasked.
void wait_for_ticks(unsigned count) {
  while (true) {
    hal_interrupt_enable(false);
    const bool over = ticks >= count;
    if (!over) hal_wait_for_interrupt();
    hal_interrupt_enable(true);
    if (over) return;
  }
}

// The program. What it returns becomes part of the run's result; other than 0 is a failed run.
int run() {
  xil_printf("hello from the processing system\n");
  set_up();
  gpio.write(led);
  gpio.write(0);
  xil_printf("toggled an output, now waiting for the timer\n");

  const std::uint64_t start = stopwatch.now();
  timer.start(counts_per_ms);
  for (unsigned tick = 1; tick <= ticks_wanted; ++tick) {
    wait_for_ticks(tick);
    const std::uint64_t us =
        (stopwatch.now() - start) * 1'000'000 / drivers::GlobalTimer::counts_per_second;
    xil_printf("interrupt %u after %u us\n", tick, static_cast<unsigned>(us));
  }

  timer.stop();
  hal_interrupt_enable(false);
  hal_interrupt_connect(nullptr, nullptr);
  return gic.unhandled() == 0 ? 0 : 1;
}

}  // namespace

// What the loader looks for: name and entry. The three tables name units of work, functions and
// options (docs/software.md); a first program has none.
const hal_program hal_program_info = {HAL_ABI, "first", run, nullptr, 0, nullptr, 0, nullptr, 0};
