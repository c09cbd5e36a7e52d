// DMA memory, handed out front to back as on the virtual platform: the same addresses there.
#include <hal/hal.h>

#include "device_register.h"
#include "memory_map.h"

namespace {

std::uint64_t next = CHIP_DMA_FIRST;

constexpr std::uint64_t round_up(std::uint64_t value, std::uint64_t power_of_two) {
  return (value + power_of_two - 1) & ~(power_of_two - 1);
}

}  // namespace

extern "C" hal_dma_buffer hal_dma_allocate(size_t size, size_t alignment) {
  hal_dma_buffer buffer{nullptr, 0, size};
  if (alignment == 0 || (alignment & (alignment - 1)) != 0) return buffer;
  const std::uint64_t line = chip::cache_line;
  const std::uint64_t start = round_up(next, alignment > line ? alignment : line);
  // An empty buffer has an address of its own, too.
  const std::uint64_t end = start + round_up(size > 0 ? size : 1, line);
  if (end > CHIP_DDR_END) return buffer;
  next = end;
  buffer.bus_address = static_cast<std::uint32_t>(start);
  buffer.data = reinterpret_cast<void*>(buffer.bus_address);
  return buffer;
}
