#pragma once

#include <hal/hal.h>

#include <cstdint>

namespace drivers {

struct AxiDmaRingConfig {
  std::uint32_t base;  ///< bus address of the core
  hal_dma_buffer
      descriptors;            ///< their number: as many as fit, axi_dma::descriptor::alignment each
  unsigned length_bits = 14;  ///< width of a descriptor's length (Vivado's default)
  std::uint32_t stream_bytes = 4;  ///< width of the stream: what addresses are multiples of
};

/// The write channel of an AXI DMA with scatter-gather (PG021): buffers wait in a ring of
/// descriptors, and each packet of the stream takes the next one.
class AxiDmaRing {
 public:
  /// What became of a buffer.
  struct Packet {
    std::uint32_t address;  ///< of the buffer
    std::uint32_t bytes;    ///< that are in it
    bool whole;             ///< the packet begins and ends in it, and no error was met
  };

  /// Resets the core, links the descriptors and enables interrupts, one a packet. False if the
  /// reset did not end within AxiDma::reset_polls reads, or there is no room for a descriptor.
  bool initialise(const AxiDmaRingConfig& config);

  /// Gives a buffer for a packet. False, and nothing given, if all descriptors are, or `address` or
  /// `bytes` do not fit the build.
  bool give(std::uint32_t address, std::uint32_t bytes);

  /// The buffer that was given first and not taken yet. False if its packet is not there.
  bool take(Packet& packet);

  /// Reads the status, clears the interrupts that it shows, returns it.
  std::uint32_t acknowledge() const;

  /// The status register, for messages.
  std::uint32_t status() const;

 private:
  std::uint32_t* descriptor(std::uint32_t number) const;
  std::uint32_t bus_address(std::uint32_t number) const;

  AxiDmaRingConfig config_;
  std::uint32_t count_;          ///< descriptors
  std::uint32_t given_, taken_;  ///< since initialise()
};

}  // namespace drivers
