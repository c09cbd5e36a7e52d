#pragma once

#include <cstdint>
#include <cstring>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pl/common/fidelity.h>
#include <pl/common/lanes.h>
#include <pl/common/rtl_interface.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/file.h>
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
  };
  struct Output {
    std::function<vp::SignalBase*()> port;  ///< known when all is bound
    std::string name;
    unsigned bits;
    std::function<bool()> valid;  ///< whether the port means something now; null: it always does
    bool optional;                ///< only reports and traces look at it: RTL may lack it
    std::function<void(std::uint64_t)> write;
    std::size_t clock = 0;  ///< on whose edges it changes
  };
  /// An output that a memory samples on each edge, as it stands before the edge.
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
  void input(const vp::In<T>& port, unsigned bits = vp::default_width<T>()) {
    inputs.push_back({&port, last_name(port.name()), bits, [&port] { return port.read(); },
                      [&port] { return port.signal()->place(); }});
  }
  /// A pin that the model has no port for.
  void input(const char* name, unsigned bits, std::function<std::uint64_t()> read) {
    inputs.push_back({nullptr, name, bits, std::move(read), {}});
  }
  /// The pixels that come on a clock.
  template <class T>
  void input(const vp::In<T>& port, const Lanes<vp::In<T>>& more) {
    input(port);
    for (const vp::In<T>& lane : more) input(lane);
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
         [port](std::uint64_t value) { port() = static_cast<T>(value); }, clocks.size() - 1});
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
  /// What the IP does besides on each edge of `clk` while RTL stands in its place; null: nothing.
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

/// Finds out when RTL has come to rest: an edge of each clock with the same inputs has left its
/// whole state as it was, so all further ones will. It takes a copy of the state, less often the
/// larger it is and the longer the RTL works on by itself.
class RtlRest {
 public:
  RtlRest(std::size_t state_bytes, std::size_t clocks)
      : state_(state_bytes), all_clocks_((1u << clocks) - 1), look_at_(first_look()) {}

  void inputs_changed() {
    same_ = 0;
    look_at_ = first_look();
  }
  /// Behind each edge: whether reached() is to be asked.
  bool due() { return ++same_ >= look_at_; }
  /// Whether no further edge would change anything. `risen`: the clocks of this one, a bit for
  /// each.
  bool reached(const void* state, unsigned risen) {
    if (same_ == look_at_) {
      std::memcpy(state_.data(), state, state_.size());
      clocks_seen_ = 0;
      return false;
    }
    if (std::memcmp(state_.data(), state, state_.size()) != 0) {
      look_at_ = 2 * same_;
      return false;
    }
    clocks_seen_ |= risen;
    return clocks_seen_ == all_clocks_;
  }

 private:
  /// A copy takes less than the clocks before it.
  std::uint64_t first_look() const { return 2 + state_.size() / 256; }

  std::vector<unsigned char> state_;
  unsigned all_clocks_, clocks_seen_ = 0;  ///< whose edges have changed nothing since the copy
  std::uint64_t same_ = 0;                 ///< edges since an input changed
  std::uint64_t look_at_;
};

/// The pins of a Verilated module, connected with the ports of the IP in whose place it stands.
class RtlPins {
 public:
  /// Loads `file` once; it stays loaded. Throws vp::InputError for one that is no RTL, or that of
  /// another IP than `ip`; for a port that is missing, of another width or direction, or that the
  /// IP does not have; and for another parameter: file, line, port, and what the IP expects.
  /// `instance`: the name of this one.
  RtlPins(const std::string& file, const std::string& ip, const std::string& instance,
          IpPorts ports);

