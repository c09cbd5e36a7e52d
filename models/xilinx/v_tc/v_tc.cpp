#include <xilinx/v_tc/v_tc.h>

#include <algorithm>
#include <string>

#include <vp/error.h>
#include <vp/report.h>
#include <xilinx/common/axi_lite_ip.h>

namespace xilinx {

namespace {

using namespace v_tc;

constexpr std::uint32_t bus_reset_pin = 1;  // listener id; 0: what wakes

std::uint32_t halves(std::uint32_t high, std::uint32_t low) {
  return high << high_half_shift | low;
}
std::uint32_t high_of(std::uint32_t word) {
  return word >> high_half_shift & low_half;
}
std::uint32_t low_of(std::uint32_t word) {
  return word & low_half;
}

/// From the first place up to the second, round the frame.
bool is_between(std::uint64_t at, std::uint64_t from, std::uint64_t to) {
  return from <= to ? at >= from && at < to : at >= from || at < to;
}

bool is_possible(const VideoTiming& t) {
  return t.hactive > 0 && t.vactive > 0 && t.hactive < t.htotal && t.vactive < t.vtotal &&
         t.hsync_start < t.htotal && t.hsync_end <= t.htotal && t.vsync_start < t.vtotal &&
         t.vsync_end <= t.vtotal &&
         std::max({t.vblank_hstart, t.vblank_hend, t.vsync_hstart, t.vsync_hend}) < t.htotal;
}

}  // namespace

VTc::VTc(sc_core::sc_module_name name, vp::Clock& clk, const VTcBuild& build)
    : Clocked(name, clk),
      Ip(&clk),
      ctrl("ctrl", v_tc::registers, axi_lite_options(v_tc::address_bits), &clk.scheduler()),
      fsync_out("fsync_out", build.frame_syncs),
      build_(build),
      timing_(build.timing),
      polarity_(build.polarity) {
  if (build.generate && !is_possible(build.timing))
    throw vp::InputError(std::string(this->name()) +
                         ": active pixels and lines must be fewer than all of them, and syncs and "
                         "blanks within the frame: correct the GEN_ parameters");
  wire();
  show_build();
  drive();
  wake();
}

// Public reports of syntheses for the same fabric have 201 LUT and 243 FF for a generator without
// registers; with them and a detector the guide's tables have about 1000 and 1500.
vp::IpEstimate VTc::own_estimate() const {
  const bool small = !build_.has_axi4_lite && !build_.detect;
  vp::IpEstimate e = axi_estimate("v_tc", small ? 201 : 1000, small ? 243 : 1500, 0);
  if (small) e.source = "public reports of syntheses out of context, 7 series";
  return e;
}

void VTc::wire() {
  ctrl[CONTROL].after_write([this](std::uint32_t word) { control_written(word); });
  ctrl[STATUS].after_write([this](std::uint32_t) { raise(0); });
  ctrl[IRQ_ENABLE].after_write([this](std::uint32_t) { raise(0); });
  ctrl[DETECTOR_TIMING_STATUS].computed_by([this] {
    return (detector_.locked() ? timing::LOCKED : 0) |
           (detector_.in_vblank() ? timing::VBLANK : 0) |
           (detector_.in_active() ? timing::ACTIVE_VIDEO : 0);
  });
  ctrl[GENERATOR_TIMING_STATUS].computed_by([this] {
    const VideoLevels now = levels();
    return (now.vblank ? timing::VBLANK : 0) | (now.active ? timing::ACTIVE_VIDEO : 0);
  });
  for (const std::uint32_t offset : {GENERATOR_ENCODING, GENERATOR_GLOBAL_DELAY})
    ctrl[offset].after_write([this](std::uint32_t) { warn_of_what_is_missing(); });
}

void VTc::show_build() {
  const VideoTiming& t = build_.timing;
  const auto set = [this](std::uint32_t offset, std::uint32_t word) {
    ctrl[offset].set_reset_value(word);
  };
  set(GENERATOR_ACTIVE_SIZE, halves(t.vactive, t.hactive));
  set(GENERATOR_POLARITY, build_.polarity);
  set(GENERATOR_HSIZE, t.htotal);
  set(GENERATOR_VSIZE, halves(t.vtotal, t.vtotal));
  set(GENERATOR_HSYNC, halves(t.hsync_end, t.hsync_start));
  set(GENERATOR_F0_VBLANK_H, halves(t.vblank_hend, t.vblank_hstart));
  set(GENERATOR_F0_VSYNC_V, halves(t.vsync_end, t.vsync_start));
  set(GENERATOR_F0_VSYNC_H, halves(t.vsync_hend, t.vsync_hstart));
  for (unsigned n = 0; n < build_.frame_syncs; ++n) {
    const auto& [line, clock] = build_.frame_sync[n];
    set(FRAME_SYNC_CONFIG + 4 * n, halves(line, clock));
  }
}

// ---- registers

void VTc::control_written(std::uint32_t word) {
  if ((word & control::SW_RESET) != 0) return reset_core();
  if ((word & control::FSYNC_RESET) != 0) wants_reset_ = true;
  if (wants_reset_ && !running_) return reset_core();
  warn_of_what_is_missing();
  wake();
}

void VTc::warn_of_what_is_missing() {
  const bool asked = ctrl[CONTROL].any(control::SYNC_ENABLE | control::INTERLACED) ||
                     ctrl[GENERATOR_ENCODING].any(encoding_INTERLACED) ||
                     ctrl[GENERATOR_GLOBAL_DELAY] != 0;
  if (!asked || warned_) return;
  warned_ = true;
  vp::warn(*this, "/markervp/v_tc/missing",
           "interlaced frames, SYNC_ENABLE and GENERATOR_GLOBAL_DELAY are not modelled: frames are "
           "progressive and begin as if nothing came in");
}

void VTc::reset_core() {
  ctrl.reset();
  detector_.reset();
  running_ = wants_reset_ = false;
  timing_ = build_.timing;
  polarity_ = build_.polarity;
  drive();
  raise(0);
  wake();
}

void VTc::raise(std::uint32_t bits) {
  ctrl[STATUS].set_bits(bits);
  irq = ctrl[STATUS].any(ctrl[IRQ_ENABLE]);
}

// GEN_ENABLE is enough: programs start the core without SW_ENABLE.
bool VTc::generates() {
  if (!build_.generate || !high(resetn) || !high(s_axi_aresetn)) return false;
  return !build_.has_axi4_lite || ctrl[v_tc::CONTROL].any(control::GEN_ENABLE);
}

// Without a detector the source selects choose nothing.
void VTc::load_timing() {
  if (!build_.has_axi4_lite) return;
  VideoTiming next;
  const auto both = [this](std::uint32_t offset, std::uint32_t& high, std::uint32_t& low) {
    high = high_of(ctrl[offset]);
    low = low_of(ctrl[offset]);
  };
  both(GENERATOR_ACTIVE_SIZE, next.vactive, next.hactive);
  next.htotal = low_of(ctrl[GENERATOR_HSIZE]);
  next.vtotal = low_of(ctrl[GENERATOR_VSIZE]);
  both(GENERATOR_HSYNC, next.hsync_end, next.hsync_start);
  both(GENERATOR_F0_VBLANK_H, next.vblank_hend, next.vblank_hstart);
  both(GENERATOR_F0_VSYNC_V, next.vsync_end, next.vsync_start);
  both(GENERATOR_F0_VSYNC_H, next.vsync_hend, next.vsync_hstart);
  polarity_ = ctrl[GENERATOR_POLARITY];
  if (build_.detect && detector_.locked()) {
    const VideoTiming& in = detector_.timing();
    const auto choose = [this](std::uint32_t select, std::uint32_t& to, std::uint32_t from) {
      if (!ctrl[CONTROL].any(select)) to = from;
    };
    choose(control::HTOTAL_SRC, next.htotal, in.htotal);
    choose(control::HACTIVE_SRC, next.hactive, in.hactive);
    choose(control::HSYNC_START_SRC, next.hsync_start, in.hsync_start);
    choose(control::HSYNC_END_SRC, next.hsync_end, in.hsync_end);
    choose(control::VTOTAL_SRC, next.vtotal, in.vtotal);
    choose(control::VACTIVE_SRC, next.vactive, in.vactive);
    choose(control::VSYNC_START_SRC, next.vsync_start, in.vsync_start);
    choose(control::VSYNC_END_SRC, next.vsync_end, in.vsync_end);
    choose(control::VBLANK_H_SRC, next.vblank_hstart, in.vblank_hstart);
    choose(control::VBLANK_H_SRC, next.vblank_hend, in.vblank_hend);
    choose(control::VBLANK_H_SRC, next.vsync_hstart, in.vsync_hstart);
    choose(control::VBLANK_H_SRC, next.vsync_hend, in.vsync_hend);
    const std::uint32_t own = ctrl[CONTROL] >> control::POLARITY_SRC_shift & polarity::all;
    polarity_ = (polarity_ & own) | (ctrl[DETECTOR_POLARITY] & ~own & polarity::all);
  }
  check_timing(next);
}

void VTc::check_timing(const VideoTiming& next) {
  if (is_possible(next)) {
    timing_ = next;
    return;
  }
  if (warned_of_timing_) return;
  warned_of_timing_ = true;
  vp::warn(
      *this, "/markervp/v_tc/timing",
      "the registers of the generator describe no frame: active pixels and lines must be fewer "
      "than all of them, and syncs within the frame; it keeps the timing it had");
}

// ---- the generator

VideoLevels VTc::levels() const {
  VideoLevels now;
  if (!running_) return now;
  const VideoTiming& t = timing_;
  const std::uint64_t line = position_ / t.htotal, clock = position_ % t.htotal;
  now.active = line < t.vactive && clock < t.hactive;
  now.hblank = clock >= t.hactive;
  now.hsync = is_between(clock, t.hsync_start, t.hsync_end);
  now.vsync = is_between(position_, t.clock_at(t.vsync_start, t.vsync_hstart),
                         t.clock_at(t.vsync_end, t.vsync_hend));
  now.vblank = is_between(position_, t.clock_at(t.vactive - 1, t.vblank_hstart),
                          t.clock_at(t.vtotal - 1, t.vblank_hend));
  return now;
}

void VTc::drive() {
  const VideoLevels now = levels();
  const auto level = [this](bool active, std::uint32_t bit) {
    return active == ((polarity_ & bit) != 0);
  };
  hsync_out = level(now.hsync, polarity::HSYNC);
  vsync_out = level(now.vsync, polarity::VSYNC);
  hblank_out = level(now.hblank, polarity::HBLANK);
  vblank_out = level(now.vblank, polarity::VBLANK);
  active_video_out = level(now.active, polarity::ACTIVE_VIDEO);
  std::uint32_t pulses = 0;
  for (unsigned n = 0; running_ && n < build_.frame_syncs; ++n) {
    const std::uint32_t at = ctrl[FRAME_SYNC_CONFIG + 4 * n];
    if (position_ == timing_.clock_at(high_of(at), low_of(at))) pulses |= 1u << n;
  }
  fsync_out = pulses;
}

// Where an output changes next, or the frame ends.
std::uint64_t VTc::next_position() {
  const VideoTiming& t = timing_;
  const std::uint64_t line = position_ - position_ % t.htotal;
  std::uint64_t next = line + t.htotal;
  const auto look = [&](std::uint64_t at) {
    if (at > position_) next = std::min(next, at);
  };
  for (const std::uint32_t clock : {t.hactive, t.hsync_start, t.hsync_end}) look(line + clock);
  look(t.clock_at(t.vsync_start, t.vsync_hstart));
  look(t.clock_at(t.vsync_end, t.vsync_hend));
  look(t.clock_at(t.vactive - 1, t.vblank_hstart));
  look(t.clock_at(t.vtotal - 1, t.vblank_hend));
  for (unsigned n = 0; n < build_.frame_syncs; ++n) {
    const std::uint32_t word = ctrl[FRAME_SYNC_CONFIG + 4 * n];
    const std::uint64_t at = t.clock_at(high_of(word), low_of(word));
    look(at);
    look(at + 1);
  }
  return next;
}

// Edges that were slept through passed as the last one that was looked at.
void VTc::generate(std::uint64_t cycle) {
  const bool enabled = high(clken) && high(gen_clken);
  if (!generates()) {
    running_ = false;
    drive();
  } else if (!running_) {
    if (enabled) {
      load_timing();
      running_ = true;
      position_ = 0;
      begin_position();
    }
  } else {
    const std::uint64_t slept = cycle - seen_ - 1;
    const std::uint64_t passed = (was_enabled_ ? slept : 0) + (enabled ? 1 : 0);
    if (passed != 0) {
      position_ += passed;
      begin_position();
    }
  }
  was_enabled_ = enabled;
}

void VTc::begin_position() {
  if (position_ >= timing_.frame_clocks()) {
    if (wants_reset_) return reset_core();
    position_ = 0;
    if (ctrl[CONTROL].any(control::REG_UPDATE)) load_timing();
  }
  drive();
  std::uint32_t bits = fsync_out.written() << irq::FSYNC_shift;
  if (position_ == 0) bits |= irq::GEN_ACTIVE_VIDEO;
  if (position_ == timing_.clock_at(timing_.vactive - 1, timing_.vblank_hstart))
    bits |= irq::GEN_VBLANK;
  if (bits != 0) raise(bits);
}

// ---- the detector

void VTc::detect(std::uint64_t cycle) {
  if (!build_.detect || !build_.has_axi4_lite) return;
  const bool on = ctrl[CONTROL].any(control::DET_ENABLE) && high(resetn) && high(s_axi_aresetn);
  const bool enabled = on && high(clken) && high(det_clken);
  if (!on) detector_.reset();
  det_clocks_ += (det_enabled_ ? cycle - seen_ - 1 : 0) + (enabled ? 1 : 0);
  det_enabled_ = enabled;
  if (!enabled) return;
  const VideoTiming before = detector_.timing();
  const TimingDetector::Events events = detector_.sample(
      det_clocks_, is_active(hsync_in), is_active(vsync_in), is_active(active_video_in));
  std::uint32_t bits = 0;
  if (events.frame) bits |= irq::DET_ACTIVE_VIDEO;
  if (events.vblank) bits |= irq::DET_VBLANK;
  if (events.lock) bits |= irq::DET_LOCK;
  if (events.lock_loss) {
    bits |= irq::DET_LOCK_LOSS;
    const VideoTiming& now = detector_.timing();
    const bool across = before.htotal != now.htotal || before.hactive != now.hactive;
    ctrl[v_tc::ERROR].set_bits(error::ACTIVE_VIDEO | (across ? error::HSYNC : error::VSYNC));
  }
  if (events.frame && detector_.locked()) show_detected();
  if (bits != 0) raise(bits);
}

void VTc::show_detected() {
  const VideoTiming& t = detector_.timing();
  ctrl[DETECTOR_ACTIVE_SIZE] = halves(t.vactive, t.hactive);
  ctrl[DETECTOR_HSIZE] = t.htotal;
  ctrl[DETECTOR_VSIZE] = t.vtotal;
  ctrl[DETECTOR_HSYNC] = halves(t.hsync_end, t.hsync_start);
  ctrl[DETECTOR_F0_VBLANK_H] = halves(t.vblank_hend, t.vblank_hstart);
  ctrl[DETECTOR_F0_VSYNC_V] = halves(t.vsync_end, t.vsync_start);
  ctrl[DETECTOR_F0_VSYNC_H] = halves(t.vsync_hend, t.vsync_hstart);
  ctrl[DETECTOR_POLARITY] = (detector_.hsync_high() ? polarity::HSYNC | polarity::HBLANK : 0) |
                            (detector_.vsync_high() ? polarity::VSYNC | polarity::VBLANK : 0) |
                            polarity::ACTIVE_VIDEO;
}

// ---- clock and pins

void VTc::before_end_of_elaboration() {
  Clocked::before_end_of_elaboration();
  for (vp::In<bool>* pin :
       {&resetn, &clken, &gen_clken, &det_clken, &hsync_in, &vsync_in, &active_video_in})
    if (pin->bound()) pin->signal()->attach(*this, 0);
  if (s_axi_aresetn.bound()) s_axi_aresetn.signal()->attach(*this, bus_reset_pin);
}

void VTc::on_change(vp::SignalBase& signal, std::uint32_t id) {
  if (id != bus_reset_pin) return Clocked::on_change(signal, id);
  ctrl.hold_in_reset(!s_axi_aresetn);
  reset_core();
}

void VTc::edge() {
  const std::uint64_t cycle = this_edge();
  detect(cycle);
  generate(cycle);
  seen_ = cycle;
  std::uint64_t next = vp::Clock::never;
  if (running_ && was_enabled_) next = cycle + next_position() - position_;
  const std::uint64_t lost = detector_.lost_at();
  if (det_enabled_ && lost != vp::Clock::never)
    next = std::min(next, cycle + std::max<std::uint64_t>(lost, det_clocks_ + 1) - det_clocks_);
  if (generates() && !running_ && high(clken) && high(gen_clken)) next = cycle + 1;
  sleep_until(next);
}

}  // namespace xilinx
