// Cache maintenance by address, in both levels.
#include <hal/hal.h>

#include "device_register.h"
#include "pl310.h"

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

}  // extern "C"
