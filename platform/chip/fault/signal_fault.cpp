#include <cstdint>

#include <chip/fault/injector.h>
#include <chip/fault/places.h>
#include <vp/axi_stream.h>
#include <vp/signal.h>

#include <string_view>

namespace platform {

namespace {

/// Shows something else than what a signal's writer says, from when it is asked to.
class SignalFault : public FaultyPlace, public vp::SignalForce {
 public:
  SignalFault(Injector& injector, Injection& injection, vp::SignalBase& signal)
      : injector_(injector), injection_(injection), signal_(signal) {
    signal_.force(this);
  }
  ~SignalFault() override { signal_.force(nullptr); }

 protected:
  const Fault& fault() const { return injection_.fault; }
  Injector& injector() { return injector_; }
  void happened() { injection_.happened(injector_.zynq().scheduler.now_ps()); }
  void show_again() { signal_.drive_again(); }

 private:
  Injector& injector_;
  Injection& injection_;
  vp::SignalBase& signal_;
};

/// From a time on, for a while.
class HeldSignal : public SignalFault {
 public:
  HeldSignal(Injector& injector, Injection& injection, vp::SignalBase& signal)
      : SignalFault(injector, injection, signal),
        value_(fault().what == Fault::What::spurious ? 1 : fault().value) {
    injector.plan(fault().at_ps, [this] { hold(true); });
    if (fault().for_ps != Fault::for_ever)
      injector.plan(fault().at_ps + fault().for_ps, [this] { hold(false); });
  }

  std::uint64_t seen(std::uint64_t driven) override { return held_ ? value_ : driven; }

 private:
  void hold(bool held) {
    held_ = held;
    if (held) happened();
    show_again();
  }

  const std::uint64_t value_;
  bool held_ = false;
};

/// The n-th rising edge comes late, or never.
class MissedEdge : public SignalFault {
 public:
  /// Edges count from fault().at_ps on.
  MissedEdge(Injector& injector, Injection& injection, vp::SignalBase& signal)
      : SignalFault(injector, injection, signal), driven_(signal.bits()) {
    injector.plan(fault().at_ps, [this] { counts_ = true; });
  }

  std::uint64_t seen(std::uint64_t driven) override {
    const bool rises = driven != 0 && driven_ == 0;
    driven_ = driven;
    if (driven == 0) hidden_ = false;
    if (rises && counts_ && fault().meets(++edges_)) {
      hidden_ = true;
      happened();
      if (fault().what == Fault::What::late) {
        injector().plan_from_edge(fault().by_ps, [this, edge = edges_] {
          if (edge != edges_) return;
          hidden_ = false;
          show_again();
        });
      }
    }
    return hidden_ ? 0 : driven;
  }

 private:
  std::uint64_t driven_;
  bool counts_ = false;
  std::uint64_t edges_ = 0;
  bool hidden_ = false;
};

}  // namespace

std::unique_ptr<FaultyPlace> place_signal_fault(Injector& injector, Injection& injection) {
  const Fault& fault = injection.fault;
  vp::SignalBase& signal = place_named<vp::SignalBase>(fault.where, "a signal");
  if (!signal.can_be_forced())
    throw vp::InputError(
        std::string(signal.name()) +
        " is shown in traces, and drives nothing: name the signal that it follows");
  if (signal.is_forced())
    throw vp::InputError(std::string(signal.name()) + " has a fault already: one is possible");
  check_played(injector, signal.name());
  const auto* stream = dynamic_cast<const vp::AxiStream*>(signal.get_parent_object());
  if (stream && stream->rests() && std::string_view(signal.basename()) != "tready")
    throw vp::InputError(std::string(signal.name()) +
                         " does not move at this fidelity: set fidelity to clocked");
  const bool is_level = fault.what == Fault::What::stuck;
  if (!is_level && signal.width() != 1)
    throw vp::InputError(std::string(signal.name()) + " has " + std::to_string(signal.width()) +
                         " bits: only a signal of one bit has edges");
  const bool is_wide = signal.width() < 64 && fault.value >> signal.width() != 0;
  if (is_level && is_wide)
    throw vp::InputError(std::string(signal.name()) + " has " + std::to_string(signal.width()) +
                         " bits: 'value' does not fit");
  if (is_level || fault.what == Fault::What::spurious)
    return std::make_unique<HeldSignal>(injector, injection, signal);
  return std::make_unique<MissedEdge>(injector, injection, signal);
}

}  // namespace platform
