// Registers, barriers, and cache maintenance by address in both levels.
#include <hal/hal.h>

#include "chip.h"

namespace {

using namespace chip;

struct Lines {
  std::uintptr_t first, end;  ///< whole lines
};

Lines lines_of(const void* data, std::size_t size) {
  const auto address = reinterpret_cast<std::uintptr_t>(data);
  if (size == 0) return {address, address};
  return {address / cache_line * cache_line,
          (address + size + cache_line - 1) / cache_line * cache_line};
}

void l2_sync() {
  device_register(pl310::cache_sync) = 0;
  barrier();
}

void clean_l1(std::uintptr_t line) {
  asm volatile("mcr p15, 0, %0, c7, c10, 1" ::"r"(line) : "memory");  // DCCMVAC
}

void invalidate_l1(std::uintptr_t line) {
  asm volatile("mcr p15, 0, %0, c7, c6, 1" ::"r"(line) : "memory");  // DCIMVAC
}

/// A line that also holds bytes of others loses none of them.
void clean_shared_line(std::uintptr_t line) {
  clean_l1(line);
  barrier();
  device_register(pl310::clean_line) = line;
  l2_sync();
}

}  // namespace

extern "C" {

void hal_cache_flush(const void* data, size_t size) {
  const Lines lines = lines_of(data, size);
  barrier();
  for (std::uintptr_t line = lines.first; line != lines.end; line += cache_line) clean_l1(line);
  barrier();
  for (std::uintptr_t line = lines.first; line != lines.end; line += cache_line) {
    device_register(pl310::clean_line) = line;
  }
  l2_sync();
}

// The outer level first: the inner one could otherwise fetch the old contents once more.
void hal_cache_invalidate(void* data, size_t size) {
  const Lines lines = lines_of(data, size);
  const std::uintptr_t end = reinterpret_cast<std::uintptr_t>(data) + size;
  if (lines.first != reinterpret_cast<std::uintptr_t>(data)) clean_shared_line(lines.first);
  if (lines.end != end) clean_shared_line(lines.end - cache_line);
  barrier();
  for (std::uintptr_t line = lines.first; line != lines.end; line += cache_line) {
    device_register(pl310::invalidate_line) = line;
  }
  l2_sync();
  for (std::uintptr_t line = lines.first; line != lines.end; line += cache_line) {
    invalidate_l1(line);
  }
  barrier();
}

uint32_t hal_read32(uint32_t address) {
  const uint32_t value = chip::device_register(address);
  chip::barrier();
  return value;
}

void hal_write32(uint32_t address, uint32_t value) {
  chip::barrier();
  chip::device_register(address) = value;
  chip::barrier();
}

hal_poll_result hal_poll_until_changed(uint32_t address, uint32_t previous, uint32_t,
                                       uint32_t limit) {
  hal_poll_result result{previous, 0, false};
  while (result.polls < limit && !result.changed) {
    result.value = chip::device_register(address);
    ++result.polls;
    result.changed = result.value != previous;
  }
  chip::barrier();
  return result;
}

void hal_barrier(void) {
  chip::barrier();
}

}  // extern "C"
