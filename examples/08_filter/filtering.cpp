// Sends blocks through the filter and compares what comes back with what it computes itself. A
// block is an input, or without one a ramp: three of them.
#include <axi_dma_registers.h>
#include <drivers/axi_dma.h>
#include <drivers/timers.h>
#include <hal/hal.h>

#include <cstdint>
#include <cstring>

#include "fir.h"

namespace {

using Channel = drivers::AxiDmaConfig::Channel;

constexpr std::uint32_t bytes = fir::block_words * sizeof(std::uint32_t);

drivers::AxiDma to_filter, from_filter;
drivers::GlobalTimer timer;
fir::Filter expected;

bool wait_for(drivers::AxiDma& dma) {
  std::uint32_t status = 0;
  while (!drivers::AxiDma::is_complete(status = dma.acknowledge())) {
    if (drivers::AxiDma::is_error(status)) return false;
  }
  return true;
}

bool filter(std::uint32_t index, std::uint32_t* in, std::uint32_t in_address, std::uint32_t* out,
            std::uint32_t out_address) {
  fir::Result result{index, 0, 0, 0, timer.now()};
  hal_cache_flush(in, bytes);
  hal_cache_invalidate(out, bytes);
  from_filter.start(out_address, bytes);
  to_filter.start(in_address, bytes);
  if (!wait_for(to_filter) || !wait_for(from_filter)) return false;
  hal_cache_invalidate(out, bytes);
  result.words = from_filter.received() / sizeof(std::uint32_t);
  for (std::uint32_t i = 0; i < result.words; ++i) {
    if (out[i] != expected.next(in[i], 1)) ++result.wrong;
    if (out[i] > result.peak) result.peak = out[i];
  }
  result.cycles = timer.now() - result.cycles;
  hal_publish(fir::result_kind, &result, sizeof result);
  return true;
}

int run() {
  timer.initialise();
  if (!to_filter.initialise({fir::dma_in, Channel::memory_to_stream}) ||
      !from_filter.initialise({fir::dma_out, Channel::stream_to_memory}))
    return 1;
  const hal_dma_buffer in = hal_dma_allocate(bytes, 32), out = hal_dma_allocate(bytes, 32);
  if (!in.data || !out.data) return 1;
  auto* const words = static_cast<std::uint32_t*>(in.data);
  auto* const filtered = static_cast<std::uint32_t*>(out.data);
  while (const hal_frame* block = hal_frame_next()) {
    if (block->width == 0) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        for (std::uint32_t i = 0; i < fir::block_words; ++i) words[i] = k * i;
        if (!filter(k, words, in.bus_address, filtered, out.bus_address)) return 1;
      }
      continue;
    }
    std::memcpy(words, block->pixels, bytes);
    if (!filter(block->index, words, in.bus_address, filtered, out.bus_address)) return 1;
  }
  return 0;
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI, "filtering", &run,    nullptr, 0,
                                      nullptr, 0,           nullptr, 0};
