#pragma once

#include <drivers/axi_dma.h>
#include <drivers/axi_dma_ring.h>
#include <drivers/axi_gpio.h>
#include <drivers/gic.h>
#include <drivers/timers.h>
#include <hal/hal.h>
#include <marker/detection_result.h>

#include <cstdint>

namespace improved {

using Status = marker::DetectionStatus;

/// Where a frame goes: its picture and its packet of blobs. Empty at first.
struct Buffers {
  hal_dma_buffer picture{}, packet{};

  /// Makes room for a picture of so many bytes; what is too small is given up. False: no memory.
  bool reserve(std::uint32_t picture_bytes);
};

/// The status registers of both engines.
struct DmaStatus {
  std::uint32_t picture, packet;
};

/// The camera on the PL and the two DMA engines that bring its frames into memory. One frame at a
/// time; its packet's interrupt says that it is there. Packets go through a ring of descriptors if
/// their engine is built with scatter-gather.
class Capture {
 public:
  /// Brings up all devices and unmasks interrupts. False if a DMA does not leave reset.
  bool initialise();

  /// Masks interrupts again.
  void shut_down();

  /// The longest picture that the DMA can take, bytes.
  std::uint32_t max_picture_bytes() const;

  /// Arms both engines and triggers the camera. After a frame that went wrong it resets the logic
  /// and the engines first. False if a DMA does not take its transfer.
  bool start(const Buffers& buffers, std::uint32_t picture_bytes);

  /// Waits until the frame is in memory. Gives up `timeout` counts after the trigger.
  Status await(std::uint64_t timeout);

  /// Of the packet that came.
  std::uint32_t packet_bytes() const { return packet_bytes_; }

  /// A frame that is in memory is wrong, as `status` says: the next start() begins afresh.
  Status distrust(Status status) {
    recovery_due_ = true;
    return status;
  }

  std::uint64_t started() const { return started_; }
  std::uint64_t now() const { return timer_.now(); }

  /// For messages.
  DmaStatus dma_status() const;

 private:
  static void on_packet(void* self);
  static void on_alarm(void* self);

  bool initialise_dma();
  bool initialise_packet_dma();
  bool start_packet(std::uint32_t address);
  bool recover();
  Status await_packet();
  Status await_picture();

  drivers::Gic gic_;
  drivers::GlobalTimer timer_;
  drivers::AxiGpio control_;
  drivers::AxiDma picture_dma_, packet_dma_;
  drivers::AxiDmaRing packet_ring_;  ///< in the place of packet_dma_
  bool has_ring_;
  hal_dma_buffer descriptors_{};
  std::uint32_t picture_bytes_, packet_bytes_;
  std::uint64_t started_, deadline_;
  bool recovery_due_;
  volatile std::uint32_t packet_status_;  ///< of the interrupt; 0: none yet
  volatile bool alarm_;
};

}  // namespace improved
