// Mistakes that two cores make together.
#include <hal/hal.h>

#include <cstdint>

namespace {

enum class Mistake {
  none,
  race,
  race_far_apart,
  deadlock,
  starts_twice,
  fault_on_second,
};
const hal_option_info options[] = {{"mistake", "", 0, 0, 5, "what the program does wrong"}};

Mistake mistake;
std::uint32_t shared;
hal_lock first_lock = {0, "first"}, second_lock = {0, "second"};
volatile std::uint32_t done;

/// Some 3 us.
void pass_time() {
  for (int i = 0; i < 100; ++i) hal_barrier();
}

void write_shared() {
  hal_shared_write(&shared, sizeof shared);
  ++shared;
}

void write_guarded() {
  hal_lock_acquire(&first_lock);
  write_shared();
  hal_lock_release(&first_lock);
}

void take_both(hal_lock& one, hal_lock& other) {
  hal_lock_acquire(&one);
  pass_time();
  hal_lock_acquire(&other);
}

void second() {
  switch (mistake) {
    case Mistake::race:
    case Mistake::race_far_apart:
      for (int i = 0; i < 3; ++i) write_shared();
      break;
    case Mistake::deadlock:
      take_both(second_lock, first_lock);
      break;
    case Mistake::fault_on_second:
      *reinterpret_cast<volatile int*>(16) = 1;
      break;
    default:
      write_guarded();
  }
  hal_store_release(&done, 1);
  hal_send_event();
}

int run() {
  mistake = static_cast<Mistake>(hal_option(0));
  write_shared();
  hal_cpu_start(1, &second);
  if (mistake == Mistake::starts_twice) hal_cpu_start(1, &second);
  if (mistake == Mistake::deadlock) take_both(first_lock, second_lock);
  if (mistake == Mistake::race_far_apart) {
    for (int i = 0; i < 100; ++i) pass_time();
  }
  if (mistake == Mistake::race || mistake == Mistake::race_far_apart) {
    write_shared();
  } else {
    write_guarded();
  }
  while (hal_load_acquire(&done) == 0) hal_wait_for_event();
  return 0;
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI, "cores", &run, nullptr, 0, nullptr, 0, options, 1};
