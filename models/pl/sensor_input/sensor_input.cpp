#include <pl/sensor_input/sensor_input.h>

#include <algorithm>

#include <pl/common/estimate.h>
#include <pl/common/rtl_model.h>
#include <vp/clock_scheduler.h>
#include <vp/probe.h>

namespace pl {

namespace {

class SensorInputClocked : public SensorInput {
 public:
  SensorInputClocked(sc_core::sc_module_name name, const Site& site) : SensorInput(name, site) {}

 private:
  void end_of_elaboration() override {
    SensorInput::end_of_elaboration();
    bram_ = bram[0];
  }
  void edge() override;

  xilinx::Bram* bram_ = nullptr;
  std::uint32_t address_ = 0;
  std::uint16_t column_ = 0, row_ = 0;
  bool running_ = false;
  vp::Probe<std::uint32_t> address_probe_{"address", address_,
                                          marker_logic::bits_for(geometry_.pixels(), 19)};
  vp::Probe<bool> running_probe_{"running", running_};
};

void SensorInputClocked::edge() {
  if (rst) {
    running_ = ena_before_ = false;
    frame_ena = false;
    frames.end();
    sleep();
    return;
  }
  const bool start = ena && !ena_before_ && !running_;
  ena_before_ = ena;
  frame_ena = running_;
  if (running_) {
    pixel = bram_->read_b(address_++);
    pixel_x = column_;
    pixel_y = row_;
    if (++column_ == geometry_.width) {
      column_ = 0;
      running_ = ++row_ != geometry_.height;
    }
  } else if (!start) {
    sleep();
  }
  if (start) {
    running_ = true;
    address_ = 0;
    column_ = row_ = 0;
    frames.begin(clock().cycle() + 1);
  }
}

/// frame_ena rises and falls at its clocks; what passes between is in `frames`.
class SensorInputTlm final : public SensorInput {
 public:
  SensorInputTlm(sc_core::sc_module_name name, const Site& site) : SensorInput(name, site) {}

  void settle() override;

 private:
  void edge() override;
  void start(std::uint64_t cycle);
  void stop();
  void count(std::uint64_t read);

