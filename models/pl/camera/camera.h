#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <pl/common/fidelity.h>
#include <pl/common/frame_channel.h>
#include <pl/common/lanes.h>
#include <vp/clock.h>
#include <vp/gated_clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>

namespace pl {

class IpPorts;

/// What a sensor sends from a trigger on: when its pixels are at the pins of the port, for models
/// that run edge by edge.
class Sensor {
 public:
  Sensor(const Geometry& geometry, std::uint32_t line_blanking)
      : geometry_(geometry), line_blanking_(line_blanking) {}

  /// The first pixel comes behind as many edges, at least one.
  void expose(std::uint64_t clocks) { blanking_ = clocks; }
  void stop() { *this = Sensor(geometry_, line_blanking_); }
  /// A frame is on its way, or will be.
  bool active() const { return blanking_ != 0 || running_; }
  bool running() const { return running_; }
  /// This edge takes pixels, the first of them here; else a line is blanked, or nothing is sent.
  bool valid() const { return running_ && blanked_ == 0; }
  /// Clocks until the first pixel comes, exposure and all; 0: none is awaited.
  const std::uint64_t& blanking() const { return blanking_; }
  std::uint16_t x() const { return column_; }
  std::uint16_t y() const { return row_; }
  /// To the next edge; true: a frame begins there.
  bool advance();

 private:
  Geometry geometry_;
  std::uint32_t line_blanking_;
  std::uint64_t blanking_ = 0;
  std::uint32_t blanked_ = 0;  ///< clocks until the next line's first pixel comes
  std::uint16_t column_ = 0, row_ = 0;
  bool running_ = false;
};

/// A triggered sensor with a global shutter, behind a parallel port: a rise of `ena` exposes what
/// it sees for `exposure`; `frame_blanking` clocks later its pixels come, line by line, as many a
/// clock as the logic takes, with `line_blanking` clocks between two lines.
///
/// While a line is blanked the gate of pixel_clk() is closed: the logic behind it sees a frame
/// without a gap, and only the times of its edges differ.
///
/// The sensor is outside the chip: its image needs no memory there, and the test bench says what it
/// sees. The chip has the port, which drops triggers that come too early and counts them.
class Camera : public vp::Clocked, public vp::Ip {
 public:
  static Models<Camera>& models();
  static constexpr std::uint64_t longest_exposure = 1'000'000'000'000;  ///< ps

  vp::In<bool> ena{"ena", this};  ///< a rise triggers
  vp::In<bool> rst{"rst", this};  ///< cuts the frame
  vp::In<bool> por{"por", this};  ///< system reset: frames are counted from 0 again
  /// High while what the frame before became is not sent: a trigger is dropped, as it is while a
  /// frame is under way.
  vp::In<bool> hold{"hold", this};
  vp::Signal<bool> sensor_trigger{"sensor_trigger"};  ///< for a clock
  vp::Signal<bool> frame_ena{"frame_ena"};
  /// Of the frame exposed last: counts triggers since the system reset, dropped ones too.
  vp::Signal<std::uint32_t> frame_number{"frame_number"};
  vp::Signal<std::uint32_t> dropped_triggers{"dropped_triggers"};  ///< since the system reset
  // Pixel by pixel.
  vp::Signal<std::uint8_t> pixel{"pixel"};
  Lanes<vp::Signal<std::uint8_t>> more_pixels;
  vp::Signal<std::uint16_t> pixel_x;
  vp::Signal<std::uint16_t> pixel_y;
  vp::Signal<bool> pixel_ce{"pixel_ce", 1, true};  ///< lets the edges of pixel_clk() through

  vp::Parameter<std::uint64_t> exposure{
      "exposure",
      0,
      vp::Unit::time,
      {0, longest_exposure},
      vp::Source::decision,
      "for which the sensor gathers light after the trigger; how much a motion blurs the image is "
      "the scene's exposure"};
  vp::Parameter<std::uint32_t> frame_blanking{
      "frame_blanking",     64,
      vp::Unit::cycles,     {GreyFrames::drain_clocks, 1'000'000},
      vp::Source::decision, "from the end of the exposure to the frame's first pixel"};
  vp::Parameter<std::uint32_t> line_blanking{
      "line_blanking",      0,
      vp::Unit::cycles,     {0, 100'000},
      vp::Source::decision, "from the last pixel of a line to the first one of the next"};

 private:
  std::unique_ptr<vp::GatedClock> gate_;  ///< none without line_blanking

 public:
  /// The clock of all that takes pixels: the camera's, without the edges of blanked lines.
  vp::Clock& pixel_clk() { return gate_ ? *gate_ : clock(); }
  /// Whole frames; counted on pixel_clk().
  GreyFrames frames{"frames", pixel_clk()};

  /// A frame's pixels, row by row.
  using Image = std::shared_ptr<const std::vector<std::uint8_t>>;
  /// What the sensor sees from now on. Throws vp::InputError for an image of another size.
  void show(Image image);
  void show(std::vector<std::uint8_t> pixels) {
    show(std::make_shared<const std::vector<std::uint8_t>>(std::move(pixels)));
  }
  /// Middle of the last frame's exposure, ps.
  std::uint64_t mid_exposure_ps() const { return exposed_ps_ + exposure / 2; }

 protected:
  Camera(sc_core::sc_module_name name, const Site& site);
  /// All ports but the clock, and the pins of the sensor, as RTL in its place has them.
  void connect(IpPorts& ports);

  /// Looks at trigger and resets. True: a frame is exposed.
  bool triggered(bool under_way);
  /// From the trigger, at this edge, to the one behind which the first pixel leaves: clocks.
  std::uint64_t clocks_to_frame() const;
  /// The first pixel leaves on the next edge.
  void begin_frame();
  /// The pixel that this edge takes, with its neighbours to the right behind it.
  const std::uint8_t* sent() const {
    return frame_->data() + sensor_.y() * geometry_.width + sensor_.x();
  }
  void open_gate(bool open) {
    pixel_ce = open;
    if (gate_) gate_->open(open);
  }

  const Geometry geometry_;
  Sensor sensor_{geometry_, line_blanking};

 private:
  vp::IpEstimate own_estimate() const override;
  void expose();
  void play_sensor();

  Image scene_, exposed_;         ///< what the sensor sees, and what it saw at the trigger
  Image frame_, before_;          ///< in the channel, and the frame that left it last
  std::uint64_t exposed_ps_ = 0;  ///< when the last exposure began
  bool ena_before_ = false;
  std::uint32_t triggers_ = 0;
};

}  // namespace pl
