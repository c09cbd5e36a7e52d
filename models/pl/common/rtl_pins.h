#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pl/common/lanes.h>
#include <pl/common/rtl_object.h>
#include <pl/common/rtl_rest.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/signal.h>

namespace pl {

/// The pins of an IP as RTL in its place has them. Its function `connect(IpPorts&)` lists all but
/// the clock, which is `clk`; an IP between two clocks names the other one, too.
class IpPorts {
 public:
  struct ClockPin {
    std::string name;
    vp::Clock* clock;
  };
  struct Input {
    const vp::InBase* port;  ///< null: a pin that is no port of the model
    std::string name;
    unsigned bits;
    std::function<std::uint64_t()> read;
    std::function<const void*()> place;  ///< of a port's value, known when all is bound
    // For a bench that has the IP alone; empty for a pin that is no port.
    std::function<void(std::uint64_t)> write = {};  ///< to the signal that the port is bound to
    /// Makes a signal of the port's name and binds the port to it.
    std::function<std::unique_ptr<vp::SignalBase>()> bind = {};
  };
  struct Output {
    std::function<vp::SignalBase*()> port;  ///< known when all is bound
    std::string name;
    unsigned bits;
    std::function<bool()> valid;  ///< whether the port means something now; null: it always does
    bool optional;                ///< only reports and traces look at it: RTL may lack it
    std::function<void(std::uint64_t)> write;
    std::size_t clock = 0;   ///< on whose edges it changes
    bool of_link = false;    ///< it is a wire that lies outside of the IP
    bool fixed = false;      ///< the model never changes it
    bool unwritten = false;  ///< no reset gives it a value: it means something once it is written
  };
  /// An output that a memory samples on each edge, as it was before the edge.
  struct MemoryOutput {
    std::string name;
    unsigned bits;
    std::function<void(std::uint64_t)> take;
    std::function<std::optional<std::uint64_t>()> expected;  ///< of the model; none: anything
  };
  struct Parameter {
    std::string name;
    std::string key;  ///< of the configuration
    std::uint64_t value;
    bool usual;  ///< what a module has that has no such parameter: benches do not name it
  };
  /// A pin for a pixel that does not come: RTL that may be built for more may have it. An input
  /// stays 0, an output has no meaning.
  struct IdlePin {
    std::string name;
    unsigned bits;
    bool output;
  };

  /// `beside_model`: the RTL watches what the model sees and changes nothing.
  IpPorts(bool beside_model, vp::Clock& clk) : watched(beside_model), clocks{{"clk", &clk}} {}
  const bool watched;

  /// Another clock: the outputs named from here on are its own.
  void clock(const char* name, vp::Clock& clock) { clocks.push_back({name, &clock}); }

  template <class T>
  void input(vp::In<T>& port, unsigned bits = vp::default_width<T>()) {
    const std::string name = last_name(port.name());
    inputs.push_back({&port, name, bits, [&port] { return port.read(); },
                      [&port] { return port.signal()->place(); },
                      [&port](std::uint64_t value) { *port.signal() = static_cast<T>(value); },
                      [&port, name, bits] {
                        auto signal = std::make_unique<vp::Signal<T>>(name.c_str(), bits);
                        port.bind(*signal);
                        return signal;
                      }});
  }
  /// A pin that the model has no port for.
  void input(const char* name, unsigned bits, std::function<std::uint64_t()> read) {
    inputs.push_back({nullptr, name, bits, std::move(read), {}});
  }
  /// The pixels that come on a clock.
  template <class T>
  void input(vp::In<T>& port, Lanes<vp::In<T>>& more) {
    input(port);
    for (vp::In<T>& lane : more) input(lane);
    add_idle(last_name(port.name()), more.size(), vp::default_width<T>(), false);
  }
  /// `valid`: the signal beside which the port means something; null: it always does.
  template <class T>
  void output(vp::Signal<T>& port, const vp::Signal<bool>* valid = nullptr) {
    add(last_name(port.name()).c_str(), port, valid, false);
  }
  /// The pixels that leave on a clock.
  template <class T>
  void output(vp::Signal<T>& port, Lanes<vp::Signal<T>>& more, const vp::Signal<bool>* valid) {
    output(port, valid);
    for (vp::Signal<T>& lane : more) output(lane, valid);
    add_idle(last_name(port.name()), more.size(), port.width(), true);
  }
  /// The last output is a register that needs no reset: its readers wait until it is written.
  void means_nothing_until_written() { outputs.back().unwritten = true; }
  /// Under another name than the port's.
  template <class T>
  void output(const char* name, vp::Signal<T>& port) {
    add(name, port, nullptr, false);
  }
  /// Of a link, which is known when all is bound.
  template <class T>
  void output(const char* name, unsigned bits, std::function<vp::Signal<T>&()> port,
              std::function<bool()> valid = nullptr) {
    outputs.push_back(
        {[port]() -> vp::SignalBase* { return &port(); }, name, bits, std::move(valid), false,
         [port](std::uint64_t value) { port() = static_cast<T>(value); }, clocks.size() - 1, true});
  }
  /// An output that only reports and traces look at: RTL may lack it, or have fewer bits.
  template <class T>
  void report(vp::Signal<T>& port) {
    add(last_name(port.name()).c_str(), port, nullptr, true);
  }
  /// What the IP is configured for; RTL that has no such parameter is trusted to fit.
  void parameter(const char* name, const std::string& key, std::uint64_t value) {
    parameters.push_back({name, key, value, false});
  }
  void pixels_per_clock(std::uint32_t value) {
    parameters.push_back({"PIXELS_PER_CLOCK", "pl.pixels_per_clock", value, value == 1});
  }

