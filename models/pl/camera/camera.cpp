#include <pl/camera/camera.h>

#include <pl/common/estimate.h>
#include <pl/common/rtl_model.h>
#include <vp/error.h>
#include <vp/probe.h>

#include <algorithm>
#include <string>
#include <utility>

namespace pl {

namespace {

class CameraClocked : public Camera {
 public:
  CameraClocked(sc_core::sc_module_name name, const Site& site) : Camera(name, site) {}

 private:
  void edge() override;
  void pass_pixels();

  vp::Probe<std::uint64_t> blanking_probe_{"blanking", sensor_.blanking(), 32};
};

void CameraClocked::edge() {
  const bool starts = triggered(sensor_.active());
  sensor_trigger = starts;
  if (rst) {
    sensor_.stop();
    open_gate(true);
    frame_ena = false;
    return sleep();
  }
  frame_ena = sensor_.running();
  open_gate(sensor_.valid() || !sensor_.running());
  if (sensor_.valid()) pass_pixels();
  if (sensor_.advance()) begin_frame();
  if (starts) sensor_.expose(clocks_to_frame());
  if (!sensor_.active() && !frame_ena.written()) sleep();
}

void CameraClocked::pass_pixels() {
  const std::uint8_t* group = sent();
  pixel = *group;
  for (vp::Signal<std::uint8_t>& next : more_pixels) next = *++group;
  pixel_x = sensor_.x();
  pixel_y = sensor_.y();
}

/// frame_ena rises and falls at its clocks, and the gate moves; what passes between is in `frames`.
class CameraTlm final : public Camera {
 public:
  CameraTlm(sc_core::sc_module_name name, const Site& site)
      : Camera(name, site),
        line_(site.geometry.clocks_per_row() + line_blanking),
        frame_(site.geometry.height * line_ - line_blanking) {}

 private:
  void edge() override;
  bool is_blanked(std::uint64_t cycle) const;
  std::uint64_t next_change(std::uint64_t cycle) const;

