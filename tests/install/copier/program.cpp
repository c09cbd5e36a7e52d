// Copies a buffer with the third DMA engine, then does what the thesis' program does.
#include <apps/common/message.h>
#include <apps/hybrid/application.h>
#include <drivers/axi_dma.h>
#include <marker/work.h>

#include <cstring>

namespace {

hybrid::Application application;

/// How many of `size` bytes arrive as they were.
std::uint32_t copied(std::uint32_t size) {
  using Channel = drivers::AxiDmaConfig::Channel;
  const hal_dma_buffer from = hal_dma_allocate(size, 4), to = hal_dma_allocate(size, 4);
  auto* const source = static_cast<std::uint8_t*>(from.data);
  for (std::uint32_t i = 0; i < size; ++i) source[i] = static_cast<std::uint8_t>(i * 7);
  hal_cache_flush(from.data, size);
  const std::uint32_t base = hal_xpar("AXI_DMA_2_BASEADDR", 0x4042'0000);
  drivers::AxiDma reader, writer;
  if (!reader.initialise({base, Channel::memory_to_stream})) return 0;
  if (!writer.initialise({base, Channel::stream_to_memory})) return 0;
  writer.start(to.bus_address, size);
  reader.start(from.bus_address, size);
  while (!drivers::AxiDma::is_complete(writer.acknowledge())) {
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
                                      "copying",
                                      &run,
                                      marker::work_names,
                                      static_cast<std::uint32_t>(marker::Work::count),
                                      marker::function_names,
                                      static_cast<std::uint32_t>(marker::Function::count),
                                      hybrid::option_table,
                                      hybrid::option_count};
