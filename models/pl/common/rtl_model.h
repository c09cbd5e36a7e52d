#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <pl/common/fidelity.h>
#include <pl/common/rtl_interface.h>
#include <vp/signal.h>

namespace pl {

/// The pins of a Verilated module, connected with the ports of the IP in whose place it stands.
///
/// Each call checks one port: vp::InputError says file, line, port, and what the IP expects.
class RtlPins {
 public:
  /// An output of the RTL, and the port of the IP that has its name.
  struct Output {
    vp::SignalBase& port;
    const vp::Signal<bool>* valid;  ///< the port means something while this is high; null: always
    const void* place;
    unsigned bits;
    std::uint64_t value() const { return load(place, bits); }
  };

  /// Loads `file` once; it stays loaded. Refuses one that is no RTL, or that of another IP than
  /// `ip`. `instance`: the name of this one.
  RtlPins(const std::string& file, const std::string& ip, const std::string& instance);

  void clock(const char* name);
  template <class T>
  void input(const vp::In<T>& port, unsigned bits = vp::default_width<T>()) {
    void* place = pin(last_name(port.name()), bits, false);
    inputs_.push_back(&port);
    before_.push_back([&port, place, bits] { store(place, bits, port.read()); });
  }
  /// `valid`: the signal beside which the port means something; null: it always does.
  template <class T>
  void output(vp::Signal<T>& port, const vp::Signal<bool>* valid = nullptr) {
    connect(port, valid, pin(last_name(port.name()), port.width(), true), port.width());
  }
  /// An output that only reports and traces look at: RTL may lack it, or have fewer bits.
  template <class T>
  void report(vp::Signal<T>& port) {
    const RtlPort* found = find(last_name(port.name()));
    if (!found) return;
    const unsigned bits = std::min<unsigned>(found->bits, port.width());
    connect(port, nullptr, pin(found->name, bits, true), bits);
  }
  /// What the IP is configured for; RTL that has no such parameter is trusted to fit.
  /// `key`: of the configuration.
  void parameter(const char* name, const std::string& key, std::uint64_t value) const;
  /// Refuses ports that the IP does not have.
  void complete() const;

  /// What stands on the inputs is sampled, and the registers of the RTL change.
  void clock_edge() {
    for (const auto& move : before_) move();
    *clk_ = 1;
    rtl_.eval(model_.get());
    *clk_ = 0;
    rtl_.eval(model_.get());
  }
  /// The ports follow the outputs of the RTL.
  void drive() {
    for (const auto& move : after_) move();
  }

  const std::vector<const vp::InBase*>& inputs() const { return inputs_; }
  const std::vector<Output>& outputs() const { return outputs_; }
  const std::string& file() const { return file_; }

 private:
  static std::string last_name(const std::string& path);
  static void store(void* place, unsigned bits, std::uint64_t value);
  static std::uint64_t load(const void* place, unsigned bits);
  const RtlPort* find(const std::string& name) const;
  void* pin(const std::string& name, unsigned bits, bool output);
  [[noreturn]] void refuse(const std::string& place, const std::string& why) const;
  template <class T>
  void connect(vp::Signal<T>& port, const vp::Signal<bool>* valid, const void* place,
               unsigned bits) {
    outputs_.push_back({port, valid, place, bits});
    after_.push_back([&port, place, bits] { port = static_cast<T>(load(place, bits)); });
  }

  const std::string file_;
  const std::string ip_;
  const RtlDescriptor& rtl_;
  const std::unique_ptr<void, void (*)(void*)> model_;
  std::uint8_t* clk_ = nullptr;
  std::vector<bool> connected_;  ///< by the number of the port
  std::vector<std::function<void()>> before_, after_;
  std::vector<const vp::InBase*> inputs_;
  std::vector<Output> outputs_;
};

/// An IP as RTL. `Ip` has a function `connect(RtlPins&)`, for all ports but the clock.
template <class Ip>
class RtlModel final : public Ip {
 public:
  RtlModel(const char* name, const Site& site, const std::string& file)
      : Ip(name, site), pins_(file, Ip::models().ip(), this->name()) {
    pins_.clock("clk");
    this->connect(pins_);
    pins_.complete();
  }

 private:
  // Nobody knows what its registers wait for: it never sleeps.
  void edge() override {
    pins_.clock_edge();
    pins_.drive();
  }

  RtlPins pins_;
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
  /// Looks at a port of the model before the edge, as whoever is bound to it does.
  class Tap : public vp::InBase {
   public:
    Tap(vp::SignalBase* output, const vp::InBase* input, RtlShadow& owner)
        : InBase("tap", &owner), output_(output), input_(input) {}
    vp::SignalBase* signal() const override { return input_ ? input_->signal() : output_; }

   private:
    vp::SignalBase* output_;
    const vp::InBase* input_;
  };

  void edge() override;
  void end_of_simulation() override;
  void compare();
  [[noreturn]] void fail() const;

  RtlPins& pins_;
  std::deque<Tap> taps_;
  std::deque<vp::Signal<std::uint64_t>> outputs_;  ///< as pins_.outputs()
  std::uint64_t edge_ = 0, edge_ps_ = 0;           ///< behind which they stand; 0: none
  std::uint64_t edges_left_;
  std::string difference_;
};

/// The clocked model of an IP, watched by a shadow.
template <class Clocked>
class LockstepModel final : public Clocked {
 public:
  LockstepModel(sc_core::sc_module_name name, const Site& site, const std::string& file)
      : Clocked(name, site),
        pins_(file, Clocked::models().ip(), this->name()),
        shadow_("rtl", site.clk, connected()) {}

 private:
  RtlPins& connected() {
    pins_.clock("clk");
    this->connect(pins_);
    pins_.complete();
    return pins_;
  }

  RtlPins pins_;
  RtlShadow shadow_;
};

/// What an IP in whose place RTL can stand gives its list of models.
template <class Ip, class Clocked>
typename Models<Ip>::MakeRtl rtl_model() {
  return [](const char* name, const Site& site, const RtlFile& rtl) -> std::unique_ptr<Ip> {
    if (rtl.lockstep) return std::make_unique<LockstepModel<Clocked>>(name, site, rtl.path);
    return std::make_unique<RtlModel<Ip>>(name, site, rtl.path);
  };
}

}  // namespace pl
