// Both cores at one list of work: each takes the next item under a lock, and the second one raises
// a software interrupt at the first when the list is done. Its private timer wakes it before each
// item.
#include <apps/common/message.h>
#include <drivers/gic.h>
#include <drivers/timers.h>
#include <hal/hal.h>

#include <gic_registers.h>

#include <cstdint>

namespace {

enum Option : std::uint32_t { items_option, cores_option };
const hal_option_info options[] = {
    {"items", "", 20, 1, 1000, "how long the list is"},
    {"cores", "", 2, 1, 2, "1: the first core does it alone"},
};

constexpr std::uint32_t done_id = 1;  ///< a software interrupt
constexpr std::uint32_t first_core = 1u << 0;
/// 20 us an item, 2 us of rest of the second core.
constexpr std::uint64_t counts_per_us = drivers::GlobalTimer::counts_per_second / 1'000'000;
constexpr std::uint64_t item_counts = 20 * counts_per_us;
constexpr std::uint32_t rest_counts = 2 * counts_per_us;

/// What both cores use, under the lock.
struct List {
  std::uint32_t next, sum;
} list;
hal_lock list_lock = {0, "list"};
std::uint32_t items;

/// What is each core's own, by its number.
struct Core {
  drivers::Gic interrupts;
  std::uint32_t done;
} cores[2];
volatile bool second_done, rested;
const drivers::GlobalTimer global_timer;
drivers::PrivateTimer second_timer;

/// Takes an item off the list, and adds the result of the previous one. False: the list is empty.
bool take(std::uint32_t& item, std::uint32_t result) {
  hal_lock_acquire(&list_lock);
  hal_shared_write(&list, sizeof list);
  list.sum += result;
  item = list.next;
  if (item < items) ++list.next;
  hal_lock_release(&list_lock);
  return item < items;
}

void wait_until(volatile bool& happened) {
  hal_interrupt_enable(false);
  while (!happened) {
    hal_wait_for_interrupt();
    hal_interrupt_enable(true);  // its handler runs here
    hal_interrupt_enable(false);
  }
  happened = false;
  hal_interrupt_enable(true);
}

void rest() {
  second_timer.start(rest_counts);
  wait_until(rested);
}

void work_through_list(void (*before)()) {
  Core& core = cores[hal_cpu_number()];
  for (std::uint32_t item = 0, result = 0; take(item, result); ++core.done) {
    if (before != nullptr) before();
    const std::uint64_t end = global_timer.now() + item_counts;
    while (global_timer.now() < end) {
    }
    result = item * item;
  }
}

void second() {
  Core& core = cores[1];
  core.interrupts.initialise_second();
  core.interrupts.connect(
      gic::private_timer_id, drivers::Trigger::level_high,
      [](void*) {
        second_timer.acknowledge();
        rested = true;
      },
      nullptr);
  second_timer.initialise({});
  hal_interrupt_enable(true);
  work_through_list(&rest);
  drivers::Gic::raise(done_id, first_core);
}

int run() {
  Core& core = cores[0];
  items = static_cast<std::uint32_t>(hal_option(items_option));
  core.interrupts.initialise();
  core.interrupts.connect(
      done_id, drivers::Trigger::rising_edge, [](void*) { second_done = true; }, nullptr);
  hal_interrupt_enable(true);
  global_timer.initialise();
  const std::uint64_t start = global_timer.now();
  const bool both = hal_option(cores_option) == 2;
  if (both) hal_cpu_start(1, &second);
  work_through_list(nullptr);
  if (both) wait_until(second_done);
  const auto us = static_cast<std::uint32_t>((global_timer.now() - start) / counts_per_us);
  apps::Message()
      .text("sum ")
      .number(list.sum)
      .text(", items ")
      .number(cores[0].done)
      .text(" and ")
      .number(cores[1].done)
      .text(", ")
      .number(us)
      .text(" us")
      .write();
  return 0;
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI, "two-cores", &run,    nullptr, 0,
                                      nullptr, 0,           options, 2};