  std::vector<ClockPin> clocks;
  std::vector<Input> inputs;
  std::vector<Output> outputs;
  std::vector<Parameter> parameters;
  std::vector<IdlePin> idle_pins;
  std::vector<MemoryOutput> memory_outputs;
  std::vector<Input> memory_inputs;  ///< what the memory shows behind the edge
  bool combinational = false;        ///< outputs follow inputs within the clock
  /// Whether pins that are no ports of the model stand still until one of its ports changes; null:
  /// there are none.
  std::function<bool()> others_stand_still;
  /// What the IP does besides on each edge of `clk` while RTL replaces it; null: nothing.
  std::function<void()> before_edge, behind_edge;

 private:
  static std::string last_name(const std::string& path) { return path.substr(path.rfind('.') + 1); }
  void add_idle(const std::string& pixel, std::size_t more, unsigned bits, bool output) {
    for (auto lane = static_cast<std::uint32_t>(more) + 1; lane < most_pixels_per_clock; ++lane)
      idle_pins.push_back({lane_name(pixel, lane), bits, output});
  }
  template <class T>
  void add(const char* name, vp::Signal<T>& port, const vp::Signal<bool>* valid, bool optional) {
    std::function<bool()> is_valid;
    if (valid) is_valid = [valid] { return valid->get(); };
    outputs.push_back({[&port]() -> vp::SignalBase* { return &port; }, name, port.width(),
                       std::move(is_valid), optional,
                       [&port](std::uint64_t bits) { port = static_cast<T>(bits); },
                       clocks.size() - 1});
  }
};

/// Adds the pins of a stream's master.
void add_stream(IpPorts& ports, vp::AxiStreamMaster& m);

/// The pins of a Verilated module, connected with the ports of the IP that it replaces.
class RtlPins {
 public:
  /// Loads `file` once; it stays loaded. Throws vp::InputError for one that is no RTL, or that of
  /// another IP than `ip`; for a port that is missing, of another width or direction, or that the
  /// IP does not have; and for another parameter: file, line, port, and what the IP expects.
  /// `instance`: the name of this one. Registers without reset start as `seed` says
  /// (rtl_interface.h).
  RtlPins(const std::string& file, std::uint64_t seed, const std::string& ip,
          const std::string& instance, IpPorts ports);

