#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "fake_hal.h"

/// The devices of the marker system behind the fake HAL, just good enough to run the hybrid
/// application: what the PL sends is laid ready by the test.
class FakePlatform {
 public:
  FakePlatform();

  /// Features that the PL sends after `ena` rises, without the end word; it is sent by itself.
  std::vector<std::uint32_t> features;
  bool sends_end_word = true;
  /// The binary image that the PL sends.
  std::vector<std::uint32_t> binary;
  std::uint32_t binary_packets = 0xFFFF'FFFF;  ///< at most so many packets are sent

  /// After so many bursts the engine reports `dma_error` or falls silent.
  std::uint32_t image_bursts = 0xFFFF'FFFF;
  std::uint32_t dma_error = 0;
  bool reset_hangs = false;

  // What the application did.
  std::vector<std::uint8_t> image;      ///< bytes that DMA 0 took
  std::vector<std::uint32_t> controls;  ///< control packets in order
  std::uint32_t resets = 0;             ///< soft resets of the engines
  std::uint32_t frames = 0;             ///< rises of `ena`

  /// One more image of the run.
  void add_frame(std::uint32_t width, std::uint32_t height);

 private:
  struct Engine {
    std::uint32_t base, control, status, address, length;
    std::uint32_t dmacr = 0, dmasr = 1, address_value = 0;
    std::uint32_t armed = 0;  ///< bytes of the transfer that waits
    bool interrupt() const { return dmasr & dmacr & 0x5000; }
    void complete() { dmasr = (dmasr & ~1u) | 0x1002; }
    void fail(std::uint32_t bits) {
      dmasr = 0x4001 | bits;
      dmacr &= ~1u;
    }
  };

  void connect(Engine& engine);
  void control(std::uint32_t packet);
  void serve_image();
  void serve_binary();
  void idle();
  bool alarm_pending() const { return timer_control_ == 7 && counter_ >= alarm_; }

  Engine image_dma_{0x4040'0000, 0x00, 0x04, 0x18, 0x28};
  Engine binary_dma_{0x4041'0000, 0x30, 0x34, 0x48, 0x58};
  std::uint32_t packet_ = 0;
  std::deque<std::uint32_t> words_;
  std::uint32_t feature_ = 0;
  bool feature_wanted_ = false;
  bool running_ = false;
  std::uint32_t sent_packets_ = 0;
  std::uint32_t active_ = 1023;
  std::uint64_t counter_ = 0, alarm_ = 0;
  std::uint32_t timer_control_ = 0;
  std::deque<std::vector<std::uint8_t>> pixels_;
};
