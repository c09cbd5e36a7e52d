#include <axi_dma_registers.h>
#include <drivers/axi_dma.h>
#include <hal/hal.h>

namespace drivers {

bool AxiDma::initialise(const AxiDmaConfig& config) {
  const std::uint32_t base = config.base;
  if (config.channel == AxiDmaConfig::Channel::memory_to_stream) {
    registers_ = {base + axi_dma::MM2S_DMACR, base + axi_dma::MM2S_DMASR, base + axi_dma::MM2S_SA,
                  base + axi_dma::MM2S_LENGTH};
  } else {
    registers_ = {base + axi_dma::S2MM_DMACR, base + axi_dma::S2MM_DMASR, base + axi_dma::S2MM_DA,
                  base + axi_dma::S2MM_LENGTH};
  }
  max_bytes_ = (1u << config.length_bits) - 1;
  stream_bytes_ = config.stream_bytes;

  hal_write32(registers_.control, axi_dma::dmacr::Reset);
  unsigned polls = 0;
  while (hal_read32(registers_.control) & axi_dma::dmacr::Reset) {
    if (++polls == reset_polls) return false;
  }
  hal_write32(registers_.control, axi_dma::dmacr::IOC_IrqEn | axi_dma::dmacr::Err_IrqEn);
  return true;
}

bool AxiDma::fits(std::uint32_t address, std::uint32_t bytes) const {
  return bytes != 0 && bytes <= max_bytes_ && address % stream_bytes_ == 0;
}

bool AxiDma::start_again(std::uint32_t address, std::uint32_t bytes) const {
  if (!fits(address, bytes)) return false;
  hal_write32(registers_.address, address);
  hal_write32(registers_.length, bytes);
  return true;
}

bool AxiDma::start(std::uint32_t address, std::uint32_t bytes) const {
  if (!fits(address, bytes)) return false;
  // A channel that runs is not idle before its first transfer either: its halt bit tells the two
  // apart.
  const std::uint32_t status = hal_read32(registers_.status);
  if (!(status & (axi_dma::dmasr::Halted | axi_dma::dmasr::Idle))) return false;
  hal_write32(registers_.address, address);
  hal_write32(registers_.control, hal_read32(registers_.control) | axi_dma::dmacr::RS);
  hal_write32(registers_.length, bytes);
  return true;
}

std::uint32_t AxiDma::acknowledge() const {
  const std::uint32_t status = hal_read32(registers_.status);
  hal_write32(registers_.status, status & axi_dma::dmasr::interrupts);
  return status;
}

std::uint32_t AxiDma::status() const {
  return hal_read32(registers_.status);
}

std::uint32_t AxiDma::received() const {
  return hal_read32(registers_.length);
}

void AxiDma::set_completion_interrupt(bool on) const {
  const std::uint32_t control = hal_read32(registers_.control);
  hal_write32(registers_.control,
              on ? control | axi_dma::dmacr::IOC_IrqEn : control & ~axi_dma::dmacr::IOC_IrqEn);
}

bool AxiDma::is_complete(std::uint32_t status) {
  return status & axi_dma::dmasr::IOC_Irq;
}

bool AxiDma::is_error(std::uint32_t status) {
  return status & (axi_dma::dmasr::errors | axi_dma::dmasr::Err_Irq);
}

}  // namespace drivers
