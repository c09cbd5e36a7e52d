#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "fake_hal.h"

/// A frame as the logic of the design `improved` sends it.
struct CameraFrame {
  std::vector<std::uint8_t> picture;
  std::vector<std::uint32_t> packet;
};

/// The devices of the design `improved` behind the fake HAL, just good enough to run its program:
/// a camera on the PL that is triggered, and two DMA engines. Frames are laid ready by the test.
class FakeCamera {
 public:
  FakeCamera();

  /// What the triggers bring, in order; the last one again and again.
  std::vector<CameraFrame> frames;
  /// The packet's trailer says the number of the trigger, plus so much.
  std::uint32_t number_offset = 0;
  bool checksum = false;  ///< at the packet's end

  // How things go wrong, from trigger number `wrong_from` on, `wrong_times` times.
  std::uint32_t wrong_from = 0xFFFF'FFFF, wrong_times = 1;
  bool sends_packet = true, sends_picture = true;  ///< when wrong
  std::uint32_t packet_error = 0, picture_error = 0;
  std::uint32_t picture_bytes_short = 0;
  std::optional<std::uint32_t> wrong_bit;  ///< of the packet, when wrong
  std::uint32_t picture_delay = 0;         ///< always: reads of its status until it is in memory
  bool reset_hangs = false;

  // What the program did.
  std::uint32_t triggers = 0, resets = 0, logic_resets = 0;
  /// Publications that were there at each trigger.
  std::vector<std::size_t> published_at_trigger;
  std::vector<std::uint32_t> picture_addresses;  ///< of each trigger

  /// One more image of the run.
  void add_image(std::uint32_t width, std::uint32_t height);

 private:
  struct Engine {
    std::uint32_t base;
    std::uint32_t dmacr = 0, dmasr = 1, address = 0, length = 0;
    bool armed = false;

    bool interrupt() const { return dmasr & dmacr & 0x5000; }
    void take(const std::uint8_t* data, std::size_t size, std::size_t missing);
    void complete() {
      armed = false;
      dmasr = (dmasr & ~1u) | 0x1002;
    }
    void fail(std::uint32_t bits) {
      armed = false;
      dmasr = 0x4001 | bits;
      dmacr &= ~1u;
    }
  };

  void connect(Engine& engine);
  void control(std::uint32_t packet);
  void trigger();
  bool is_wrong() const { return triggers > wrong_from && triggers - wrong_from <= wrong_times; }
  void send();
  void send_picture();
  void send_packet();
  void idle();
  bool alarm_pending() const { return timer_control_ == 7 && counter_ >= alarm_; }

  Engine picture_{0x4040'0000}, packet_{0x4041'0000};
  std::uint32_t control_ = 0;
  bool under_way_ = false, picture_due_ = false;
  std::uint32_t polls_left_ = 0;
  std::uint64_t counter_ = 0, alarm_ = 0;
  std::uint32_t timer_control_ = 0;
};
