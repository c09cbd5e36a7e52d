#pragma once

#include <cstdint>

namespace drivers {

struct AxiDmaConfig {
  enum class Channel : std::uint8_t { memory_to_stream, stream_to_memory };

  std::uint32_t base;  ///< bus address
  Channel channel;
  unsigned length_bits = 14;  ///< width of the LENGTH register (Vivado's default)
  std::uint32_t stream_bytes =
      4;  ///< width of the stream; without realignment, addresses are multiples
};

/// One channel of an AXI DMA in direct register mode (PG021).
class AxiDma {
 public:
  /// Resets the core and enables its interrupts. False if the reset did not end within
  /// `reset_polls` reads. Both channels of a core are reset together.
  bool initialise(const AxiDmaConfig& config);

  /// Starts one transfer. False, and nothing started, if the channel is still busy or `address` or
  /// `bytes` do not fit the build.
  bool start(std::uint32_t address, std::uint32_t bytes) const;

  /// Starts the next transfer of a channel whose last one has completed, as acknowledge() told: two
  /// writes. False, and nothing started, if `address` or `bytes` do not fit the build.
  bool start_again(std::uint32_t address, std::uint32_t bytes) const;

  /// Reads the status, clears the interrupts that it shows, returns it.
  std::uint32_t acknowledge() const;

  /// The status register, for messages.
  std::uint32_t status() const;

  /// Bytes of the last packet, once the transfer of a stream into memory has completed.
  std::uint32_t received() const;

  /// Lets a completed transfer interrupt (as after initialise()) or not. One that completed
  /// meanwhile interrupts when this is turned on. Errors always interrupt.
  void set_completion_interrupt(bool on) const;

  static bool is_complete(std::uint32_t status);
  static bool is_error(std::uint32_t status);

  static constexpr unsigned reset_polls = 500;  ///< as the vendor's driver

 private:
  bool fits(std::uint32_t address, std::uint32_t bytes) const;

  struct Registers {
    std::uint32_t control, status, address, length;  ///< bus addresses
  };

  Registers registers_;
  std::uint32_t max_bytes_;
  std::uint32_t stream_bytes_;
};

}  // namespace drivers
