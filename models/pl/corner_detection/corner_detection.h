#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <pl/common/fidelity.h>
#include <pl/common/frame_channel.h>
#include <pl/corner_detection/core.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/probe.h>

namespace pl {

class IpPorts;

/// Corner Detection (thesis 4.3.4, ports of table B.1). One pixel per pixel clock.
class CornerDetection : public vp::Clocked, public vp::Ip {
 public:
  static Models<CornerDetection>& models();

  vp::In<bool> ena{"ena", this};
  vp::In<bool> rst{"rst", this};
  // The image pixel by pixel.
  vp::In<std::uint8_t> pixel{"pixel", this};
  vp::In<std::uint16_t> x{"x", this};
  vp::In<std::uint16_t> y{"y", this};
  FrameIn<GreyFrames> frames{"frames"};  ///< the image as a whole
  vp::Signal<bool> corner_out{"corner_out"};
  vp::Signal<std::uint32_t> corner_data{"corner_data"};  ///< valid while corner_out is high

  vp::Parameter<std::uint32_t> threshold{
      "threshold",
      30,
      vp::Unit::none,
      {0, 255},
      vp::Source::decision,
      "a circle pixel is bright if it exceeds the point of interest by more (grey levels)"};

 protected:
  CornerDetection(sc_core::sc_module_name name, const Site& site)
      : Clocked(name, site.clk), Ip(&site.clk), geometry_(site.geometry) {
    wake_on(ena);
    wake_on(rst);
  }

  const Geometry geometry_;

  /// All ports but the clock, as RTL in its place has them.
  void connect(IpPorts& ports);

 private:
  vp::IpEstimate own_estimate() const override;
};

/// Corner Detection clock by clock.
class CornerDetectionClocked : public CornerDetection {
 public:
  CornerDetectionClocked(sc_core::sc_module_name name, const Site& site);

 private:
  void edge() override;
  void reset();

  CornerCore core_;
  std::uint32_t in_flight_ = 0;  ///< bit n: a corner leaves in n + 1 clocks
  std::array<std::uint32_t, CornerCore::latency + 1> data_{};
  unsigned slot_ = 0;
  vp::Probe<std::uint16_t> new_strength_{"new_strength", [this] { return core_.newest().strength; },
                                         12};
  vp::Probe<std::uint8_t> new_direction_{"new_direction",
                                         [this] { return core_.newest().direction; }, 2};
  vp::Probe<std::uint16_t> centre_strength_{"centre_strength",
                                            [this] { return core_.centre().strength; }, 12};
  vp::Probe<std::uint8_t> centre_direction_{"centre_direction",
                                            [this] { return core_.centre().direction; }, 2};
  vp::Probe<std::uint32_t> in_flight_probe_{"in_flight", in_flight_, CornerCore::latency};
};

/// Corner Detection at transaction level: finds a frame's corners when it begins, and shows each on
/// its clock.
///
/// `rst` is the sensor's, too.
class CornerDetectionTlm final : public CornerDetection, private FrameListener {
 public:
  CornerDetectionTlm(sc_core::sc_module_name name, const Site& site);

 private:
  void end_of_elaboration() override;
  void edge() override;
  void pixels_changed(std::uint32_t first, std::uint32_t count) override;
  void begin(std::uint64_t cycle);
  void find_again(std::uint64_t cycle);
  /// Stamps them with cycles.
  void append(const std::vector<StampedWord>& corners);
  std::vector<StampedWord>::iterator first_at_or_after(std::uint64_t cycle, std::size_t from);
  std::uint64_t next_change(std::uint64_t cycle) const;
  void emit(std::uint64_t cycle);
  void reset();

  CornerFrame frame_;
  std::vector<StampedWord> corners_;  ///< stamped with cycles; those to come from next_ on
  std::size_t next_ = 0;
  bool ena_before_ = false;
  std::uint64_t begin_ = 0;                         ///< edge that takes the frame's first pixel
  std::uint32_t changed_ = ~0u;                     ///< first pixel that is not what it was
  std::uint64_t changed_cycle_ = vp::Clock::never;  ///< edge on which that pixel is taken
};

}  // namespace pl
