// A PS program that reports its first frame and then does not end, and lets no simulated time pass:
// each way of its own.
#include <hal/hal.h>
#include <marker/result.h>

#include <cstdint>
#include <cstdlib>

#include <unistd.h>

namespace {

const char* const functions[] = {"endless"};

volatile bool flag;
volatile int sink;

/// Code that the compiler does not prepare for the platform, as that of a foreign library.
#define FOREIGN __attribute__((noinline, no_sanitize_coverage))

FOREIGN void compute() {
  while (!flag) sink = sink + 1;
}

FOREIGN void call_hal() {
  while (!flag) hal_option(0);
}

void (*const ways[])() = {[] {
                            for (;;) hal_dma_allocate(0, 32);
                          },
                          [] {
                            for (;;) hal_option(0);
                          },
                          [] {
                            for (;;) hal_console_write("", 0);
                          },
                          [] {
                            for (;;) hal_interrupt_connect(nullptr, nullptr);
                          },
                          [] {
                            for (;;) hal_interrupt_enable(false);
                          },
                          [] {
                            for (;;) hal_poll_until_changed(0x4121'0000, 0, 0, 0);
                          },
                          [] {
                            for (;;) {
                              hal_function_enter(0);
                              hal_function_leave();
                            }
                          },
                          [] {
                            for (;;) hal_cache_flush(nullptr, 0);
                          },
                          [] {
                            for (;;) hal_function_enter(0);
                          },
                          [] {
                            for (;;) ::usleep(1000);
                          },
                          [] {
                            for (;;) ::pause();
                          },
                          compute, call_hal,
                          // Time passes here, for as long as the time-out says.
                          [] {
                            for (;;) hal_read32(0x4120'0000);
                          }};
constexpr int last_way = sizeof ways / sizeof ways[0] - 1;

const hal_option_info options[] = {{"way", "", 0, 0, last_way, "how the program does not end"}};

int entry() {
  static marker::FrameResult result;
  while (const hal_frame* frame = hal_frame_next()) {
    if (frame->index == 1) ways[static_cast<int>(hal_option(0))]();
    marker::clear(result);
    result.frame = frame->index;
    hal_publish(marker::frame_result_kind, &result, sizeof result);
  }
  return 0;
}

}  // namespace

extern "C" {
const hal_program hal_program_info = {HAL_ABI,   "endless", entry,   nullptr, 0,
                                      functions, 1,         options, 1};
}
