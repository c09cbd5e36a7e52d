// Gives a DMA an address where no memory is, and asks for more DMA memory than there is.
#include <hal/hal.h>

#include <axi_dma_registers.h>
#include <drivers/axi_dma.h>
#include <drivers/platform_addresses.h>
#include <cstring>

namespace {

constexpr std::uint32_t outside = 0x8000'0000;  // in the range of GP1, where HP0 has nothing
constexpr std::size_t too_much = std::size_t{1} << 31;

void print(const char* text) {
  hal_console_write(text, std::strlen(text));
}

int run() {
  drivers::AxiDma dma;
  const bool ready = dma.initialise(
      {drivers::addresses::dma_image(), drivers::AxiDmaConfig::Channel::memory_to_stream});
  if (!ready || !dma.start(outside, 64)) return 1;
  std::uint32_t status = dma.status();
  while (!drivers::AxiDma::is_error(status) && !drivers::AxiDma::is_complete(status)) {
    status = dma.status();
  }
  print((status & axi_dma::dmasr::DMADecErr) != 0 ? "DMADecErr 1\n" : "DMADecErr 0\n");
  print(hal_dma_allocate(too_much, 32).data == nullptr ? "more than there is: refused\n"
                                                       : "more than there is: given\n");
  return 0;
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI, "dma_outside", run, nullptr, 0, nullptr,
                                      0,       nullptr,       0};
