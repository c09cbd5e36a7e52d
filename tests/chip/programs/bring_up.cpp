// What a program relies on before it does anything of its own: static objects, floating point, DMA
// memory, interrupts. Prints only what must be the same on the virtual platform and on the chip.
#include <apps/common/message.h>
#include <drivers/gic.h>
#include <drivers/timers.h>
#include <gic_registers.h>
#include <hal/hal.h>

#include <cmath>
#include <cstdint>
#include <cstring>

namespace {

using apps::Message;

enum Option : std::uint32_t { rounds_option, factor_option, publish_option };
const hal_option_info options[] = {
    {"rounds", "", 3, 1, 100, "alarms of each kind"},
    {"factor", "", 1.5, -10, 10, "a number"},
    {"publish", "", 0, 0, 1, "1 publishes a result that the virtual platform does not know"},
};

int initialised = 17;
int zero;
struct Constructed {
  Constructed() : value(initialised + 6) {}
  ~Constructed() { value = -1; }
  int value;
};
Constructed constructed;

drivers::Gic interrupt_controller;
drivers::GlobalTimer timer;

volatile std::uint32_t alarms;
volatile double handler_sum;

/// 20 µs: a few thousand instructions.
constexpr std::uint64_t alarm_counts = 20 * (drivers::GlobalTimer::counts_per_second / 1'000'000);

/// Uses floating point: the registers of what it interrupts must survive.
void on_alarm(void*) {
  timer.clear_alarm();
  alarms = alarms + 1;
  double values[8] = {1, 2, 3, 4, 5, 6, 7, 8};
  for (double& value : values) value = std::sqrt(value * alarms);
  double sum = 0;
  for (const double value : values) sum += value;
  handler_sum = handler_sum + sum;
}

double converge(unsigned steps) {
  double a = 1, b = 2, c = 3, d = 4;
  for (unsigned i = 0; i < steps; ++i) {
    a = std::sqrt(a * b + 1);
    b = std::sqrt(b * c + a);
    c = std::sqrt(c * d + b);
    d = std::sqrt(d + a * c);
  }
  return a + b + c + d;
}

void bits(const char* name, double value) {
  std::uint64_t pattern = 0;
  std::memcpy(&pattern, &value, sizeof pattern);
  Message()
      .text(name)
      .text(" ")
      .hexadecimal(static_cast<std::uint32_t>(pattern >> 32))
      .text(" ")
      .hexadecimal(static_cast<std::uint32_t>(pattern))
      .write();
}

void check_statics() {
  Message().text("data ").number(static_cast<std::uint32_t>(initialised)).write();
  Message().text("bss ").number(static_cast<std::uint32_t>(zero)).write();
  Message().text("constructed ").number(static_cast<std::uint32_t>(constructed.value)).write();
  bits("factor", hal_option(factor_option));
}

bool is_valid(const hal_dma_buffer& buffer, std::size_t size, std::size_t alignment) {
  return buffer.data != nullptr && buffer.size == size && buffer.bus_address % alignment == 0 &&
         reinterpret_cast<std::uintptr_t>(buffer.data) == buffer.bus_address;
}

void check_dma_memory() {
  const hal_dma_buffer small = hal_dma_allocate(1, 1);
  const hal_dma_buffer page = hal_dma_allocate(5000, 4096);
  const hal_dma_buffer empty = hal_dma_allocate(0, 64);
  Message()
      .text("dma memory ")
      .number(is_valid(small, 1, 32))
      .number(is_valid(page, 5000, 4096))
      .number(is_valid(empty, 0, 64))
      .write();
  Message()
      .text("refused ")
      .number(hal_dma_allocate(0x4000'0000, 32).data == nullptr)
      .number(hal_dma_allocate(32, 48).data == nullptr)
      .write();

  auto* bytes = static_cast<unsigned char*>(page.data);
  for (unsigned i = 0; i < page.size; ++i) bytes[i] = static_cast<unsigned char>(i * 7);
  hal_cache_flush(page.data, page.size);
  // Inside a line at both ends: the neighbours keep what was written and not flushed.
  bytes[4] = 99;
  bytes[4990] = 98;
  hal_cache_invalidate(bytes + 5, 4980);
  std::uint32_t sum = 0;
  for (unsigned i = 0; i < page.size; ++i) sum = sum * 31 + bytes[i];
  Message().text("bytes ").hexadecimal(sum).write();
}

/// Sleeps until the handler has run. Masked between the look and the sleep: on the chip an
/// interrupt may come between any two instructions, and the sleep would then never end.
void sleep_until_alarm(std::uint32_t before) {
  for (;;) {
    hal_interrupt_enable(false);
    const bool over = alarms != before;
    if (!over) hal_wait_for_interrupt();
    hal_interrupt_enable(true);
    hal_barrier();
    if (over) return;
  }
}

void check_sleep() {
  for (double left = hal_option(rounds_option); left > 0; --left) {
    const std::uint32_t before = alarms;
    const std::uint64_t due = timer.now() + alarm_counts;
    timer.set_alarm(due);
    sleep_until_alarm(before);
    Message().text("slept ").number(alarms).text(timer.now() >= due ? "" : ", too early").write();
  }
}

/// With IRQ masked the sleep ends, too, but the handler waits until it is unmasked.
void check_masked_sleep() {
  const bool was_enabled = hal_interrupt_enable(false);
  const std::uint32_t before = alarms;
  timer.set_alarm(timer.now() + alarm_counts);
  hal_wait_for_interrupt();
  const std::uint32_t masked = alarms - before;
  const bool was_masked = !hal_interrupt_enable(true);
  hal_barrier();
  Message()
      .text("masked ")
      .number(was_enabled)
      .number(was_masked)
      .text(" ")
      .number(masked)
      .text(", unmasked ")
      .number(alarms - before)
      .write();
}

/// The same computation with and without interrupts.
void check_floating_point() {
  const double quiet = converge(20'000);
  bits("quiet", quiet);
  for (double left = hal_option(rounds_option); left > 0; --left) {
    const std::uint32_t before = alarms;
    timer.set_alarm(timer.now() + alarm_counts);
    const bool equal = converge(20'000) == quiet;
    sleep_until_alarm(before);
    Message().text(equal ? "undisturbed " : "disturbed ").number(alarms - before).write();
  }
}

int run() {
  check_statics();
  check_dma_memory();
  hal_interrupt_enable(false);
  interrupt_controller.initialise();
  timer.initialise();
  interrupt_controller.connect(gic::global_timer_id, drivers::Trigger::rising_edge, &on_alarm,
                               nullptr);
  hal_interrupt_enable(true);
  check_sleep();
  check_masked_sleep();
  check_floating_point();
  bits("handlers", handler_sum);
  Message().text("unhandled ").number(interrupt_controller.unhandled()).write();
  hal_interrupt_enable(false);
  hal_interrupt_connect(nullptr, nullptr);
  const std::uint32_t result[] = {1, 2, 3};
  if (hal_option(publish_option) > 0)
    hal_publish(HAL_KIND('T', 'E', 'S', 'T'), result, sizeof result);
  return 7;
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI, "bring_up", &run,    nullptr, 0,
                                      nullptr, 0,          options, 3};
