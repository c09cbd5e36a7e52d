#include <pl/camera/camera.h>

#include <pl/common/estimate.h>
#include <vp/error.h>
#include <vp/probe.h>

#include <algorithm>
#include <string>
#include <utility>

namespace pl {

namespace {

class CameraClocked final : public Camera {
 public:
  CameraClocked(sc_core::sc_module_name name, const Site& site) : Camera(name, site) {}

 private:
  void edge() override;
  void send_pixel();

  std::uint64_t blanking_ = 0;       ///< clocks until the first pixel leaves, exposure and all
  std::uint32_t line_blanking_ = 0;  ///< clocks until the next line's first pixel leaves
  std::uint16_t column_ = 0, row_ = 0;
  bool running_ = false;
  vp::Probe<std::uint64_t> blanking_probe_{"blanking", blanking_, 32};
};

void CameraClocked::edge() {
  const bool starts = triggered(blanking_ != 0 || running_);
  if (rst) {
    running_ = false;
    blanking_ = 0;
    line_blanking_ = 0;
    open_gate(true);
    frame_ena = false;
    return sleep();
  }
  frame_ena = running_;
  open_gate(line_blanking_ == 0);
  if (line_blanking_ != 0) {
    --line_blanking_;
  } else if (running_) {
    send_pixel();
  }
  if (blanking_ != 0 && --blanking_ == 0) {
    begin_frame();
    running_ = true;
    column_ = row_ = 0;
  }
  if (starts) blanking_ = clocks_to_frame();
  if (blanking_ == 0 && !running_ && !frame_ena.written()) sleep();
}

void CameraClocked::send_pixel() {
  const std::uint8_t* group = &frame()[row_ * geometry_.width + column_];
  pixel = *group;
  for (vp::Signal<std::uint8_t>& next : more_pixels) next = *++group;
  pixel_x = column_;
  pixel_y = row_;
  column_ = static_cast<std::uint16_t>(column_ + geometry_.pixels_per_clock);
  if (column_ == geometry_.width) {
    column_ = 0;
    running_ = ++row_ != geometry_.height;
    if (running_) line_blanking_ = line_blanking;
  }
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
  if (begin_ != vp::Clock::never) wake_at(next_change(cycle));
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
                                model<Camera, CameraTlm>("tlm", no_image, by_frame)}};
  return models;
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
  exposed_ = scene_;
  exposed_ps_ = clock().time_of(clock().cycle());
  return true;
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

// The trigger's edge detection, two counters of 32 bits, and a register for each pin of the port.
vp::IpEstimate Camera::own_estimate() const {
  const auto more_pins = static_cast<std::uint32_t>(8 * more_pixels.size());
  vp::IpEstimate e = small_ip("sensor_input", 80, 110 + more_pins, 148 * mhz);
  e.source = "derived from the model's registers";
  e.fmax_high_hz = 0;
  e.fmax_origin = vp::FmaxOrigin::estimated;
  e.fmax_documentation = "registers and counters, as in the RTL of sensor_input";
  return e;
}

}  // namespace pl
