#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <pl/common/fidelity.h>
#include <pl/common/rtl_pins.h>
#include <pl/common/rtl_use.h>
#include <vp/clock.h>
#include <vp/file.h>
#include <vp/parameter.h>
#include <vp/signal.h>

namespace pl {

/// RTL in the place of an IP, on the edges of its clocks. What its registers wait for is unknown:
/// its modules sleep while its whole state rests, until an input changes. It listens only
/// then: the pixels of a frame give no notice.
class RtlInPlace final : public vp::SignalListener {
 public:
  /// `modules`: that of each clock.
  RtlInPlace(const RtlFile& file, const std::string& ip, const std::string& instance, IpPorts ports,
             std::vector<vp::Clocked*> modules)
      : pins_(file.path, file.seed, ip, instance, std::move(ports)), modules_(std::move(modules)) {}

  /// Of an IP that is a part of reports: what it is built from, and the figures that the user
  /// gives. Call it once, while the IP is built and is the parent of what is made.
  vp::IpEstimate::Foreign foreign() {
    vp::IpEstimate::Foreign foreign = pins_.foreign();
    foreign.figures =
        figures_
            .emplace("figures", "", vp::Source::decision,
                     "what synthesis makes of this RTL: a file of 'markervp rtl synth --output'; "
                     "by default <name>.figures.json beside the object")
            .get();
    return foreign;
  }

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
  /// At the end of the simulation.
  void finish() { pins_.finish(); }

 private:
  void listen();
  void stop_listening();
  void on_change(vp::SignalBase&, std::uint32_t) override;

  RtlPins pins_;
  std::optional<vp::Parameter<std::string>> figures_;
  const std::vector<vp::Clocked*> modules_;
  bool listening_ = false;
  bool sleeping_ = false;  ///< listening, and no input has changed since
};

/// An IP as RTL.
template <class Ip>
class RtlModel final : public Ip {
 public:
  RtlModel(const char* name, const Site& site, const RtlFile& file)
      : Ip(name, site), rtl_(file, Ip::models().ip(), this->name(), ports(), {this}) {
    if constexpr (std::is_base_of_v<vp::Ip, Ip>) {
      const vp::HierarchyScope inside(*this);
      this->set_foreign(rtl_.foreign());
    }
  }

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
  void end_of_simulation() override {
    Ip::end_of_simulation();
    rtl_.finish();
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

/// Looks at the ports of a model before each edge, as a module bound to them does.
class PortTaps {
 public:
  PortTaps(const IpPorts& ports, vp::Clocked& owner);

 private:
  class Tap final : public vp::InBase {
   public:
    Tap(std::function<vp::SignalBase*()> port, vp::Clocked& owner)
        : InBase("tap", &owner), port_(std::move(port)) {}
    vp::SignalBase* signal() const override { return port_(); }

   private:
    std::function<vp::SignalBase*()> port_;
  };
  std::deque<Tap> taps_;
};

/// Watches the ports of a model: its edges are those of `clk`, and those of further clocks
/// reach it, too.
class PortWatcher : public vp::Clocked {
 public:
  PortWatcher(sc_core::sc_module_name name, const IpPorts& ports);

 protected:
  /// What is at the ports of all clocks is that before the edge.
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

/// RTL beside the model of its IP, on the same inputs: once for each start of its registers
/// without reset (`starts`). The first clock behind which an output
/// differs ends the simulation, some clocks later: a trace then shows what came of it. One that
/// ends before fails in sc_stop(). `rtl.<port>` is what the RTL gives; `rtl.model.<port>` what the
/// model does, where that is a wire outside of the IP.
class RtlShadow final : public PortWatcher {
 public:
  /// Seeds of the copies that run for RTL with `seed`: zeros, ones, and random values.
  static std::vector<std::uint64_t> starts(std::uint64_t seed) { return {0, 1, seed, seed + 1}; }

  /// All pins of the copies are connected. There is at least one.
  RtlShadow(sc_core::sc_module_name name, std::deque<RtlPins>& copies);

  vp::Signal<bool> differs{"differs"};  ///< from the first difference on

 private:
  struct Wires : sc_core::sc_module {
    Wires(sc_core::sc_module_name name, const IpPorts& ports);
    std::deque<vp::Signal<std::uint64_t>> list;
  };
  void edge_of(std::size_t clock) override;
  void end_of_elaboration() override;
  void end_of_simulation() override;
  void on_change(vp::SignalBase& signal, std::uint32_t wire) override;
  struct Copy {
    RtlPins* pins;
    std::vector<std::uint64_t> outputs;  ///< behind the last edge of their clocks
  };
  void note_outputs(Copy& copy, std::size_t clock);
  void show(const Copy& copy);
  void compare(std::size_t clock);
  void compare(Copy& copy, std::size_t clock);
  void note_use(std::size_t clock);
  void compare(const std::string& port, unsigned bits, std::uint64_t model, std::uint64_t rtl);
  [[noreturn]] void fail() const;

  struct Edge {
    std::uint64_t number = 0, ps = 0;  ///< 0: none
  };
  const IpPorts& ports_;  ///< as the RTL has them
  std::vector<Copy> copies_;
  const Copy* shown_;                              ///< the first one, or that which differs
  std::deque<vp::Signal<std::uint64_t>> outputs_;  ///< of the copy that is shown
  Wires model_;                                    ///< of links, as the model drives them
  std::vector<Edge> last_edges_;                   ///< of each clock, behind which they stand
  LockstepUse use_;                                ///< inputs, outputs, outputs to memories
  struct Handshake {
    std::size_t clock;
    std::function<std::uint64_t()> valid, ready;
  };
  std::vector<Handshake> handshakes_;  ///< of use_.streams
  void find_streams();
  std::uint64_t edges_left_;
  std::string difference_;
};

/// Writes what is at the ports of an IP, clock by clock, for test benches of its RTL: the files
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

/// A model that shows its ports, for a bench that has it alone.
class ShownPorts {
 public:
  virtual ~ShownPorts() = default;
  virtual const IpPorts& ports() const = 0;
};

/// The clocked model of an IP, and what watches its ports.
template <class Clocked>
class WatchedModel final : public Clocked, public ShownPorts {
 public:
  WatchedModel(sc_core::sc_module_name name, const Site& site, const RtlFile& rtl)
      : Clocked(name, site), ports_(true, site.clk) {
    this->connect(ports_);
    const std::string ip = Clocked::models().ip();
    if (rtl.use == RtlFile::Use::vectors) {
      watcher_ = std::make_unique<RtlVectors>("vectors", ip, ports_, rtl.path);
    } else {
      for (const std::uint64_t seed : RtlShadow::starts(rtl.seed))
        copies_.emplace_back(rtl.path, seed, ip, this->name(), ports_);
      watcher_ = std::make_unique<RtlShadow>("rtl", copies_);
    }
  }
  const IpPorts& ports() const override { return ports_; }

 private:
  IpPorts ports_;
  std::deque<RtlPins> copies_;
  std::unique_ptr<PortWatcher> watcher_;
};

/// What an IP that RTL can replace gives its list of models. `InPlace`: what is there,
/// if that is not an `Ip` that is one module.
template <class Ip, class Clocked, class InPlace = RtlModel<Ip>>
typename Models<Ip>::MakeRtl rtl_model() {
  return [](const char* name, const Site& site, const RtlFile& rtl) -> std::unique_ptr<Ip> {
    if (rtl.use != RtlFile::Use::in_place)
      return std::make_unique<WatchedModel<Clocked>>(name, site, rtl);
    return std::make_unique<InPlace>(name, site, rtl);
  };
}

}  // namespace pl
