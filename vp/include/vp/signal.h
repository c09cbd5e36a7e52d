#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <systemc>
#include <type_traits>
#include <vector>

namespace vp {

class ClockScheduler;
class Clocked;
class SignalBase;

/// Called when a signal changes: a tracer, a combinational function, a sleeping module.
class SignalListener {
 public:
  virtual ~SignalListener() = default;
  /// The signal already has its new value. `id` is what the listener passed when it attached.
  virtual void on_change(SignalBase& signal, std::uint32_t id) = 0;
};

/// Shows another value than the writer's: a fault. It holds for each write from then on.
class SignalForce {
 public:
  virtual ~SignalForce() = default;
  /// What the signal shows, as its writer says `driven`; bits as of SignalBase::bits().
  virtual std::uint64_t seen(std::uint64_t driven) = 0;
};

/// The part of a signal that does not depend on its type: name, width, listeners.
class SignalBase : public sc_core::sc_object {
 public:
  const char* kind() const override { return "vp::Signal"; }

  /// Bits, 1 to 64.
  virtual unsigned width() const = 0;
  /// The value, right-aligned; a real-valued signal gives its IEEE-754 bits.
  virtual std::uint64_t bits() const = 0;
  /// True if bits() is the pattern of a double.
  virtual bool is_real() const { return false; }

  /// Whether force() can: not what is only shown in traces, and no real numbers.
  virtual bool can_be_forced() const { return false; }
  /// Lets `force` decide what the signal shows; null: its writer again. Costs nothing where it is
  /// never called.
  void force(SignalForce* force);
  bool is_forced() const { return force_ != nullptr; }
  /// Asks the force again, of the last value written: it has changed its mind. From a process.
  virtual void drive_again() {}

  void attach(SignalListener& listener, std::uint32_t id = 0);
  void detach(SignalListener& listener);

  /// Writes in a clock edge become visible at the end of the instant: for an output that logic
  /// without a clock reads.
  void defer_writes() { deferred_ = observed_ = true; }

  /// Says which module writes the signal, where that is not the module that holds it.
  void set_writer(Clocked& module) { writer_ = &module; }
  void set_scheduler(ClockScheduler& scheduler) { scheduler_ = &scheduler; }
  /// Known from the start of the simulation on.
  ClockScheduler* scheduler() const { return scheduler_; }
  /// The clocked module that writes the signal; null for one that is written by processes.
  Clocked* writer() const;

 protected:
  friend class ClockScheduler;

  explicit SignalBase(const char* name);
  void changed();
  void defer();
  /// A force takes over from the writer.
  virtual void forced_anew() {}
  /// Makes a deferred value visible.
  virtual void commit() = 0;
  /// SystemC reads the signal from now on, and is shown each value as an sc_signal would.
  void show_to_systemc() const;
  /// Lets SystemC see the present value, if it can read this signal; true if that is news to it.
  virtual bool show() const { return false; }
  enum EventKind { any_change, rising, falling, event_kinds };
  /// The event of a kind; made when first asked for, so that a signal without SystemC readers has
  /// none.
  sc_core::sc_event& event_of(EventKind kind) const;

  mutable bool observed_ = false;  ///< has listeners, or writes are deferred: off the fast path
  bool deferred_ = false;  ///< a consumer runs after the writer in the same instant: writes wait
                           ///< for the instant's end
  bool queued_ = false;
  mutable bool shown_to_systemc_ = false;
  SignalForce* force_ = nullptr;
  ClockScheduler* scheduler_ = nullptr;
  mutable std::uint64_t change_stamp_ = ~std::uint64_t{0};  ///< the delta in which SystemC sees it

 private:
  struct Listener {
    SignalListener* listener;
    std::uint32_t id;
  };
  std::vector<Listener> listeners_;
  Clocked* writer_ = nullptr;
  void update_shown();

  mutable std::unique_ptr<sc_core::sc_event> events_[event_kinds];
};

template <class T>
constexpr unsigned default_width() {
  return std::is_same_v<T, bool> ? 1 : 8 * sizeof(T);
}

/// What sc_signal_in_if asks for besides the value; bool has edges, too.
template <class T>
class SignalReader : public SignalBase, public sc_core::sc_signal_in_if<T> {
 public:
  const sc_core::sc_event& default_event() const override { return event_of(any_change); }
  const sc_core::sc_event& value_changed_event() const override { return event_of(any_change); }
  bool event() const override { return change_stamp_ == sc_core::sc_delta_count(); }
  void register_port(sc_core::sc_port_base&, const char*) override { show_to_systemc(); }

 protected:
  using SignalBase::SignalBase;
};

template <>
class SignalReader<bool> : public SignalBase, public sc_core::sc_signal_in_if<bool> {
 public:
  const sc_core::sc_event& default_event() const override { return event_of(any_change); }
  const sc_core::sc_event& value_changed_event() const override { return event_of(any_change); }
  const sc_core::sc_event& posedge_event() const override { return event_of(rising); }
  const sc_core::sc_event& negedge_event() const override { return event_of(falling); }
  bool event() const override { return change_stamp_ == sc_core::sc_delta_count(); }
  bool posedge() const override { return event() && read(); }
  bool negedge() const override { return event() && !read(); }
  void register_port(sc_core::sc_port_base&, const char*) override { show_to_systemc(); }

