#include <vp/systemc_pins.h>

#include <vp/report.h>

namespace vp {

namespace {

/// So often may a signal change in one instant before it is taken for a combinational ring.
constexpr unsigned most_changes = 1000;

}  // namespace

const sc_core::sc_signal_in_if<bool>& Clock::pin() {
  if (!pin_) {
    pin_ = std::make_unique<ClockPin>((std::string(basename()) + "_pin").c_str(), *this);
  }
  return pin_->level;
}

Clock::~Clock() = default;

ClockPin::ClockPin(sc_core::sc_module_name name, Clock& clock) : sc_module(name), clock_(clock) {
  SC_HAS_PROCESS(ClockPin);
  SC_METHOD(toggle);
  sensitive << edge_;
  dont_initialize();
  clock.add_listener(*this);
}

void ClockPin::toggle() {
  high_ = !high_;
  level = high_;
  if (high_) {
    plan_fall(to_ps(sc_core::sc_time_stamp()));
  } else {
    plan_rise();
  }
}

void ClockPin::plan_rise() {
  plan(clock_.edge_at_or_after(to_ps(sc_core::sc_time_stamp()) + 1));
}

void ClockPin::plan_fall(std::uint64_t from_ps) {
  plan(from_ps + (clock_.edge_at_or_after(from_ps + 1) - from_ps) / 2);
}

void ClockPin::plan(std::uint64_t ps) {
  if (ps != Clock::never) edge_.notify(from_ps(ps - to_ps(sc_core::sc_time_stamp())));
}

// The first rising edge comes a new period from now: until its middle the pin may stay high.
void ClockPin::after_change(Clock& clock) {
  edge_.cancel();
  const std::uint64_t now = to_ps(sc_core::sc_time_stamp());
  if (!high_) {
    plan_rise();
  } else if (clock.frequency_hz() == 0) {
    plan(now);
  } else {
    plan_fall(now);
  }
}

void FollowerBase::begin_change(ClockScheduler* scheduler) {
  if (scheduler) scheduler->synchronise();
  const std::uint64_t now = to_ps(sc_core::sc_time_stamp());
  changes_ = now == last_ps_ ? changes_ + 1 : 0;
  last_ps_ = now;
  if (changes_ < most_changes) return;
  error(*this, "/markervp/pin/ring",
        "changed " + std::to_string(changes_) +
            " times in one instant: a combinational ring goes through the module that drives it; "
            "put a register into the ring");
}

void FollowerBase::refuse_value(const std::string& value, unsigned bits) const {
  error(*this, "/markervp/pin/value",
        "the foreign module drives " + value + ", which the " + std::to_string(bits) +
            " bits of the port cannot show");
}

}  // namespace vp
