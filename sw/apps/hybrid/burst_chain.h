#pragma once

#include <drivers/axi_dma.h>

#include <cstdint>

namespace hybrid {

/// A long transfer as a chain of DMA bursts of equal size: the interrupt of one starts the next
/// (thesis 4.5.1).
class BurstChain {
 public:
  /// False if the DMA does not leave reset.
  bool initialise(const drivers::AxiDmaConfig& config, std::uint32_t burst_bytes) {
    burst_bytes_ = burst_bytes;
    return dma_.initialise(config);
  }

  /// What the interrupt of the last burst does, which has no next one to start.
  enum class LastInterrupt {
    comes,
    waits,  ///< for release_last(), so that it takes no time while something else is urgent
  };

  /// Starts to move `bytes`, whole bursts, from or to `address`.
  void start(std::uint32_t address, std::uint32_t bytes, LastInterrupt last = LastInterrupt::comes);

  /// Lets the last interrupt come, whether the last burst runs already or not.
  void release_last();

  /// The DMA's interrupt. `self` is the chain.
  static void on_interrupt(void* self);

  /// All bursts are done, or the chain broke.
  bool is_over() const { return failed_ || done_ == bursts_; }
  bool failed() const { return failed_; }

  /// Bursts that ended well.
  std::uint32_t done() const { return done_; }

  /// The last status that was not good, or the present one: for messages.
  std::uint32_t status() const { return failed_ ? failure_status_ : dma_.status(); }

 private:
  void hold_back_last();
  void started(bool accepted);
  void fail(std::uint32_t status);

  drivers::AxiDma dma_;
  std::uint32_t burst_bytes_;
  std::uint32_t next_address_;
  std::uint32_t bursts_;
  volatile LastInterrupt last_;
  volatile std::uint32_t done_;
  volatile bool failed_;
  std::uint32_t failure_status_;
};

}  // namespace hybrid
