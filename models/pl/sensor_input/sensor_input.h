#pragma once

#include <cstdint>
#include <vector>

#include <pl/common/fidelity.h>
#include <pl/common/frame_channel.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <xilinx/bram/bram.h>

namespace pl {

class IpPorts;

/// The frames that the sensor plays from a memory: pixels that left it as they were then, the
/// others as the memory has them now.
class SensorFrames : public GreyFrames, private xilinx::Bram::Reader {
 public:
  SensorFrames(const char* name, vp::Clock& clk, const Geometry& geometry);

  /// Before the first frame.
  void read_from(xilinx::Bram& bram);
  /// The frame's first pixel leaves the sensor on edge `first_cycle`, one more on each edge.
  void begin(std::uint64_t first_cycle);
  /// The frame is cut off.
  void end();
  /// Pixels that left the sensor before the present instant.
  std::uint32_t sent() const;

 private:
  bool reads() override;
  bool reads_now(std::uint32_t first, std::uint32_t count) override;
  void before_write(std::uint32_t first, std::uint32_t count) override;
  void after_write(std::uint32_t first, std::uint32_t count) override;
  std::uint64_t edges_before_now() const;
  std::uint64_t first_cycle() const { return leaves_at(0); }

  const std::uint32_t pixels_;
  xilinx::Bram* bram_ = nullptr;
  std::vector<std::uint8_t> kept_;    ///< the frame, once the memory went on without it
  std::vector<std::uint8_t> before_;  ///< the frame before
  bool forked_ = false;
  bool running_ = false;
};

/// Sensor Input (thesis 4.3.2, ports of table B.7): reads the stored image from port B of the BRAM
/// and plays it as a camera sensor would, one pixel per pixel clock.
class SensorInput : public vp::Clocked, public vp::Ip {
 public:
  static Models<SensorInput>& models();

  vp::In<bool> ena{"ena", this};  ///< a rise starts a frame; ignored while one runs
  vp::In<bool> rst{"rst", this};
  sc_core::sc_port<xilinx::Bram> bram{"bram"};  ///< its port B
  vp::Signal<bool> frame_ena{"frame_ena"};
  // Pixel by pixel.
  vp::Signal<std::uint8_t> pixel{"pixel"};
  vp::Signal<std::uint16_t> pixel_x;
  vp::Signal<std::uint16_t> pixel_y;
  // Whole frames.
  SensorFrames frames;

  /// Brings the memory's count of reads up to now, in the middle of a frame, too.
  virtual void settle() {}

 protected:
  SensorInput(sc_core::sc_module_name name, const Site& site);
  void end_of_elaboration() override;

  /// All pins but the clock, as RTL in its place has them.
  void connect(IpPorts& ports);

  const Geometry geometry_;
  bool ena_before_ = false;

 private:
  /// What RTL asks of the memory at its port B.
  struct RtlRead {
    std::uint32_t address = 0;
    bool enabled = false;
    std::uint8_t pixel = 0;
  };
  vp::IpEstimate own_estimate() const override;
  void read_for_rtl(bool enabled, bool watched);

  RtlRead rtl_;
};

}  // namespace pl
