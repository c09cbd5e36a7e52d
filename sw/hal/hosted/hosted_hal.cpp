// A program without hardware: console and memory work, everything else says that it is not there.
#include <hal/hal.h>
#include <hal/option_data.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {

constexpr std::size_t dma_bytes = 1 << 20;
constexpr std::size_t cache_line = 32;
alignas(4096) std::array<unsigned char, dma_bytes> dma_memory;
std::size_t dma_used = 0;

constexpr int no_hardware = 3;

[[noreturn]] void refuse(const char* function) {
  std::fprintf(stderr, "%s: there is no hardware here\n", function);
  std::exit(no_hardware);
}

}  // namespace

extern "C" {

uint32_t hal_read32(uint32_t) {
  refuse("hal_read32");
}

void hal_write32(uint32_t, uint32_t) {
  refuse("hal_write32");
}

hal_poll_result hal_poll_until_changed(uint32_t, uint32_t, uint32_t, uint32_t) {
  refuse("hal_poll_until_changed");
}

void hal_barrier(void) {}
void hal_cache_flush(const void*, size_t) {}
void hal_cache_invalidate(void*, size_t) {}

hal_dma_buffer hal_dma_allocate(size_t size, size_t alignment) {
  hal_dma_buffer buffer{nullptr, 0, size};
  if (alignment == 0 || (alignment & (alignment - 1)) != 0) return buffer;
  const std::size_t step = alignment > cache_line ? alignment : cache_line;
  const std::size_t start = (dma_used + step - 1) / step * step;
  if (step > 4096 || start > dma_bytes || size > dma_bytes - start) return buffer;
  dma_used = start + (size > 0 ? size : 1);
  buffer.data = dma_memory.data() + start;
  buffer.bus_address = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(buffer.data));
  return buffer;
}

void hal_interrupt_connect(hal_interrupt_handler, void*) {}

bool hal_interrupt_enable(bool) {
  return false;
}

void hal_wait_for_interrupt(void) {
  refuse("hal_wait_for_interrupt");
}

unsigned hal_cpu_number(void) {
  return 0;
}

void hal_cpu_start(unsigned, void (*)(void)) {
  refuse("hal_cpu_start");
}

void hal_wait_for_event(void) {
  refuse("hal_wait_for_event");
}

void hal_send_event(void) {}

uint32_t hal_load_acquire(const volatile uint32_t* word) {
  return *word;
}

void hal_store_release(volatile uint32_t* word, uint32_t value) {
  *word = value;
}

uint32_t hal_load_exclusive(const volatile uint32_t* word) {
  return *word;
}

bool hal_store_exclusive(volatile uint32_t* word, uint32_t value) {
  *word = value;
  return true;
}

void hal_lock_acquire(hal_lock*) {}
void hal_lock_release(hal_lock*) {}

void hal_console_write(const char* text, size_t length) {
  std::fwrite(text, 1, length, stdout);
}

void hal_warn(const char* text) {
  std::fprintf(stderr, "warning: %s\n", text);
}

const hal_frame* hal_frame_next(void) {
  return nullptr;
}

void hal_publish(uint32_t, const void*, size_t) {}

double hal_option(uint32_t option) {
  if (option >= hal_program_info.option_count) refuse("hal_option");
  return hal_program_info.options[option].default_value;
}

const void* hal_option_data(uint32_t, size_t* size) {
  *size = 0;
  return nullptr;
}

}  // extern "C"

int main() {
  return hal_program_info.entry();
}