  // From a first pixel on, clocks.
  const std::uint64_t line_;                ///< until the next line begins
  const std::uint64_t frame_;               ///< until the last line is over
  std::uint64_t begin_ = vp::Clock::never;  ///< edge behind which the first pixel leaves
};

void CameraTlm::edge() {
  sleep();
  const std::uint64_t cycle = clock().cycle();
  const bool under_way = begin_ != vp::Clock::never && cycle <= begin_ + frame_;
  const bool starts = triggered(under_way);
  sensor_trigger = starts;
  if (rst) {
    begin_ = vp::Clock::never;
    open_gate(true);
    frame_ena = false;
    return wake_at(vp::Clock::never);
  }
  if (cycle == begin_) begin_frame();
  frame_ena = under_way && cycle > begin_;
  open_gate(!(under_way && is_blanked(cycle)));
  if (starts) begin_ = cycle + clocks_to_frame();
  if (begin_ != vp::Clock::never) wake_at(starts ? cycle + 1 : next_change(cycle));
}

/// Of a frame under way.
bool CameraTlm::is_blanked(std::uint64_t cycle) const {
  return cycle > begin_ && (cycle - begin_ - 1) % line_ >= line_ - line_blanking;
}

std::uint64_t CameraTlm::next_change(std::uint64_t cycle) const {
  const std::uint64_t end = begin_ + frame_ + 1;
  if (cycle < begin_) return begin_;
  if (cycle == begin_) return begin_ + 1;
  if (cycle >= end) return vp::Clock::never;
  if (line_blanking == 0) return end;
  const std::uint64_t in_line = (cycle - begin_ - 1) % line_, pixels = line_ - line_blanking;
  return std::min(cycle - in_line + (in_line < pixels ? pixels : line_), end);
}

}  // namespace

Models<Camera>& Camera::models() {
  static Models<Camera> models{"camera",
                               {model<Camera, CameraClocked>("clocked", no_image, both_ways),
                                model<Camera, CameraTlm>("tlm", no_image, by_frame)},
                               rtl_model<Camera, CameraClocked>()};
  return models;
}

void Camera::connect(IpPorts& ports) {
  for (vp::In<bool>* port : {&rst, &por, &ena, &hold}) ports.input(*port);
  ports.input("sensor_valid", 1, [this] { return sensor_.valid(); });
  for (std::uint32_t lane = 0; lane < most_pixels_per_clock; ++lane) {
    const std::string name = lane == 0 ? "sensor_pixel" : lane_name("sensor_pixel", lane);
    if (lane < geometry_.pixels_per_clock) {
      ports.input(name.c_str(), 8, [this, lane] { return sensor_.valid() ? sent()[lane] : 0; });
    } else {
      ports.idle_pins.push_back({name, 8, false});
    }
  }
  ports.output(sensor_trigger);
  gate_ ? ports.output(pixel_ce) : ports.report(pixel_ce);
  ports.output(frame_ena);
  ports.output(frame_number);
  ports.means_nothing_until_written();
  ports.report(dropped_triggers);
  ports.output(pixel, more_pixels, &frame_ena);
  ports.output(pixel_x, &frame_ena);
  ports.output(pixel_y, &frame_ena);
  ports.parameter("WIDTH", "pl.width", geometry_.width);
  ports.parameter("HEIGHT", "pl.height", geometry_.height);
  ports.pixels_per_clock(geometry_.pixels_per_clock);
  ports.others_stand_still = [this] { return !sensor_.active(); };
  if (!ports.watched) ports.behind_edge = [this] { play_sensor(); };
}

// The port is RTL; the sensor behind its pins is ours.
void Camera::play_sensor() {
  if (rst) {
    sensor_.stop();
    frames.cut();
  } else if (sensor_.advance()) {
    begin_frame();
  }
  if (gate_) gate_->open(pixel_ce.written());
  if (!sensor_trigger.written()) return;
  expose();
  sensor_.expose(clocks_to_frame());
}

bool Sensor::advance() {
  if (blanked_ != 0) {
    --blanked_;
  } else if (running_) {
    column_ = static_cast<std::uint16_t>(column_ + geometry_.pixels_per_clock);
    if (column_ == geometry_.width) {
      column_ = 0;
      running_ = ++row_ != geometry_.height;
      if (running_) blanked_ = line_blanking_;
    }
  }
  if (blanking_ == 0 || --blanking_ != 0) return false;
  running_ = true;
  column_ = row_ = 0;
  return true;
}

Camera::Camera(sc_core::sc_module_name name, const Site& site)
    : Clocked(name, site.clk),
      Ip(&site.clk),
      more_pixels("pixel", site.geometry.pixels_per_clock),
      pixel_x("pixel_x", site.geometry.words().x_bits()),
      pixel_y("pixel_y", site.geometry.words().y_bits()),
      gate_(line_blanking == 0 ? nullptr : std::make_unique<vp::GatedClock>("pixel_clk", site.clk)),
      geometry_(site.geometry),
      scene_(std::make_shared<std::vector<std::uint8_t>>(site.geometry.pixels())) {
  wake_on(ena);
  wake_on(rst);
  wake_on(por);
}

void Camera::show(Image image) {
  if (image->size() != geometry_.pixels()) {
    throw vp::InputError(std::string(name()) + " sees an image of " +
                         std::to_string(image->size()) + " pixels: its frames have " +
                         std::to_string(geometry_.pixels()));
  }
  scene_ = std::move(image);
}

bool Camera::triggered(bool under_way) {
  if (por) {
    triggers_ = 0;
    dropped_triggers = 0;
  }
  if (rst) {
    frames.cut();
    ena_before_ = false;
    return false;
  }
  const bool rises = ena && !ena_before_;
  ena_before_ = ena;
  if (!rises) return false;
  const std::uint32_t number = triggers_++;
  if (under_way || hold) {
    dropped_triggers = dropped_triggers.written() + 1;
    return false;
  }
  frame_number = number;
  expose();
  return true;
}

void Camera::expose() {
  exposed_ = scene_;
  exposed_ps_ = clock().time_of(clock().cycle());
}

std::uint64_t Camera::clocks_to_frame() const {
  const std::uint64_t end_of_exposure = clock().cycle_at_or_after(exposed_ps_ + exposure);
  return end_of_exposure - clock().cycle() + frame_blanking;
}

void Camera::begin_frame() {
  frames.announce();
  before_ = frame_;
  frame_ = exposed_;
  frames.begin(frame_->data(), geometry_.pixels(), pixel_clk().cycle() + 1,
               geometry_.pixels_per_clock);
}

vp::IpEstimate Camera::own_estimate() const {
  return synthesised_ip("camera", {{"PIXELS_PER_CLOCK", geometry_.pixels_per_clock}});
}

}  // namespace pl
