#include <vp/systemc_pins.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <vp/error.h>
#include <vp/ip.h>
#include <vp/report.h>

namespace vp {

namespace {

/// So often may a signal change in one instant before it is taken for a combinational ring; and so
/// many delta cycles may modules need to come to rest at first.
constexpr unsigned most_changes = 1000;

/// The pins of foreign modules. Our own ports are no sc_port.
std::vector<sc_core::sc_port_base*> foreign_pins() {
  std::vector<sc_core::sc_port_base*> pins;
  for (sc_core::sc_port_base* port : all_objects<sc_core::sc_port_base>()) {
    const std::string kind = port->kind();
    if (kind == "sc_in" || kind == "sc_out" || kind == "sc_inout") pins.push_back(port);
  }
  return pins;
}

/// True if something happens in the present instant yet.
bool is_in_motion() {
  return sc_core::sc_pending_activity_at_current_time();
}

/// Pins that change in the next delta cycles, of modules that have an input and an output among
/// them: what lies behind a ring changes, too, but leads nowhere.
std::string pins_on_a_ring(const std::vector<sc_core::sc_port_base*>& pins) {
  constexpr unsigned looks = 32;
  std::set<const sc_core::sc_port_base*> moving;
  // A signal of ours makes its event when it is asked for the first time.
  for (sc_core::sc_port_base* pin : pins) pin->get_interface()->default_event();
  for (unsigned i = 0; i < looks && is_in_motion(); ++i) {
    sc_core::sc_start(sc_core::SC_ZERO_TIME);
    for (sc_core::sc_port_base* pin : pins) {
      if (pin->get_interface()->default_event().triggered()) moving.insert(pin);
    }
  }
  const auto moves = [&](const sc_core::sc_object* module, bool input) {
    return std::any_of(moving.begin(), moving.end(), [&](const sc_core::sc_port_base* pin) {
      return pin->get_parent_object() == module && (std::string(pin->kind()) == "sc_in") == input;
    });
  };
  std::string names;
  for (const sc_core::sc_port_base* pin : pins) {
    const sc_core::sc_object* module = pin->get_parent_object();
    if (moving.count(pin) == 0 || !moves(module, true) || !moves(module, false)) continue;
    names += (names.empty() ? "" : ", ") + std::string(pin->name());
  }
  return names;
}

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

// A gate may have closed behind this edge.
void ClockPin::plan_fall(std::uint64_t from_ps) {
  const std::uint64_t next_ps = clock_.edge_at_or_after(from_ps + 1);
  const std::uint64_t period_ps =
      next_ps == Clock::never ? clock_.duration_ps(1) : next_ps - from_ps;
  plan(from_ps + period_ps / 2);
}

// An edge of this very instant was before.
void ClockPin::follow_gate() {
  if (high_ || planned_ps_ == to_ps(sc_core::sc_time_stamp())) return;
  edge_.cancel();
  plan_rise();
}

void ClockPin::plan(std::uint64_t ps) {
  planned_ps_ = ps;
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

void settle_foreign_modules() {
  const std::vector<sc_core::sc_port_base*> pins = foreign_pins();
  if (pins.empty()) return;
  unsigned deltas = 0;
  do {
    sc_core::sc_start(sc_core::SC_ZERO_TIME);
  } while (is_in_motion() && ++deltas < most_changes);
  if (deltas < most_changes) return;
  throw InputError("a combinational ring goes through " + pins_on_a_ring(pins) +
                   ": it does not come to rest before the simulation begins; put a register "
                   "into the ring");
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