  bool running_ = false;          ///< from the frame's start until frame_ena has fallen
  std::uint64_t last_cycle_ = 0;  ///< edge on which the frame's last pixel leaves
  std::uint64_t counted_ = 0;     ///< the frame's pixels that stand in the memory's count
};

void SensorInputTlm::edge() {
  sleep();
  if (rst) return stop();
  const std::uint64_t cycle = clock().cycle();
  const bool rises = ena && !ena_before_;
  ena_before_ = ena;
  if (running_ && cycle > last_cycle_) {
    frame_ena = false;
    count(geometry_.pixels());
    running_ = false;
  } else if (running_) {
    frame_ena = true;
    wake_at(last_cycle_ + 1);
  }
  if (rises && !running_) start(cycle);
}

void SensorInputTlm::start(std::uint64_t cycle) {
  running_ = true;
  counted_ = 0;
  last_cycle_ = cycle + geometry_.pixels();
  frames.begin(cycle + 1);
  wake_at(cycle + 1);
}

// A pixel leaves on each edge after the one that started the frame.
void SensorInputTlm::settle() {
  const std::uint64_t started = last_cycle_ - geometry_.pixels();
  if (running_) count(std::min(clock().cycle(), last_cycle_) - started);
}

void SensorInputTlm::count(std::uint64_t read) {
  bram->reads_b.add(read - counted_);
  counted_ = read;
}

void SensorInputTlm::stop() {
  if (running_) count(frames.sent());
  running_ = ena_before_ = false;
  frame_ena = false;
  frames.end();
  wake_at(vp::Clock::never);
}

}  // namespace

Models<SensorInput>& SensorInput::models() {
  static Models<SensorInput> models{
      "sensor_input",
      {model<SensorInput, SensorInputClocked>("clocked", no_image, both_ways),
       model<SensorInput, SensorInputTlm>("tlm", no_image, by_frame)},
      rtl_model<SensorInput, SensorInputClocked>()};
  return models;
}

void SensorInput::connect(IpPorts& ports) {
  ports.input(ena);
  ports.input(rst);
  ports.output(frame_ena);
  ports.output(pixel, &frame_ena);
  ports.output(pixel_x, &frame_ena);
  ports.output(pixel_y, &frame_ena);
  const bool watched = ports.watched;
  ports.memory_outputs = {
      {"bram_addr", marker_logic::bits_for(geometry_.pixels(), 1),
       [this](std::uint64_t address) { rtl_.address = static_cast<std::uint32_t>(address); },
       nullptr},
      {"bram_en", 1,
       [this, watched](std::uint64_t enabled) { read_for_rtl(enabled != 0, watched); }, nullptr}};
  ports.memory_inputs = {{nullptr, "bram_dout", 8, [this] { return rtl_.pixel; }, {}}};
  ports.others_stand_still = [this] { return !rtl_.enabled; };
  ports.parameter("WIDTH", "pl.width", geometry_.width);
  ports.parameter("HEIGHT", "pl.height", geometry_.height);
}

// Beside a model it must not count, and the model says when frames begin.
void SensorInput::read_for_rtl(bool enabled, bool watched) {
  if (!watched && rst) frames.end();
  if (!watched && enabled && !rtl_.enabled) frames.begin(clock().cycle());
  rtl_.enabled = enabled;
  if (!enabled) return;
  if (!watched) {
    rtl_.pixel = bram->read_b(rtl_.address);
  } else {
    rtl_.pixel = rtl_.address < bram->size_b() ? bram->contents()[rtl_.address] : 0;
  }
}

SensorInput::SensorInput(sc_core::sc_module_name name, const Site& site)
    : Clocked(name, site.clk),
      Ip(&site.clk),
      pixel_x("pixel_x", site.geometry.words().x_bits()),
      pixel_y("pixel_y", site.geometry.words().y_bits()),
      frames("frames", site.clk, site.geometry),
      geometry_(site.geometry) {
  wake_on(ena);
  wake_on(rst);
}

void SensorInput::end_of_elaboration() {
  Clocked::end_of_elaboration();
  frames.read_from(*bram[0]);
}

// Address and coordinate counters.
vp::IpEstimate SensorInput::own_estimate() const {
  vp::IpEstimate e = rtl_ip("sensor_input");
  e.fmax_hz = 0;
  e.fmax_documentation = "the thesis clocks it with 50 MHz";
  return e;
}

SensorFrames::SensorFrames(const char* name, vp::Clock& clk, const Geometry& geometry)
    : GreyFrames(name, clk), pixels_(geometry.pixels()) {}

void SensorFrames::read_from(xilinx::Bram& bram) {
  bram_ = &bram;
  bram.set_reader(this);
}

void SensorFrames::begin(std::uint64_t first_cycle) {
  bram_->settle();
  announce();
  before_.swap(kept_);
  forked_ = false;
  running_ = true;
  GreyFrames::begin(bram_->contents().data(), pixels_, first_cycle);
}

void SensorFrames::end() {
  running_ = false;
  cut();
}

// At coincident edges the memory's side runs first: what it writes now, the sensor still gets.
std::uint64_t SensorFrames::edges_before_now() const {
  if (clock().frequency_hz() == 0) return clock().cycle();
  return clock().cycle_at_or_after(clock().scheduler().now_ps()) - 1;
}

std::uint32_t SensorFrames::sent() const {
  const std::uint64_t edges = edges_before_now() + 1;
  if (edges <= first_cycle()) return 0;
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(edges - first_cycle(), pixels_));
}

bool SensorFrames::reads() {
  if (running_) running_ = edges_before_now() < first_cycle() + pixels_ + drain_clocks;
  return running_;
}

bool SensorFrames::reads_now(std::uint32_t first, std::uint32_t count) {
  const std::uint64_t now = clock().scheduler().now_ps();
  if (!reads() || edges_before_now() + 1 < first_cycle()) return false;
  const std::uint32_t next = sent();
  return next < pixels_ && next - first < count && clock().edge_at_or_after(now) == now;
}

void SensorFrames::before_write(std::uint32_t first, std::uint32_t) {
  if (forked_ || !reads() || first >= sent()) return;
  kept_ = bram_->fork();
  forked_ = true;
}

void SensorFrames::after_write(std::uint32_t first, std::uint32_t count) {
  if (!reads()) return;
  const std::uint32_t changed = std::max(first, sent()), end = std::min(first + count, pixels_);
  if (changed >= end) return;
  if (forked_) {
    const auto& now = bram_->contents();
    std::copy(now.begin() + changed, now.begin() + end, kept_.begin() + changed);
  }
  change(changed, end - changed);
}

}  // namespace pl
