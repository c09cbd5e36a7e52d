#include <axi_dma_registers.h>
#include <drivers/axi_dma.h>
#include <drivers/axi_dma_ring.h>

namespace drivers {
namespace {

namespace word = axi_dma::descriptor;

std::uint32_t& at(std::uint32_t* descriptor, std::uint32_t offset) {
  return descriptor[offset / sizeof(std::uint32_t)];
}

}  // namespace

std::uint32_t* AxiDmaRing::descriptor(std::uint32_t number) const {
  auto* const bytes = static_cast<std::uint8_t*>(config_.descriptors.data);
  return reinterpret_cast<std::uint32_t*>(bytes + number % count_ * word::alignment);
}

std::uint32_t AxiDmaRing::bus_address(std::uint32_t number) const {
  return config_.descriptors.bus_address + number % count_ * word::alignment;
}

bool AxiDmaRing::initialise(const AxiDmaRingConfig& config) {
  config_ = config;
  given_ = taken_ = 0;
  count_ = static_cast<std::uint32_t>(config.descriptors.size / word::alignment);
  if (config.descriptors.data == nullptr || count_ == 0) return false;
  const std::uint32_t control = config.base + axi_dma::S2MM_DMACR;
  hal_write32(control, axi_dma::dmacr::Reset);
  for (unsigned polls = 0; hal_read32(control) & axi_dma::dmacr::Reset;) {
    if (++polls == AxiDma::reset_polls) return false;
  }
  for (std::uint32_t i = 0; i < count_; ++i) {
    at(descriptor(i), word::NXTDESC) = bus_address(i + 1);
    at(descriptor(i), word::NXTDESC_MSB) = 0;
    at(descriptor(i), word::BUFFER_ADDRESS_MSB) = 0;
    at(descriptor(i), word::STATUS) = 0;
  }
  hal_cache_flush(config.descriptors.data, config.descriptors.size);
  hal_write32(config.base + axi_dma::S2MM_CURDESC, bus_address(0));
  hal_write32(control, axi_dma::dmacr::RS | axi_dma::dmacr::IOC_IrqEn | axi_dma::dmacr::Err_IrqEn |
                           1u << axi_dma::dmacr::IRQThreshold_shift);
  return true;
}

bool AxiDmaRing::give(std::uint32_t address, std::uint32_t bytes) {
  const std::uint32_t longest = (1u << config_.length_bits) - 1;
  if (bytes == 0 || bytes > longest || address % config_.stream_bytes != 0) return false;
  if (given_ - taken_ == count_) return false;
  std::uint32_t* const next = descriptor(given_);
  at(next, word::BUFFER_ADDRESS) = address;
  at(next, word::CONTROL) = bytes;
  at(next, word::STATUS) = 0;
  hal_cache_flush(next, word::bytes);
  hal_write32(config_.base + axi_dma::S2MM_TAILDESC, bus_address(given_));
  ++given_;
  return true;
}

bool AxiDmaRing::take(Packet& packet) {
  if (taken_ == given_) return false;
  std::uint32_t* const oldest = descriptor(taken_);
  hal_cache_invalidate(oldest, word::bytes);
  const std::uint32_t status = at(oldest, word::STATUS);
  if (!(status & word::Cmplt)) return false;
  constexpr std::uint32_t ends = word::StartOfFrame | word::EndOfFrame;
  constexpr std::uint32_t errors = word::DMAIntErr | word::DMASlvErr | word::DMADecErr;
  packet = {at(oldest, word::BUFFER_ADDRESS), status & word::length,
            (status & (ends | errors)) == ends};
  ++taken_;
  return true;
}

std::uint32_t AxiDmaRing::acknowledge() const {
  const std::uint32_t found = status();
  hal_write32(config_.base + axi_dma::S2MM_DMASR, found & axi_dma::dmasr::interrupts);
  return found;
}

std::uint32_t AxiDmaRing::status() const {
  return hal_read32(config_.base + axi_dma::S2MM_DMASR);
}

}  // namespace drivers
