// Sends each packet that comes from the logic back, every word one more, until one begins with 0.
#include <axi_dma_registers.h>
#include <drivers/axi_dma.h>
#include <hal/hal.h>

#include <cstdint>

namespace {

using Channel = drivers::AxiDmaConfig::Channel;

constexpr std::uint32_t dma_base = 0x4040'0000, most = 1024;  // bytes of a packet

int run() {
  hal_console_write("up\n", 3);
  drivers::AxiDma to_memory, from_memory;
  if (!to_memory.initialise({dma_base, Channel::stream_to_memory}) ||
      !from_memory.initialise({dma_base, Channel::memory_to_stream}))
    return 1;
  const hal_dma_buffer buffer = hal_dma_allocate(most, 32);
  if (!buffer.data) return 1;
  auto* const words = static_cast<std::uint32_t*>(buffer.data);
  for (;;) {
    hal_cache_invalidate(words, most);
    to_memory.start(buffer.bus_address, most);
    std::uint32_t status = 0;
    while (!drivers::AxiDma::is_complete(status = to_memory.acknowledge())) {
      if (drivers::AxiDma::is_error(status)) return 1;
    }
    const std::uint32_t bytes = to_memory.received();
    hal_cache_invalidate(words, most);
    if (words[0] == 0) return 0;
    for (std::uint32_t i = 0; i < bytes / 4; ++i) ++words[i];
    hal_cache_flush(words, bytes);
    from_memory.start(buffer.bus_address, bytes);
    while (!drivers::AxiDma::is_complete(status = from_memory.acknowledge())) {
      if (drivers::AxiDma::is_error(status)) return 1;
    }
  }
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI, "increment", &run,    nullptr, 0,
                                      nullptr, 0,           nullptr, 0};
