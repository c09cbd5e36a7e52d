#include <xilinx/axi_timer/axi_timer.h>

#include <algorithm>

#include <xilinx/common/axi_lite_ip.h>

namespace xilinx {

namespace {

using namespace axi_timer;

constexpr std::uint32_t reset_pin = 2;  // listener ids: 0 and 1 are the capture pins

}  // namespace

AxiTimer::AxiTimer(sc_core::sc_module_name name, vp::Clock& s_axi_aclk, const AxiTimerBuild& build)
    : Clocked(name, s_axi_aclk),
      Ip(&s_axi_aclk),
      count_width("count_width", build.count_width, vp::Unit::none, {8, 32}, vp::Source::published,
                  "build option Width of the Timer (PG079)"),
      one_timer_only("one_timer_only", build.one_timer_only, vp::Source::published,
                     "build option Enable Timer 2 is off (PG079)"),
      s_axi("s_axi", axi_timer::registers, axi_lite_options(axi_timer::address_bits),
            &s_axi_aclk.scheduler()) {
  for (const std::uint32_t at : {TCSR0, TCSR1}) {
    timers_.push_back({s_axi[at], s_axi[at + TLR0], s_axi[at + TCR0]});
  }
  for (const unsigned number : {0u, 1u}) wire(number);
  if (one_timer_only) {
    for (const std::uint32_t offset : {TCSR1, TLR1, TCR1}) s_axi[offset].remove();
  }
}

// The guide's table has 290 LUT and 220 FF for both timers of 32 bits.
vp::IpEstimate AxiTimer::own_estimate() const {
  const bool one = one_timer_only;
  vp::IpEstimate e = axi_estimate("axi_timer", one ? 180 : 290, one ? 140 : 220, 0);
  e.active_clocks = [this] { return clocks_per_access * accesses(s_axi); };
  return e;
}

void AxiTimer::wire(unsigned number) {
  Timer& timer = timers_[number];
  timer.tlr.set_writable(mask());
  timer.tcsr.set_writable(timer.tcsr.info().writable & ~tcsr::TINT);
  timer.tcsr.after_write([this, number](std::uint32_t word) { control_written(number, word); });
  timer.tlr.after_write([this, number](std::uint32_t) {
    Timer& t = timers_[number];
    if (t.tcsr.any(tcsr::LOAD)) t.base = load_value(number);
    update();
  });
  timer.tcr.computed_by([this, number] {
    if (!cascaded()) return static_cast<std::uint32_t>(value(number));
    return static_cast<std::uint32_t>(value(0) >> 32 * number);
  });
}

bool AxiTimer::cascaded() const {
  return timers_[0].tcsr.any(tcsr::CASC);
}

bool AxiTimer::modulates() const {
  constexpr std::uint32_t needs = tcsr::PWMA | tcsr::GENT;
  return (timers_[0].tcsr & timers_[1].tcsr & needs) == needs;
}

std::uint64_t AxiTimer::last_count(const Timer& timer) const {
  if (timer.tcsr.any(tcsr::UDT)) return 0;
  return cascaded() ? ~std::uint64_t{0} : mask();
}

std::uint32_t AxiTimer::mask() const {
  return count_width == 32 ? 0xFFFFFFFF : (1u << count_width) - 1;
}

std::uint64_t AxiTimer::load_value(unsigned number) const {
  if (!cascaded()) return timers_[number].tlr;
  return static_cast<std::uint64_t>(timers_[1].tlr) << 32 | timers_[0].tlr;
}

std::uint64_t AxiTimer::counts_left(const Timer& timer) const {
  return timer.tcsr.any(tcsr::UDT) ? timer.base : last_count(timer) - timer.base;
}

std::uint64_t AxiTimer::value(unsigned number) const {
  const Timer& timer = timers_[number];
  if (!timer.running || clock().cycle() < timer.origin) return timer.base;
  const std::uint64_t counts = clock().cycle() - timer.origin;
  const std::uint64_t bits = cascaded() ? ~std::uint64_t{0} : mask();
  return (timer.tcsr.any(tcsr::UDT) ? timer.base - counts : timer.base + counts) & bits;
}

// Generate: when the counter leaves its end.
std::uint64_t AxiTimer::event_cycle(unsigned number) const {
  const Timer& timer = timers_[number];
  if (!timer.running || timer.tcsr.any(tcsr::MDT)) return vp::Clock::never;
  const std::uint64_t left = counts_left(timer);
  return left > vp::Clock::never - timer.origin - clocks_past_end
             ? vp::Clock::never
             : timer.origin + left + clocks_past_end;
}

void AxiTimer::start(unsigned number) {
  Timer& timer = timers_[number];
  if (timer.running || timer.held) return;
  timer.running = true;
  timer.origin = clock().cycle() + clocks_to_start;
}

void AxiTimer::stop(unsigned number) {
  Timer& timer = timers_[number];
  timer.base = value(number);
  timer.running = timer.held = false;
}

// LOAD holds the counter at the load value; ENALL sets ENT in both.
void AxiTimer::control_written(unsigned number, std::uint32_t word) {
  if ((word & tcsr::TINT) != 0) timers_[number].tcsr.clear_bits(tcsr::TINT);
  if ((word & tcsr::ENALL) != 0) {
    for (Timer& timer : timers_) {
      if (!timer.tcsr.removed()) timer.tcsr.set_bits(tcsr::ENT | tcsr::ENALL);
    }
  } else {
    for (Timer& timer : timers_) timer.tcsr.clear_bits(tcsr::ENALL);
  }
  for (unsigned n = 0; n < timers_.size(); ++n) {
    Timer& timer = timers_[n];
    if (cascaded() && n == 1) {
      timer.running = false;
      continue;
    }
    if (timer.tcsr.any(tcsr::LOAD)) {
      if (n != number && timer.running) continue;
      stop(n);
      timer.base = load_value(n);
    } else if (timer.tcsr.any(tcsr::ENT)) {
      start(n);
    } else {
      stop(n);
    }
  }
  update();
}

void AxiTimer::expire(unsigned number) {
  Timer& timer = timers_[number];
  const std::uint64_t at = event_cycle(number);
  timer.tcsr.set_bits(tcsr::TINT);
  if (timer.tcsr.any(tcsr::GENT)) {
    (number == 0 ? generateout0 : generateout1) = true;
    pulse_end_[number] = at + 1;
  }
  if (modulates()) pwm0 = number == 0;
  if (timer.tcsr.any(tcsr::ARHT)) {
    timer.base = load_value(number);
    timer.origin = at;
    if (modulates() && number == 0) {  // the high time counts from the period's start
      timers_[1].base = load_value(1);
      timers_[1].origin = at;
      timers_[1].running = true;
      timers_[1].held = false;
    } else if (modulates()) {
      timer.running = false;
    }
    return;
  }
  timer.base = timer.tcsr.any(tcsr::UDT) ? (cascaded() ? ~std::uint64_t{0} : mask()) : 0;
  timer.running = false;
  timer.held = true;
}

void AxiTimer::capture(unsigned number) {
  Timer& timer = timers_[number];
  constexpr std::uint32_t needs = tcsr::MDT | tcsr::CAPT | tcsr::ENT;
  const std::uint32_t on = timers_[0].tcsr;
  if ((timer.tcsr & needs) != needs && !(cascaded() && (on & needs) == needs)) return;
  if (!timer.tcsr.any(tcsr::ARHT) && timer.tcsr.any(tcsr::TINT)) return;
  const std::uint64_t now = value(cascaded() ? 0 : number);
  timer.tlr = static_cast<std::uint32_t>(now);
  if (cascaded()) timers_[1].tlr = static_cast<std::uint32_t>(now >> 32);
  timer.tcsr.set_bits(tcsr::TINT);
  update();
}

void AxiTimer::before_end_of_elaboration() {
  Clocked::before_end_of_elaboration();
  if (capturetrig0.bound()) capturetrig0.signal()->attach(*this, 0);
  if (capturetrig1.bound()) capturetrig1.signal()->attach(*this, 1);
  if (s_axi_aresetn.bound()) s_axi_aresetn.signal()->attach(*this, reset_pin);
}

void AxiTimer::on_change(vp::SignalBase& signal, std::uint32_t id) {
  if (id != reset_pin) {
    if (signal.bits() != 0) capture(id);
    return;
  }
  s_axi.hold_in_reset(!s_axi_aresetn);
  for (Timer& timer : timers_) {
    timer.base = 0;
    timer.running = timer.held = false;
  }
  update();
}

void AxiTimer::edge() {
  sleep();
  const std::uint64_t now = clock().cycle();
  for (unsigned n = 0; n < timers_.size(); ++n) {
    if (pulse_end_[n] <= now) {
      pulse_end_[n] = vp::Clock::never;
      (n == 0 ? generateout0 : generateout1) = false;
    }
    if (event_cycle(n) <= now) expire(n);
  }
  update();
}

void AxiTimer::update() {
  bool raised = false;
  for (const Timer& timer : timers_) {
    constexpr std::uint32_t both = tcsr::TINT | tcsr::ENIT;
    raised |= (timer.tcsr & both) == both;
  }
  interrupt = raised;
  // A change of direction may have put the end behind the counter.
  const std::uint64_t next =
      std::min({event_cycle(0), event_cycle(1), pulse_end_[0], pulse_end_[1]});
  wake_at(std::max(next, clock().cycle() + 1));
}

}  // namespace xilinx