 protected:
  using SignalBase::SignalBase;
};

/// A register's output: reading is a plain load; without listeners, writing is a plain store.
///
/// Written by one module. Inside an instant, modules see the value from before the clock edge: the
/// scheduler runs consumers before producers, and defers the writes where that is not possible.
///
/// It implements sc_signal_in_if, so that standard SystemC ports, sc_trace and foreign modules can
/// bind to it. They see it as an sc_signal: the new value comes after the delta cycles in which
/// processes that Clock::pin() wakes run, so these also sample the old value.
template <class T>
class Signal : public SignalReader<T> {
 public:
  /// `width` in bits, for traces; `initial` is the value before the first write.
  explicit Signal(const char* name, unsigned width = default_width<T>(), T initial = T{})
      : SignalReader<T>(name), value_(initial), next_(initial), width_(width) {}

  /// Sets the value (from the writer's clock edge, or from a process).
  void write(T value) {
    if (!this->observed_) {
      value_ = value;
      return;
    }
    if (this->force_) value = forced(value);
    if (this->deferred_) {
      if (!this->queued_ && value == value_) return;
      next_ = value;
      if (!this->queued_) this->defer();
    } else if (value != value_) {
      value_ = value;
      this->changed();
    }
  }
  Signal& operator=(T value) {
    write(value);
    return *this;
  }

  T get() const { return value_; }
  operator T() const { return value_; }
  /// The address of the value.
  const T* place() const { return &value_; }
  /// The last value written, for the writer: others may not see it yet.
  T written() const { return this->queued_ ? next_ : value_; }

  unsigned width() const override { return width_; }
  /// For a wire whose width its ends say, before the simulation.
  void set_width(unsigned bits) { width_ = bits; }
  std::uint64_t bits() const override {
    if constexpr (std::is_floating_point_v<T>) {
      std::uint64_t pattern = 0;
      const double real = value_;
      std::memcpy(&pattern, &real, sizeof pattern);
      return pattern;
    } else {
      return static_cast<std::uint64_t>(value_);
    }
  }
  bool is_real() const override { return std::is_floating_point_v<T>; }
  bool can_be_forced() const override { return !std::is_floating_point_v<T>; }
  void drive_again() override {
    if (this->force_) write(driven_);
  }

  /// What SystemC sees.
  const T& read() const override { return this->shown_to_systemc_ ? shown_ : value_; }
  const T& get_data_ref() const override { return read(); }

 protected:
  bool show() const override {
    if (shown_ == value_) return false;
    shown_ = value_;
    return true;
  }
  void commit() override {
    this->queued_ = false;
    if (next_ == value_) return;
    value_ = next_;
    this->changed();
  }

 private:
  T forced(T value) {
    driven_ = value;
    if constexpr (std::is_floating_point_v<T>) {
      return value;
    } else {
      return static_cast<T>(this->force_->seen(static_cast<std::uint64_t>(value)));
    }
  }
  void forced_anew() override { driven_ = written(); }

  T value_;
  T next_;
  mutable T shown_{};  ///< to SystemC, if it reads the signal
  T driven_{};         ///< what the writer says, while the signal is forced
  unsigned width_;
};

/// What an input port knows besides its signal.
class InBase {
 public:
  InBase(const char* name, Clocked* owner);
  const std::string& name() const { return name_; }
  Clocked* owner() const { return owner_; }
  virtual SignalBase* signal() const = 0;

 protected:
  ~InBase() = default;
  /// What the follower of a foreign signal is called: "filter_sample".
  std::string follower_name() const;

 private:
  std::string name_;
  Clocked* owner_;
};

/// An input of a module: a bound signal, read by a plain load.
template <class T>
class In final : public InBase {
 public:
  /// `owner` is the clocked module that samples the port on its edges; null for a combinational
  /// reader.
  explicit In(const char* name, Clocked* owner = nullptr) : InBase(name, owner) {}
  void bind(Signal<T>& signal) { signal_ = &signal; }
  /// Of SystemC, driven by a foreign module; include <vp/systemc_pins.h>.
  template <class U>
  void bind(const sc_core::sc_signal_in_if<U>& foreign);
  template <class Channel>
  void operator()(Channel& channel) {
    bind(channel);
  }
  bool bound() const { return signal_ != nullptr; }
  T read() const { return signal_->get(); }
  operator T() const { return signal_->get(); }
  Signal<T>* signal() const override { return signal_; }

 private:
  Signal<T>* signal_ = nullptr;
  std::shared_ptr<sc_core::sc_object> follower_;  ///< of a foreign signal
};

/// An output of a module that drives a signal held elsewhere (a link). Outputs with a wire of their
/// own are Signals.
template <class T>
class Out {
 public:
  explicit Out(Clocked* owner) : owner_(owner) {}
  void bind(Signal<T>& signal) {
    signal_ = &signal;
    signal.set_writer(*owner_);
  }
  void operator()(Signal<T>& signal) { bind(signal); }
  bool bound() const { return signal_ != nullptr; }
  void write(T value) { signal_->write(value); }
  Out& operator=(T value) {
    signal_->write(value);
    return *this;
  }
  T get() const { return signal_->get(); }
  T written() const { return signal_->written(); }

 private:
  Clocked* owner_;
  Signal<T>* signal_ = nullptr;
};

}  // namespace vp
