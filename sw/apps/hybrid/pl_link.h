#pragma once

#include <apps/hybrid/burst_chain.h>
#include <drivers/axi_gpio.h>
#include <drivers/gic.h>
#include <drivers/timers.h>
#include <marker/feature_set.h>
#include <marker/result.h>

#include <cstdint>

namespace hybrid {

/// The way to the PL and back (thesis 4.5.1): control packet, feature words, two DMA engines, their
/// interrupts.
class PlLink {
 public:
  /// Brings up all devices and unmasks interrupts. Images travel in bursts of `burst_bytes`. False
  /// if a DMA does not leave reset.
  bool initialise(std::uint32_t burst_bytes);

  /// Masks interrupts again.
  void shut_down();

  /// Resets both DMA engines after a frame that went wrong. False if one does not leave reset.
  bool recover();

  /// Writes an image of `bytes` into the PL's image store. Gives up after `timeout` counts.
  marker::Status upload(std::uint32_t bus_address, std::uint32_t bytes, std::uint64_t timeout);

  /// Resets the PL, arms DMA 1 for `bytes` of binary image at `bus_address`.
  void prepare_frame(std::uint32_t bus_address, std::uint32_t bytes);

  /// Raises `ena`.
  void start_frame();

  /// Takes feature words until the end word (thesis 4.5.1.3). Gives up after `timeout` counts.
  marker::Status receive_features(marker::WordStore& words, std::uint64_t timeout);

  /// Waits until the binary image is complete. Gives up after `timeout` counts.
  marker::Status await_binary_image(std::uint64_t timeout);

  /// Packets of the binary image that arrived.
  std::uint32_t binary_packets() const { return binary_.done(); }

  std::uint64_t now() const { return timer_.now(); }

  /// Status registers of the two engines, for messages.
  std::uint32_t image_dma_status() const { return image_.status(); }
  std::uint32_t binary_dma_status() const { return binary_.status(); }

 private:
  static void on_alarm(void* self);

  bool initialise_dma();
  void control(std::uint32_t packet);
  bool wait_for(const BurstChain& chain, std::uint64_t timeout);

  drivers::Gic gic_;
  drivers::GlobalTimer timer_;
  drivers::AxiGpio control_gpio_;
  drivers::AxiGpio feature_gpio_;
  BurstChain image_;
  BurstChain binary_;
  std::uint32_t burst_bytes_;
  std::uint32_t packet_;  ///< the control packet as last written
  volatile bool alarm_;
};

}  // namespace hybrid
