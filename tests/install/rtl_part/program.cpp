// Copies a buffer with the registers and the memory master of the RTL, then does what the thesis'
// program does.
#include <apps/common/message.h>
#include <apps/hybrid/application.h>
#include <marker/work.h>

namespace {

hybrid::Application application;

constexpr std::uint32_t base = 0x43C0'0000, control = 0x00, from_register = 0x10,
                        to_register = 0x18;
constexpr std::uint32_t burst_bytes = 32, done = 2;

/// How many of `size` bytes arrive as they were.
std::uint32_t copied(std::uint32_t size) {
  const hal_dma_buffer from = hal_dma_allocate(size, 32), to = hal_dma_allocate(size, 32);
  auto* const source = static_cast<std::uint8_t*>(from.data);
  for (std::uint32_t i = 0; i < size; ++i) source[i] = static_cast<std::uint8_t>(i * 7);
  hal_cache_flush(from.data, size);
  hal_write32(base + from_register, from.bus_address);
  hal_write32(base + to_register, to.bus_address);
  hal_write32(base + control, size / burst_bytes << 16 | 1);
  while ((hal_read32(base + control) & done) == 0) {
  }
  hal_cache_invalidate(to.data, size);
  std::uint32_t same = 0;
  for (std::uint32_t i = 0; i < size; ++i)
    same += source[i] == static_cast<const std::uint8_t*>(to.data)[i];
  return same;
}

int run() {
  apps::Message().text("bytes copied: ").number(copied(4096)).write();
  return application.run();
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI,
                                      "rtl_copying",
                                      &run,
                                      marker::work_names,
                                      static_cast<std::uint32_t>(marker::Work::count),
                                      marker::function_names,
                                      static_cast<std::uint32_t>(marker::Function::count),
                                      hybrid::option_table,
                                      hybrid::option_count};
