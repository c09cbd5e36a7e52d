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
/// the clock, which is `clk`.
class IpPorts {
 public:
  struct Input {
    const vp::InBase* port;  ///< null: a pin that is no port of the model
    std::string name;
    unsigned bits;
    std::function<std::uint64_t()> read;
  };
  struct Output {
    std::function<vp::SignalBase*()> port;  ///< known when all is bound
    std::string name;
    unsigned bits;
    std::function<bool()> valid;  ///< whether the port means something now; null: it always does
    bool optional;                ///< only reports and traces look at it: RTL may lack it
    std::function<void(std::uint64_t)> write;
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
  explicit IpPorts(bool beside_model) : watched(beside_model) {}
  const bool watched;

  template <class T>
  void input(const vp::In<T>& port, unsigned bits = vp::default_width<T>()) {
    inputs.push_back({&port, last_name(port.name()), bits, [&port] { return port.read(); }});
  }
  /// A pin that the model has no port for.
  void input(const char* name, unsigned bits, std::function<std::uint64_t()> read) {
    inputs.push_back({nullptr, name, bits, std::move(read)});
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
    outputs.push_back({[port]() -> vp::SignalBase* { return &port(); }, name, bits,
                       std::move(valid), false,
                       [port](std::uint64_t value) { port() = static_cast<T>(value); }});
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
  /// What the IP does besides on each edge while RTL stands in its place; null: nothing.
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
                       [&port](std::uint64_t bits) { port = static_cast<T>(bits); }});
  }
};

/// Adds the pins of a stream's master.
void add_stream(IpPorts& ports, vp::AxiStreamMaster& m);

/// Finds out when RTL has come to rest: a clock with the same inputs has left its whole state as it
/// was, so all further ones will. It takes a copy of the state, less often the larger it is and the
/// longer the RTL works on by itself.
class RtlRest {
 public:
  explicit RtlRest(std::size_t state_bytes) : state_(state_bytes), look_at_(first_look()) {}

  void inputs_changed() {
    same_ = 0;
    look_at_ = first_look();
  }
  /// Behind each clock: whether reached() is to be asked.
  bool due() { return ++same_ >= look_at_; }
  /// Whether the next clock would change nothing.
  bool reached(const void* state) {
    if (same_ == look_at_) {
      std::memcpy(state_.data(), state, state_.size());
      return false;
    }
    look_at_ *= 2;
    return std::memcmp(state_.data(), state, state_.size()) == 0;
  }

 private:
  /// A copy takes less than the clocks before it.
  std::uint64_t first_look() const { return 2 + state_.size() / 256; }

  std::vector<unsigned char> state_;
  std::uint64_t same_ = 0;  ///< clocks since an input changed
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

  /// What stands on the inputs is sampled, and the registers of the RTL change.
  void clock_edge() {
    take_inputs();
    if (!memory_outputs_.empty()) ask_memory();
    *clk_ = 1;
    rtl_.eval(model_.get());
    for (std::size_t i = 0; i < memory_inputs_.size(); ++i)
      store(memory_inputs_[i], ports_.memory_inputs[i].bits, ports_.memory_inputs[i].read());
    *clk_ = 0;
    rtl_.eval(model_.get());
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
    return rest_.reached(rtl_.state(model_.get()));
  }
  /// The ports follow the outputs of the RTL: those that changed are written.
  void drive() {
    for (std::size_t i = 0; i < after_.size(); ++i) {
      const std::uint64_t now = value(i);
      if (driven_[i] == now) continue;
      driven_[i] = now;
      ports_.outputs[i].write(now);
    }
  }

  /// Those that the RTL has, with its widths.
  const IpPorts& ports() const { return ports_; }
  /// What the RTL gives at output `i`.
  std::uint64_t value(std::size_t i) const { return load(after_[i], ports_.outputs[i].bits); }
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
    for (std::size_t i = 0; i < before_.size(); ++i) {
      const std::uint64_t now = ports_.inputs[i].read();
      if (taken_[i] == now) continue;
      taken_[i] = now;
      store(before_[i], ports_.inputs[i].bits, now);
      rest_.inputs_changed();
    }
  }
  void ask_memory();
  void reset();
  void cycle_clock();
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
  std::uint8_t* clk_ = nullptr;
  std::vector<bool> connected_;  ///< by the number of the port
  std::vector<void*> before_, after_, memory_outputs_, memory_inputs_;
  std::vector<std::uint64_t> taken_;                  ///< what the inputs have
  std::vector<std::optional<std::uint64_t>> driven_;  ///< what the ports have; none: nobody wrote
  RtlRest rest_;
};

/// Wakes RTL that is at rest when one of its inputs changes. It listens only while it is armed: the
/// pixels of a frame tell nobody.
class RtlAlarm final : public vp::SignalListener {
 public:
  RtlAlarm(vp::Clocked& sleeper, const IpPorts& ports) : sleeper_(sleeper), ports_(ports) {}
  void arm();
  void disarm();

