#pragma once

#include <algorithm>
#include <cstdint>
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
  /// Loads `file` once; it stays loaded. Refuses one that is no RTL, or that of another IP than
  /// `ip`. `instance`: the name of this one.
  RtlPins(const std::string& file, const std::string& ip, const std::string& instance);

  void clock(const char* name);
  template <class T>
  void input(const vp::In<T>& port, unsigned bits = vp::default_width<T>()) {
    void* place = pin(last_name(port.name()), bits, false);
    before_.push_back([&port, place, bits] { store(place, bits, port.read()); });
  }
  template <class T>
  void output(vp::Signal<T>& port) {
    connect(port, pin(last_name(port.name()), port.width(), true), port.width());
  }
  /// An output that only reports and traces look at: RTL may lack it, or have fewer bits.
  template <class T>
  void report(vp::Signal<T>& port) {
    const RtlPort* found = find(last_name(port.name()));
    if (!found) return;
    const unsigned bits = std::min<unsigned>(found->bits, port.width());
    connect(port, pin(found->name, bits, true), bits);
  }
  /// What the IP is configured for; RTL that has no such parameter is trusted to fit.
  /// `key`: of the configuration.
  void parameter(const char* name, const std::string& key, std::uint64_t value) const;
  /// Refuses ports that the IP does not have.
  void complete() const;

  /// What stands on the inputs is sampled, and the outputs follow.
  void clock_edge() {
    for (const auto& move : before_) move();
    *clk_ = 1;
    rtl_.eval(model_.get());
    *clk_ = 0;
    rtl_.eval(model_.get());
    for (const auto& move : after_) move();
  }

 private:
  static std::string last_name(const std::string& path);
  static void store(void* place, unsigned bits, std::uint64_t value);
  static std::uint64_t load(const void* place, unsigned bits);
  const RtlPort* find(const std::string& name) const;
  void* pin(const std::string& name, unsigned bits, bool output);
  [[noreturn]] void refuse(const std::string& place, const std::string& why) const;
  template <class T>
  void connect(vp::Signal<T>& port, const void* place, unsigned bits) {
    after_.push_back([&port, place, bits] { port = static_cast<T>(load(place, bits)); });
  }

  const std::string file_;
  const std::string ip_;
  const RtlDescriptor& rtl_;
  const std::unique_ptr<void, void (*)(void*)> model_;
  std::uint8_t* clk_ = nullptr;
  std::vector<bool> connected_;  ///< by the number of the port
  std::vector<std::function<void()>> before_, after_;
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
  void edge() override { pins_.clock_edge(); }

  RtlPins pins_;
};

/// What an IP in whose place RTL can stand gives its list of models.
template <class Ip>
typename Models<Ip>::MakeRtl rtl_model() {
  return [](const char* name, const Site& site, const std::string& file) {
    return std::make_unique<RtlModel<Ip>>(name, site, file);
  };
}

}  // namespace pl