  /// An edge of a clock: what stands on the inputs is sampled, and the registers of the RTL change.
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
    rtl_.eval(model_.get());
    for (std::size_t i = 0; i < memory_inputs_.size(); ++i)
      store(memory_inputs_[i], ports_.memory_inputs[i].bits, ports_.memory_inputs[i].read());
    lower();
    return true;
  }
  /// What is logic follows the inputs, between two edges.
  void settle() {
    take_inputs();
    rtl_.eval(model_.get());
  }
  /// Behind an edge: further ones would change nothing until an input changes.
  bool at_rest() {
    if (rtl_.state_bytes == 0 || !rest_.due()) return false;
    if (ports_.others_stand_still && !ports_.others_stand_still()) {
      rest_.inputs_changed();
      return false;
    }
    return rest_.reached(rtl_.state(model_.get()), risen_);
  }
  /// The ports of a clock follow the outputs of the RTL: those that changed are written.
  void drive(std::size_t clock = 0) {
    for (OutputPin& pin : outputs_) {
      const std::uint64_t now = load(pin.place, pin.bits);
      if ((pin.value == now && pin.driven) || pin.clock != clock) continue;
      pin.value = now;
      pin.driven = true;
      ports_.outputs[static_cast<std::size_t>(&pin - outputs_.data())].write(now);
    }
  }

  /// Those that the RTL has, with its widths.
  const IpPorts& ports() const { return ports_; }
  /// What the RTL gives at output `i`.
  std::uint64_t value(std::size_t i) const { return load(outputs_[i].place, outputs_[i].bits); }
  /// At output `i` to a memory.
  std::uint64_t memory_value(std::size_t i) const {
    return load(memory_outputs_[i], ports_.memory_outputs[i].bits);
  }
  const std::string& file() const { return file_; }

 private:
  /// As rtl_interface.h says.
  static void store(void* place, unsigned bits, std::uint64_t value) {
    if (bits <= 8) {
      *static_cast<std::uint8_t*>(place) = static_cast<std::uint8_t>(value);
    } else if (bits <= 16) {
      *static_cast<std::uint16_t*>(place) = static_cast<std::uint16_t>(value);
    } else if (bits <= 32) {
      *static_cast<std::uint32_t*>(place) = static_cast<std::uint32_t>(value);
    } else {
      *static_cast<std::uint64_t*>(place) = value;
    }
  }
  static std::uint64_t load(const void* place, unsigned bits) {
    if (bits <= 8) return *static_cast<const std::uint8_t*>(place);
    if (bits <= 16) return *static_cast<const std::uint16_t*>(place);
    if (bits <= 32) return *static_cast<const std::uint32_t*>(place);
    return *static_cast<const std::uint64_t*>(place);
  }
  void take_inputs() {
    if (!bound_) find_signals();
    for (InputPin& pin : inputs_) {
      const std::uint64_t now = pin.signal ? load(pin.signal, pin.bits) : (*pin.read)();
      if (pin.value == now) continue;
      pin.value = now;
      store(pin.place, pin.bits, now);
      rest_.inputs_changed();
    }
  }
  // What a memory shows behind the edge may change outputs while the clock is high.
  void lower() {
    if (rtl_.lower && memory_inputs_.empty()) return rtl_.lower(model_.get());
    for (std::uint8_t* level : levels_) *level = 0;
    rtl_.eval(model_.get());
  }
  void find_signals();
  void ask_memory();
  std::uint64_t now_ps() const;
  /// At this time, together with another one.
  bool has_risen(std::size_t clock) const { return risen_ps_[clock] == now_ps(); }
  void raise(std::size_t clock);
  void reset();
  void cycle_clocks();
  const RtlPort* find(const std::string& name) const;
  void* pin(const std::string& name, unsigned bits, bool output);
  void leave_out_what_it_lacks();
  void check(const IpPorts::Parameter& parameter) const;
  [[noreturn]] void refuse(const std::string& place, const std::string& why) const;

  const std::string file_;
  const std::string ip_;
  IpPorts ports_;
  const RtlDescriptor& rtl_;
  const std::unique_ptr<void, void (*)(void*)> model_;
  std::vector<std::uint8_t*> levels_;    ///< of the clocks
  std::vector<std::uint64_t> risen_ps_;  ///< when each rose last, where there are several
  unsigned risen_ = 1;                   ///< on the last edge, a bit for each clock
  std::vector<bool> connected_;          ///< by the number of the port
  // Each clock goes through them: what it needs stands together.
  struct InputPin {
    void* place;
    unsigned bits;
    const std::function<std::uint64_t()>* read;
    const void* signal = nullptr;  ///< where its value stands; null for a pin that is no port
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

/// RTL in the place of an IP, on the edges of its clocks. Nobody knows what its registers wait for:
/// its modules sleep while its whole state stands still, until an input changes. It listens only
/// then: the pixels of a frame tell nobody.
class RtlInPlace final : public vp::SignalListener {
 public:
  /// `modules`: that of each clock.
  RtlInPlace(const std::string& file, const std::string& ip, const std::string& instance,
             IpPorts ports, std::vector<vp::Clocked*> modules)
      : pins_(file, ip, instance, std::move(ports)), modules_(std::move(modules)) {}

  /// In edge() of a clock's module; true: it may sleep.
  bool edge(std::size_t clock = 0) {
    if (sleeping_) {  // since another clock's edge; the outputs of this one are behind it
      pins_.drive(clock);
      return true;
    }
    if (listening_) stop_listening();
    const IpPorts& ports = pins_.ports();
    if (clock == 0 && ports.before_edge) ports.before_edge();
    const bool evaluated = pins_.clock_edge(clock);
    pins_.drive(clock);
    if (clock == 0 && ports.behind_edge) ports.behind_edge();
    if (!evaluated || !pins_.at_rest()) return false;
    listen();
    return true;
  }
  /// An input has changed between two edges.
  void settle() {
    if (!pins_.ports().combinational) return;
    pins_.settle();
    pins_.drive();
  }

 private:
  void listen();
  void stop_listening();
  void on_change(vp::SignalBase&, std::uint32_t) override;

  RtlPins pins_;
  const std::vector<vp::Clocked*> modules_;
  bool listening_ = false;
  bool sleeping_ = false;  ///< listening, and no input has changed since
};

/// An IP as RTL.
template <class Ip>
class RtlModel final : public Ip {
 public:
  RtlModel(const char* name, const Site& site, const std::string& file)
      : Ip(name, site), rtl_(file, Ip::models().ip(), this->name(), ports(), {this}) {}

 private:
  IpPorts ports() {
    IpPorts ports(false, this->clock());
    this->connect(ports);
    return ports;
  }
  void edge() override {
    if (rtl_.edge()) this->sleep();
  }
  void on_change(vp::SignalBase& signal, std::uint32_t id) override {
    Ip::on_change(signal, id);
    rtl_.settle();
  }

  RtlInPlace rtl_;
};

/// The side of one clock of an IP as RTL that has several.
template <class Side>
class RtlSide final : public Side {
 public:
  RtlSide(const char* name, vp::Clock& clk) : Side(name, clk) {}
  /// Before the simulation.
  void play(RtlInPlace& rtl, std::size_t clock) {
    rtl_ = &rtl;
    clock_ = clock;
  }

 private:
  void edge() override {
    if (rtl_->edge(clock_)) this->sleep();
  }

  RtlInPlace* rtl_ = nullptr;
  std::size_t clock_ = 0;
};

/// Looks at the ports of a model before each edge, as whoever is bound to them does.
class PortTaps {
 public:
  PortTaps(const IpPorts& ports, vp::Clocked& owner);

 private:
  class Tap : public vp::InBase {
   public:
    Tap(std::function<vp::SignalBase*()> port, vp::Clocked& owner)
        : InBase("tap", &owner), port_(std::move(port)) {}
    vp::SignalBase* signal() const override { return port_(); }

   private:
    std::function<vp::SignalBase*()> port_;
  };
  std::deque<Tap> taps_;
};

/// Whoever watches the ports of a model: its edges are those of `clk`, and those of further clocks
/// reach it, too.
class PortWatcher : public vp::Clocked {
 public:
  PortWatcher(sc_core::sc_module_name name, const IpPorts& ports);

 protected:
  /// What stands at the ports of all clocks is that before the edge.
  virtual void edge_of(std::size_t clock) = 0;

 private:
  class Further final : public vp::Clocked {
   public:
    Further(PortWatcher& watcher, const IpPorts& ports, std::size_t clock)
        : Clocked(ports.clocks[clock].name.c_str(), *ports.clocks[clock].clock),
          watcher_(watcher),
          clock_(clock),
          taps_(ports, *this) {}

   private:
    void edge() override { watcher_.edge_of(clock_); }

    PortWatcher& watcher_;
    const std::size_t clock_;
    const PortTaps taps_;
  };
  void edge() override { edge_of(0); }

  const PortTaps taps_;
  std::deque<Further> further_;
};

/// RTL beside the model of its IP, on the same inputs. The first clock behind which an output
/// differs ends the simulation, some clocks later: a trace then shows what came of it. One that
/// ends before fails in sc_stop(). `rtl.<port>` is what the RTL gives.
class RtlShadow final : public PortWatcher {
 public:
  /// All pins are connected.
  RtlShadow(sc_core::sc_module_name name, RtlPins& pins);

  vp::Signal<bool> differs{"differs"};  ///< from the first difference on

 private:
  void edge_of(std::size_t clock) override;
  void end_of_simulation() override;
  void note_outputs(std::size_t clock);
  void compare(std::size_t clock);
  void compare(const std::string& port, unsigned bits, std::uint64_t model, std::uint64_t rtl);
  [[noreturn]] void fail() const;

  struct Edge {
    std::uint64_t number = 0, ps = 0;  ///< 0: none
  };
  RtlPins& pins_;
  std::deque<vp::Signal<std::uint64_t>> outputs_;  ///< as the pins have them
  std::vector<Edge> last_edges_;                   ///< of each clock, behind which they stand
  std::uint64_t edges_left_;
  std::string difference_;
};

/// Writes what stands at the ports of an IP, clock by clock, for test benches of its RTL: the files
/// stimulus.hex and response.hex, and bench.sv and bench.vhd, which play and compare them
/// (docs/rtl.md).
///
/// What an output need not be is X there: before the first reset, and while nothing is valid.
class RtlVectors final : public PortWatcher {
 public:
  /// `folder` exists. Throws vp::InputError for an IP with pins that are no ports of its model, or
  /// whose outputs follow its inputs within the clock.
  RtlVectors(sc_core::sc_module_name name, const std::string& ip, IpPorts ports,
             const std::string& folder);

 private:
  void edge_of(std::size_t clock) override;
  void end_of_simulation() override;
  void begin_line();
  void end_line();
  bool in_reset() const;

  const std::string ip_, folder_;
  const IpPorts ports_;
  vp::OutputFile stimulus_, response_;
  std::uint64_t lines_ = 0, line_ps_ = 0;
  bool was_reset_ = false;
  std::string inputs_;  ///< of the line that is not written yet,
  unsigned rises_ = 0;  ///< and the clocks that rise on it, the first one in the highest bit
};

/// The clocked model of an IP, and what watches its ports.
template <class Clocked>
class WatchedModel final : public Clocked {
 public:
  WatchedModel(sc_core::sc_module_name name, const Site& site, const RtlFile& rtl)
      : Clocked(name, site) {
    IpPorts ports(true, site.clk);
    this->connect(ports);
    const std::string ip = Clocked::models().ip();
    if (rtl.use == RtlFile::Use::vectors) {
      watcher_ = std::make_unique<RtlVectors>("vectors", ip, std::move(ports), rtl.path);
    } else {
      pins_.emplace(rtl.path, ip, this->name(), std::move(ports));
      watcher_ = std::make_unique<RtlShadow>("rtl", *pins_);
    }
  }

 private:
  std::optional<RtlPins> pins_;
  std::unique_ptr<PortWatcher> watcher_;
};

/// What an IP in whose place RTL can stand gives its list of models. `InPlace`: what stands there,
/// if that is not an `Ip` that is one module.
template <class Ip, class Clocked, class InPlace = RtlModel<Ip>>
typename Models<Ip>::MakeRtl rtl_model() {
  return [](const char* name, const Site& site, const RtlFile& rtl) -> std::unique_ptr<Ip> {
    if (rtl.use != RtlFile::Use::in_place)
      return std::make_unique<WatchedModel<Clocked>>(name, site, rtl);
    return std::make_unique<InPlace>(name, site, rtl.path);
  };
}

}  // namespace pl