  /// An edge of a clock: what is on the inputs is sampled, and the registers of the RTL change.
  /// Clocks whose edges coincide rise together, as the first of them is called for. False: this one
  /// has risen with another.
  bool clock_edge(std::size_t clock = 0) {
    if (levels_.size() > 1 && has_risen(clock)) return false;
    take_inputs();
    if (!memory_outputs_.empty()) ask_memory();
    if (levels_.size() == 1) {
      *levels_[0] = 1;
    } else {
      raise(clock);
    }
    evaluate();
    for (std::size_t i = 0; i < memory_inputs_.size(); ++i)
      store_pin(memory_inputs_[i], ports_.memory_inputs[i].bits, ports_.memory_inputs[i].read());
    lower();
    return true;
  }
  /// What is logic follows the inputs, between two edges.
  void settle() {
    take_inputs();
    evaluate();
  }
  /// Its last word, behind the last edge.
  void finish() { object_.finish(); }
  /// Behind an edge: further ones would change nothing until an input changes.
  bool at_rest() {
    if (object_.descriptor().state_bytes == 0 || !rest_.due()) return false;
    if (ports_.others_stand_still && !ports_.others_stand_still()) {
      rest_.inputs_changed();
      return false;
    }
    return rest_.reached(object_.state(), risen_);
  }
  /// The ports of a clock follow the outputs of the RTL: those that changed are written.
  void drive(std::size_t clock = 0) {
    for (OutputPin& pin : outputs_) {
      const std::uint64_t now = load_pin(pin.place, pin.bits);
      if ((pin.value == now && pin.driven) || pin.clock != clock) continue;
      pin.value = now;
      pin.driven = true;
      ports_.outputs[static_cast<std::size_t>(&pin - outputs_.data())].write(now);
    }
  }

  /// Those that the RTL has, with its widths.
  const IpPorts& ports() const { return ports_; }
  /// What the RTL gives at output `i`.
  std::uint64_t value(std::size_t i) const { return load_pin(outputs_[i].place, outputs_[i].bits); }
  /// At output `i` to a memory.
  std::uint64_t memory_value(std::size_t i) const {
    return load_pin(memory_outputs_[i], ports_.memory_outputs[i].bits);
  }
  const std::string& file() const { return object_.file(); }
  /// Of registers without reset: "0", "1", "random values (seed 1000)".
  std::string start() const { return object_.start(); }
  /// Nothing for RTL that counts none.
  void write_coverage(const std::string& file) const { object_.write_coverage(file); }
  /// What it is built from.
  vp::IpEstimate::Foreign foreign() const { return object_.foreign(); }

 private:
  void take_inputs() {
    if (!bound_) find_signals();
    for (InputPin& pin : inputs_) {
      const std::uint64_t now = pin.signal ? load_pin(pin.signal, pin.bits) : (*pin.read)();
      if (pin.value == now) continue;
      pin.value = now;
      store_pin(pin.place, pin.bits, now);
      rest_.inputs_changed();
    }
  }
  // What a memory shows behind the edge may change outputs while the clock is high.
  void lower() {
    if (object_.lowers() && memory_inputs_.empty()) return object_.lower();
    for (std::uint8_t* level : levels_) *level = 0;
    evaluate();
  }
  void evaluate() { object_.evaluate(); }
  void find_signals();
  void ask_memory();
  std::uint64_t now_ps() const;
  /// At this time, together with another one.
  bool has_risen(std::size_t clock) const { return risen_ps_[clock] == now_ps(); }
  void raise(std::size_t clock);
  void reset();
  void cycle_clocks();
  const RtlPort* find(const std::string& name) const { return object_.find(name); }
  void* pin(const std::string& name, unsigned bits, bool output);
  void leave_out_what_it_lacks();
  void check(const IpPorts::Parameter& parameter) const;
  [[noreturn]] void refuse(const std::string& place, const std::string& why) const;

  const std::string ip_;
  IpPorts ports_;
  const RtlObject object_;
  std::vector<std::uint8_t*> levels_;    ///< of the clocks
  std::vector<std::uint64_t> risen_ps_;  ///< when each rose last, where there are several
  unsigned risen_ = 1;                   ///< on the last edge, a bit for each clock
  std::vector<bool> connected_;          ///< by the number of the port
  // Each clock goes through them: what it needs is together.
  struct InputPin {
    void* place;
    unsigned bits;
    const std::function<std::uint64_t()>* read;
    const void* signal = nullptr;  ///< where its value is kept; null for a pin that is no port
    std::uint64_t value = 0;
  };
  struct OutputPin {
    const void* place;
    unsigned bits;
    std::size_t clock;
    std::uint64_t value = 0;
    bool driven = false;  ///< the port has `value`
  };
  std::vector<InputPin> inputs_;    ///< as in ports_
  bool bound_ = false;              ///< their signals are known
  std::vector<OutputPin> outputs_;  ///< as in ports_
  std::vector<void*> memory_outputs_, memory_inputs_;
  RtlRest rest_;
};

}  // namespace pl
