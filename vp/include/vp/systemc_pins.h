#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <systemc>
#include <type_traits>

#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/signal.h>

/// How foreign modules (plain SystemC, Verilated RTL) stand among ours:
///
///   foreign.clk(clock.pin());     their clock is ours
///   foreign.in(ours.out);         a vp::Signal is an sc_signal_in_if of its type
///   ours.in(wire);                a vp::In takes an sc_signal that a foreign sc_out drives
///   vp::Driver d{"d", wire, ours.out};  a vp::Signal has what that drives
///
/// All of them sample the values from before an edge, so a module can be replaced by a foreign one
/// of the same function and nothing changes.
namespace vp {

/// The signal behind Clock::pin().
class ClockPin : public sc_core::sc_module, private ClockListener {
 public:
  ClockPin(sc_core::sc_module_name name, Clock& clock);

  sc_core::sc_signal<bool> level{"level"};

  /// The clock's gate has opened or closed: it comes up with the next edge that there is.
  void follow_gate();

 private:
  void start_of_simulation() override { plan_rise(); }
  void before_change(Clock&) override {}
  void after_change(Clock&) override;
  void toggle();
  void plan_rise();
  void plan_fall(std::uint64_t from_ps);
  void plan(std::uint64_t ps);

  Clock& clock_;
  sc_core::sc_event edge_;
  std::uint64_t planned_ps_ = 0;
  bool high_ = false;
};

/// Starts the simulation and lets foreign modules settle before time passes; does nothing without
/// foreign modules. Throws InputError with the ports on a combinational loop that keeps changing: a
/// foreign module does not declare which inputs its outputs follow combinationally, so loops are
/// found only when they oscillate. A loop that is stable at time zero is found when it changes
/// (Follower).
void settle_foreign_modules();

/// A value of a SystemC signal as one of ours; sc_logic, sc_uint, sc_bv and their like included.
/// False if it does not fit.
template <class T, class U>
bool from_systemc(const U& value, T& result) {
  if constexpr (std::is_arithmetic_v<U>) {
    result = static_cast<T>(value);
    return static_cast<U>(result) == value;
  } else if constexpr (std::is_same_v<U, sc_dt::sc_logic>) {
    result = static_cast<T>(value.is_01() && value.to_bool());
    return value.is_01();
  } else {
    const std::uint64_t bits = value.to_uint64();
    result = static_cast<T>(bits);
    return static_cast<std::uint64_t>(result) == bits;
  }
}

/// What a Follower does that does not depend on types.
class FollowerBase : public sc_core::sc_module {
 protected:
  explicit FollowerBase(sc_core::sc_module_name name) : sc_module(name) {}
  /// The signal changed: edges up to now run before it is looked at. An error if it does not come
  /// to rest.
  void begin_change(ClockScheduler* scheduler);
  [[noreturn]] void refuse_value(const std::string& value, unsigned bits) const;

 private:
  std::uint64_t last_ps_ = 0;
  unsigned changes_ = 0;  ///< at that time
};

/// Drives one of our signals with the value of a SystemC signal: an output of ours that a foreign
/// module produces.
template <class T, class U>
class Driver : public FollowerBase {
 public:
  Driver(sc_core::sc_module_name name, const sc_core::sc_signal_in_if<U>& source, Signal<T>& driven)
      : FollowerBase(name), source_(source), driven_(driven) {
    SC_HAS_PROCESS(Driver);
    SC_METHOD(follow);
    sensitive << source.value_changed_event();
    dont_initialize();
  }

 private:
  // Before anybody drove it, a wire may well be unknown.
  void start_of_simulation() override {
    T value{};
    if (from_systemc(source_.read(), value)) driven_ = value;
  }
  void follow() {
    begin_change(driven_.scheduler());
    T value{};
    if (!from_systemc(source_.read(), value)) {
      std::ostringstream text;
      text << source_.read();
      refuse_value(text.str(), driven_.width());
    }
    driven_ = value;
  }

  const sc_core::sc_signal_in_if<U>& source_;
  Signal<T>& driven_;
};

/// A signal of ours that follows one of SystemC, for our ports to read.
template <class T, class U>
class Follower : public Driver<T, U> {
 public:
  Follower(sc_core::sc_module_name name, const sc_core::sc_signal_in_if<U>& source)
      : Driver<T, U>(name, source, signal) {}

  Signal<T> signal{"signal"};
};

/// A signal of ours as one of SystemC of another type, for ports such as sc_in<sc_uint<10>>.
template <class U>
class View : public sc_core::sc_module {
 public:
  template <class T>
  View(sc_core::sc_module_name name, const Signal<T>& source)
      : sc_module(name), read_([&source] { return U(source.read()); }) {
    SC_HAS_PROCESS(View);
    SC_METHOD(follow);
    sensitive << source.value_changed_event();
  }

  sc_core::sc_signal<U> signal{"signal"};

 private:
  void follow() { signal.write(read_()); }

  std::function<U()> read_;
};

template <class T>
template <class U>
void In<T>::bind(const sc_core::sc_signal_in_if<U>& foreign) {
  auto follower = std::make_shared<Follower<T, U>>(follower_name().c_str(), foreign);
  bind(follower->signal);
  follower_ = std::move(follower);
}

}  // namespace vp
