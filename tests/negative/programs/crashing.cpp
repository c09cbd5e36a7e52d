// A PS program that reports its first frame and then does what no processor can: each way of its
// own, in a function that messages name.
#include <hal/hal.h>
#include <marker/result.h>

#include <csetjmp>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>

#include <fenv.h>
#include <pthread.h>
#include <unistd.h>

namespace {

constexpr std::uint32_t control = 0x4120'0000;

const char* const functions[] = {"crash"};

volatile int sink;
volatile bool flag;

// Not volatile: one instruction that reads and writes.
__attribute__((noinline)) void dereference_device() {
  *reinterpret_cast<int*>(std::uintptr_t{control}) += 5;
}

__attribute__((noinline)) void write_null() {
  *reinterpret_cast<volatile int*>(std::uintptr_t{8}) = 1;
}

__attribute__((noinline)) int recurse(int depth) {
  volatile char room[512];
  room[0] = static_cast<char>(depth);
  return flag ? 0 : recurse(depth + 1) + room[0];
}

__attribute__((noinline)) void call_null() {
  void (*volatile function)() = nullptr;
  function();
}

__attribute__((noinline)) void trap() {
  __builtin_trap();
}

__attribute__((noinline)) void divide() {
  volatile int one = 1, zero = 0;
  sink = one / zero;
}

__attribute__((noinline)) void divide_floating() {
  feenableexcept(FE_DIVBYZERO);
  volatile double zero = 0;
  volatile double result = 1 / zero;
  sink = static_cast<int>(result);
}

__attribute__((noinline)) void give_up() {
  std::abort();
}

__attribute__((noinline)) void leave() {
  std::exit(0);
}

__attribute__((noinline)) void leave_at_once() {
  ::_exit(0);
}

__attribute__((noinline)) void leave_for_good() {
  std::_Exit(0);
}

__attribute__((noinline)) void leave_quickly() {
  std::quick_exit(0);
}

__attribute__((noinline)) void double_up() {
  static_cast<void>(!::fork());
}

__attribute__((noinline)) void end_thread() {
  ::pthread_exit(nullptr);
}

__attribute__((noinline)) void throw_through() {
  throw std::runtime_error("oops");
}

void throw_noexcept() noexcept {
  throw_through();
}

__attribute__((noinline)) void publish_nothing() {
  hal_publish(marker::frame_result_kind, reinterpret_cast<const void*>(16), 64);
}

void await_timer(hal_interrupt_handler handler) {
  hal_interrupt_connect(handler, nullptr);
  // Bit 0 enables the interface and the distributor, and interrupt 27 is that of the global timer.
  hal_write32(0xF8F0'0104, 0xFF);
  hal_write32(0xF8F0'0100, 1);
  hal_write32(0xF8F0'1000, 1);
  hal_write32(0xF8F0'1100, 1u << 27);
  hal_write32(0xF8F0'0210, 0);
  hal_write32(0xF8F0'0214, 0);
  hal_write32(0xF8F0'0208, 7);
  hal_wait_for_interrupt();
  hal_interrupt_enable(true);
}

__attribute__((noinline)) void fault_in_handler() {
  await_timer([](void*) { write_null(); });
}

std::jmp_buf way_back;

__attribute__((noinline)) void jump_out_of_handler() {
  if (setjmp(way_back) == 0) await_timer([](void*) { std::longjmp(way_back, 1); });
}

/// Nothing is wrong with that.
__attribute__((noinline)) void jump() {
  if (setjmp(way_back) == 0) std::longjmp(way_back, 1);
}

__attribute__((noinline)) void change_folder() {
  static_cast<void>(!::chdir("/"));
}

__attribute__((noinline)) void destroy_stack() {
  // What lies above belongs to the callers: the way back is lost.
  std::uintptr_t here = 0;
  auto* volatile above = &here;
  for (int i = 0; i < 60; ++i) const_cast<volatile std::uintptr_t*>(above)[i] = 0x1'2345'6789;
}

__attribute__((noinline)) void spin() {
  while (!flag) continue;
}

__attribute__((noinline)) void stand_still() {
  while (true) continue;
}

__attribute__((noinline)) void read_unmapped() {
  hal_read32(0x5000'0000);
}

/// The on-chip memory, where boot leaves it: no mistake.
__attribute__((noinline)) void write_low_memory() {
  *reinterpret_cast<volatile int*>(std::uintptr_t{0x2'0000}) = 1;
}

void (*const ways[])() = {dereference_device,
                          write_null,
                          [] { sink = recurse(0); },
                          call_null,
                          trap,
                          divide,
                          divide_floating,
                          give_up,
                          leave,
                          throw_through,
                          throw_noexcept,
                          publish_nothing,
                          fault_in_handler,
                          destroy_stack,
                          spin,
                          read_unmapped,
                          stand_still,
                          leave_at_once,
                          leave_for_good,
                          leave_quickly,
                          double_up,
                          end_thread,
                          jump_out_of_handler,
                          jump,
                          change_folder,
                          write_low_memory};
constexpr int last_way = sizeof ways / sizeof ways[0] - 1;

const hal_option_info options[] = {{"way", "", 0, 0, last_way, "how the program crashes"}};

int entry() {
  static marker::FrameResult result;
  while (const hal_frame* frame = hal_frame_next()) {
    hal_read32(control);
    if (frame->index == 1) {
      hal_function_enter(0);
      ways[static_cast<int>(hal_option(0))]();
    }
    marker::clear(result);
    result.frame = frame->index;
    hal_publish(marker::frame_result_kind, &result, sizeof result);
  }
  return 0;
}

}  // namespace

extern "C" {
const hal_program hal_program_info = {HAL_ABI,   "crashing", entry,   nullptr, 0,
                                      functions, 1,          options, 1};
}
