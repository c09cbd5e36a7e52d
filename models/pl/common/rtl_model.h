#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pl/common/fidelity.h>
#include <pl/common/rtl_interface.h>
#include <vp/output_file.h>
#include <vp/signal.h>

namespace pl {

/// The ports of an IP as RTL in its place has them. Its function `connect(IpPorts&)` lists all but
/// the clock, which is `clk`.
class IpPorts {
 public:
  struct Input {
    const vp::InBase* port;
    std::string name;
    unsigned bits;
    std::function<std::uint64_t()> read;
  };
  struct Output {
    vp::SignalBase* port;
    std::string name;
    unsigned bits;
    const vp::Signal<bool>* valid;  ///< the port means something while this is high; null: always
    bool optional;                  ///< only reports and traces look at it: RTL may lack it
    std::function<void(std::uint64_t)> write;
  };
  struct Parameter {
    std::string name;
    std::string key;  ///< of the configuration
    std::uint64_t value;
  };

  template <class T>
  void input(const vp::In<T>& port, unsigned bits = vp::default_width<T>()) {
    inputs.push_back({&port, last_name(port.name()), bits, [&port] { return port.read(); }});
  }
  /// `valid`: the signal beside which the port means something; null: it always does.
  template <class T>
  void output(vp::Signal<T>& port, const vp::Signal<bool>* valid = nullptr) {
    add(port, valid, false);
  }
  /// An output that only reports and traces look at: RTL may lack it, or have fewer bits.
  template <class T>
  void report(vp::Signal<T>& port) {
    add(port, nullptr, true);
  }
  /// What the IP is configured for; RTL that has no such parameter is trusted to fit.
  void parameter(const char* name, const std::string& key, std::uint64_t value) {
    parameters.push_back({name, key, value});
  }

  std::vector<Input> inputs;
  std::vector<Output> outputs;
  std::vector<Parameter> parameters;

 private:
  static std::string last_name(const std::string& path) { return path.substr(path.rfind('.') + 1); }
  template <class T>
  void add(vp::Signal<T>& port, const vp::Signal<bool>* valid, bool optional) {
    outputs.push_back({&port, last_name(port.name()), port.width(), valid, optional,
                       [&port](std::uint64_t bits) { port = static_cast<T>(bits); }});
  }
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
    for (std::size_t i = 0; i < before_.size(); ++i)
      store(before_[i], ports_.inputs[i].bits, ports_.inputs[i].read());
    *clk_ = 1;
    rtl_.eval(model_.get());
    *clk_ = 0;
    rtl_.eval(model_.get());
  }
  /// The ports follow the outputs of the RTL.
  void drive() {
    for (std::size_t i = 0; i < after_.size(); ++i) ports_.outputs[i].write(value(i));
  }

  /// Those that the RTL has, with its widths.
  const IpPorts& ports() const { return ports_; }
  /// What the RTL gives at output `i`.
  std::uint64_t value(std::size_t i) const { return load(after_[i], ports_.outputs[i].bits); }
  const std::string& file() const { return file_; }

 private:
  static void store(void* place, unsigned bits, std::uint64_t value);
  static std::uint64_t load(const void* place, unsigned bits);
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
  std::vector<void*> before_, after_;
};

/// An IP as RTL.
template <class Ip>
class RtlModel final : public Ip {
 public:
  RtlModel(const char* name, const Site& site, const std::string& file)
      : Ip(name, site), pins_(file, Ip::models().ip(), this->name(), ports()) {}

 private:
  IpPorts ports() {
    IpPorts ports;
    this->connect(ports);
    return ports;
  }
  // Nobody knows what its registers wait for: it never sleeps.
  void edge() override {
    pins_.clock_edge();
    pins_.drive();
  }

  RtlPins pins_;
};

/// Looks at the ports of a model before each edge, as whoever is bound to them does.
class PortTaps {
 public:
  PortTaps(const IpPorts& ports, vp::Clocked& owner);

 private:
  class Tap : public vp::InBase {
   public:
    Tap(vp::SignalBase* output, const vp::InBase* input, vp::Clocked& owner)
        : InBase("tap", &owner), output_(output), input_(input) {}
    vp::SignalBase* signal() const override { return input_ ? input_->signal() : output_; }

   private:
    vp::SignalBase* output_;
    const vp::InBase* input_;
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
  void compare();
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
  /// `folder` exists.
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
    IpPorts ports;
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

/// What an IP in whose place RTL can stand gives its list of models.
template <class Ip, class Clocked>
typename Models<Ip>::MakeRtl rtl_model() {
  return [](const char* name, const Site& site, const RtlFile& rtl) -> std::unique_ptr<Ip> {
    if (rtl.use != RtlFile::Use::in_place)
      return std::make_unique<WatchedModel<Clocked>>(name, site, rtl);
    return std::make_unique<RtlModel<Ip>>(name, site, rtl.path);
  };
}

}  // namespace pl
