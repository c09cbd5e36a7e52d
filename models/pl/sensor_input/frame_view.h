#pragma once

#include <cstdint>
#include <vector>

#include <pl/common/frame_channel.h>
#include <pl/common/geometry.h>
#include <vp/clock.h>
#include <xilinx/bram/bram.h>

namespace pl {

/// The frame that the sensor plays, for models that look at all of it at once: pixels that left the
/// sensor as they were then, the others as the memory has them now.
class FrameView : public FrameChannel, private xilinx::Bram::Listener {
 public:
  FrameView(const vp::Clock& clk, const Geometry& geometry, xilinx::Bram& bram);

  /// The frame's first pixel leaves the sensor on edge `first_cycle`, one more on each edge.
  void begin(std::uint64_t first_cycle);
  /// The frame is cut off.
  void end() { running_ = false; }

  /// Of the frame that began last: valid until the one after the next begins, and final 8 clocks
  /// after its last pixel.
  const std::uint8_t* pixels() const override { return pixels_; }
  /// Pixels that left the sensor before the present instant.
  std::uint32_t sent() const;
  /// Somebody may look at the frame: from its begin until 8 clocks after its last pixel.
  bool watched();

 private:
  void before_write(std::uint32_t first, std::uint32_t count) override;
  void after_write(std::uint32_t first, std::uint32_t count) override;
  std::uint64_t edges_before_now() const;

  const vp::Clock& clock_;
  const std::uint32_t size_;
  xilinx::Bram& bram_;
  const std::uint8_t* pixels_;
  std::vector<std::uint8_t> kept_;    ///< the frame, once the memory went on without it
  std::vector<std::uint8_t> before_;  ///< the frame before
  bool forked_ = false;
  bool running_ = false;
  std::uint64_t first_cycle_ = 0;
};

}  // namespace pl