 private:
  void on_change(vp::SignalBase&, std::uint32_t) override { sleeper_.wake(); }

  vp::Clocked& sleeper_;
  const IpPorts& ports_;
  bool armed_ = false;
};

/// An IP as RTL.
template <class Ip>
class RtlModel final : public Ip {
 public:
  RtlModel(const char* name, const Site& site, const std::string& file)
      : Ip(name, site), pins_(file, Ip::models().ip(), this->name(), ports()) {}

 private:
  IpPorts ports() {
    IpPorts ports(false);
    this->connect(ports);
    return ports;
  }
  // Nobody knows what its registers wait for: it sleeps while its whole state stands still.
  void edge() override {
    alarm_.disarm();
    if (pins_.ports().before_edge) pins_.ports().before_edge();
    pins_.clock_edge();
    pins_.drive();
    if (pins_.ports().behind_edge) pins_.ports().behind_edge();
    if (!pins_.at_rest()) return;
    alarm_.arm();
    this->sleep();
  }
  void on_change(vp::SignalBase& signal, std::uint32_t id) override {
    Ip::on_change(signal, id);
    if (!pins_.ports().combinational) return;
    pins_.settle();
    pins_.drive();
  }

  RtlPins pins_;
  RtlAlarm alarm_{*this, pins_.ports()};
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

/// RTL beside the model of its IP, on the same inputs. The first clock behind which an output
/// differs ends the simulation, some clocks later: a trace then shows what came of it. One that
/// ends before fails in sc_stop(). `rtl.<port>` is what the RTL gives.
class RtlShadow final : public vp::Clocked {
 public:
  /// All pins are connected.
  RtlShadow(sc_core::sc_module_name name, vp::Clock& clk, RtlPins& pins);

  vp::Signal<bool> differs{"differs"};  ///< from the first difference on

 private:
  void edge() override;
  void end_of_simulation() override;
  void note_outputs();
  void compare();
  void compare(const std::string& port, unsigned bits, std::uint64_t model, std::uint64_t rtl);
  [[noreturn]] void fail() const;

  RtlPins& pins_;
  const PortTaps taps_;
  std::deque<vp::Signal<std::uint64_t>> outputs_;  ///< as the pins have them
  std::uint64_t edge_ = 0, edge_ps_ = 0;           ///< behind which they stand; 0: none
  std::uint64_t edges_left_;
  std::string difference_;
};

/// Writes what stands at the ports of an IP, clock by clock, for test benches of its RTL: the files
/// stimulus.hex and response.hex, and bench.sv and bench.vhd, which play and compare them
/// (docs/rtl.md).
///
/// What an output need not be is X there: before the first reset, and while nothing is valid.
class RtlVectors final : public vp::Clocked {
 public:
  /// `folder` exists. Throws vp::InputError for an IP with pins that are no ports of its model, or
  /// whose outputs follow its inputs within the clock.
  RtlVectors(sc_core::sc_module_name name, vp::Clock& clk, const std::string& ip, IpPorts ports,
             const std::string& folder);

 private:
  void edge() override;
  void end_of_simulation() override;
  void write_response();
  bool in_reset() const;

  const std::string ip_, folder_;
  const IpPorts ports_;
  const PortTaps taps_;
  vp::OutputFile stimulus_, response_;
  std::uint64_t clocks_ = 0;
  bool was_reset_ = false;
  std::string line_;
};

/// The clocked model of an IP, and what watches its ports.
template <class Clocked>
class WatchedModel final : public Clocked {
 public:
  WatchedModel(sc_core::sc_module_name name, const Site& site, const RtlFile& rtl)
      : Clocked(name, site) {
    IpPorts ports(true);
    this->connect(ports);
    const std::string ip = Clocked::models().ip();
    if (rtl.use == RtlFile::Use::vectors) {
      watcher_ = std::make_unique<RtlVectors>("vectors", site.clk, ip, std::move(ports), rtl.path);
    } else {
      pins_.emplace(rtl.path, ip, this->name(), std::move(ports));
      watcher_ = std::make_unique<RtlShadow>("rtl", site.clk, *pins_);
    }
  }

 private:
  std::optional<RtlPins> pins_;
  std::unique_ptr<vp::Clocked> watcher_;
};

/// What an IP in whose place RTL can stand gives its list of models. `Bare`: what the RTL stands
/// behind, if that is more than the ports that `Ip` has.
template <class Ip, class Clocked, class Bare = Ip>
typename Models<Ip>::MakeRtl rtl_model() {
  return [](const char* name, const Site& site, const RtlFile& rtl) -> std::unique_ptr<Ip> {
    if (rtl.use != RtlFile::Use::in_place)
      return std::make_unique<WatchedModel<Clocked>>(name, site, rtl);
    return std::make_unique<RtlModel<Bare>>(name, site, rtl.path);
  };
}

}  // namespace pl
