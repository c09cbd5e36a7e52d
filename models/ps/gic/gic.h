#pragma once

#include <gic_registers.h>
#include <vp/counter.h>
#include <vp/parameter.h>
#include <vp/register_bank.h>
#include <vp/rule_reports.h>
#include <vp/signal.h>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <systemc>
#include <utility>

namespace vp {
class ClockScheduler;
}

namespace ps {

/// What the interrupt controller decides, without registers and time: which interrupt is pending,
/// active, and signalled to one CPU (ARM Generic Interrupt Controller architecture 1.0, chapter 3;
/// in secure state).
class InterruptLogic {
 public:
  /// The state after reset.
  InterruptLogic();

  /// Copies what all CPUs share from the logic of another one: the shared interrupts, except
  /// their targets.
  void share(const InterruptLogic& other);

  /// A bit for each interrupt, as the distributor's registers show them.
  class Bits {
   public:
    bool operator[](std::uint32_t id) const { return (words_[id / 32] >> id % 32 & 1) != 0; }
    void set(std::uint32_t id, bool value) {
      const std::uint32_t bit = std::uint32_t{1} << id % 32;
      words_[id / 32] = (words_[id / 32] & ~bit) | (value ? bit : 0);
    }
    /// Interrupts 32 · n to 32 · n + 31.
    std::uint32_t word(unsigned n) const { return words_[n]; }
    std::uint32_t& word(unsigned n) { return words_[n]; }

   private:
    std::array<std::uint32_t, gic::bit_registers> words_{};
  };

  /// What software set in the distributor, and what came of it.
  Bits non_secure;
  Bits enabled;
  Bits edge;
  Bits latched;   ///< pending by an edge, a software interrupt or ICDISPR
  Bits active;    ///< at whichever CPU
  Bits own;       ///< active, and acknowledged by this CPU
  Bits wire;      ///< levels of the inputs
  Bits targeted;  ///< goes to this CPU
  std::array<std::uint8_t, gic::id_count> priority{};
  /// Software interrupts: a bit for each CPU that raised it, and was not acknowledged.
  std::array<std::uint8_t, gic::sgi_count> sources{};

  /// Interrupts 32 · n … that are pending.
  std::uint32_t pending(unsigned n) const {
    return latched.word(n) | (wire.word(n) & ~edge.word(n));
  }

  /// Registers that the decisions depend on.
  std::uint32_t icddcr = 0;
  std::uint32_t iccicr = 0;
  std::uint32_t iccpmr = 0;
  std::uint32_t iccbpr = 2;
  std::uint32_t iccabpr = 3;

  /// An input changed to `level`: a rising edge latches an edge-sensitive interrupt, enabled or
  /// not.
  void set_wire(std::uint32_t id, bool level);

  /// An interrupt is pending that the distributor forwards if its group is enabled.
  bool any_waiting() const {
    static_assert(gic::bit_registers == 3);
    return (waiting(0) | waiting(1) | waiting(2)) != 0;
  }
  /// An interrupt of a device is enabled that goes to this CPU, and is forwarded when it comes.
  bool any_enabled() const;
  /// The line to the CPU that is asserted.
  enum class Line { none, irq, fiq };
  struct Signalled {
    Line line = Line::none;
    /// What ICCIAR would return: the signalled interrupt, with the CPU that raised it by software;
    /// 1023 if none, 1022 if it is non-secure and AckCtl 0.
    std::uint32_t word = gic::spurious_id;
  };
  /// Nothing, unless any_waiting().
  Signalled signalled() const;

  /// CPU number `source` raised software interrupt `id`.
  void raise(std::uint32_t id, unsigned source);
  /// ICCIAR returned `word`: that interrupt becomes active.
  void acknowledge(std::uint32_t word);
  /// Writes ICCEOIR. False if the interrupt was not active at this CPU (a mistake of the software;
  /// nothing happens).
  bool end(std::uint32_t id);
  /// ICCHPIR: like ICCIAR, without effects, and whatever the priorities of mask and running
  /// interrupt.
  std::uint32_t highest_pending() const;
  /// The most urgent interrupt that is active at this CPU, of equal ones the lowest; 1023 if none
  /// is.
  std::uint16_t first_active() const;
  /// ICCRPR: priority of that one, 0xFF if idle.
  std::uint32_t running_priority() const;

 private:
  std::uint32_t waiting(unsigned n) const {
    return pending(n) & enabled.word(n) & ~active.word(n) & targeted.word(n);
  }
  std::uint32_t candidate() const;
  std::uint32_t forwarded(unsigned n) const;
  bool preempts(std::uint32_t id) const;
  Line line_of(std::uint32_t id) const;
  std::uint32_t as_seen(std::uint32_t id) const;
};

/// The interrupt controller of the Cortex-A9 MPCore as one CPU sees it: registers of distributor
/// and CPU interface around InterruptLogic. Combinational: an input that rises lowers nIRQ at the
/// same time.
///
/// The Gic of CPU 0 has all inputs. That of CPU 1 has its own private inputs and shares the rest.
class Gic : public sc_core::sc_module, public vp::SignalListener {
 public:
  Gic(sc_core::sc_module_name name, vp::ClockScheduler& scheduler);
  /// As CPU 1 sees that of CPU 0.
  Gic(sc_core::sc_module_name name, Gic& first);
  const char* kind() const override { return "ps::Gic"; }

  vp::RegisterBank cpu_interface;  ///< at 0xF8F0_0100
  vp::RegisterBank distributor;    ///< at 0xF8F0_1000

  /// IRQ_F2P[15:0] from the PL: bits 0 … 7 are interrupts 61 … 68, bits 8 … 15 are 84 … 91.
  vp::In<std::uint32_t> irq_f2p{"irq_f2p"};
  vp::Signal<bool> n_irq{"n_irq", 1, true};  ///< to the CPU, active low
  vp::Signal<bool> n_fiq{"n_fiq", 1, true};  ///< to the CPU, active low

  /// The interrupt that software acknowledged and has not ended; 1023 for none.
  vp::Signal<std::uint16_t> active{"active", 10, 1023};

  vp::Parameter<std::uint64_t> shortest_edge{
      "shortest_edge", 6'000, vp::Unit::time, vp::Source::assumed,
      "pulse on IRQ_F2P that an edge-sensitive interrupt certainly sees: two periods of PERIPHCLK, "
      "which is half the CPU's clock (UG585)"};
  vp::Parameter<std::uint64_t> shortest_level{
      "shortest_level", 50'000, vp::Unit::time, vp::Source::assumed,
      "pulse on IRQ_F2P of a level-sensitive interrupt that software can have ended: less than one "
      "access through a GP port takes"};

  vp::Counter acknowledged{"acknowledged", "interrupts acknowledged by reading ICCIAR"};
  vp::Counter spurious{"spurious", "reads of ICCIAR when no interrupt was signalled"};

  /// Wires `signal` to interrupt `id` (16 … 95), active high: before the simulation starts.
  void connect(std::uint32_t id, vp::Signal<bool>& signal);

  /// Sets the level at interrupt `id` from outside, until the signal wired to it changes next.
  void set_wire(std::uint32_t id, bool level);

  /// Called when software on this CPU raises an interrupt. May be null.
  void on_software_interrupt(std::function<void()> listener) {
    software_interrupt_listener_ = std::move(listener);
  }

  const InterruptLogic& logic() const { return logic_; }

  /// The interrupt that is signalled to the CPU, and when its line last rose or software raised it;
  /// `id` is gic::spurious_id if no interrupt is signalled.
  struct Request {
    std::uint32_t id = gic::spurious_id;
    std::uint64_t since_ps = 0;
  };
  Request request() const;
  /// When the line of interrupt `id` rose last.
  std::uint64_t risen_ps(std::uint32_t id) const;

 private:
  Gic(sc_core::sc_module_name name, vp::ClockScheduler& scheduler, unsigned number);
  void end_of_elaboration() override;
  void end_of_simulation() override { reports_.finish(); }
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;

  void wire_cpu_interface();
  void wire_distributor();
  void wire_bit_registers(unsigned n);
  void wire_priorities(unsigned n);
  void wire_targets(unsigned n);
  void wire_sensitivities(unsigned n);
  void end_of_interrupt(std::uint32_t word);
  void raise_software_interrupt(std::uint32_t word);

  bool set_f2p(std::uint32_t levels);
  void check_pulse(std::uint32_t id);
  void set_level(std::uint32_t id, bool level);
  void update_outputs();
  void update_lines();
  void show_shared(std::uint32_t offset);
  void update_other();

  const unsigned number_;  ///< of the CPU
  Gic* other_ = nullptr;   ///< that of the other CPU
  std::function<void()> software_interrupt_listener_;
  vp::ClockScheduler& scheduler_;
  InterruptLogic logic_;
  std::array<std::uint64_t, gic::id_count> risen_ps_{};  ///< when a line rose last
  std::uint32_t acknowledgeable_ = gic::spurious_id;     ///< what ICCIAR would return
  bool idle_ = false;  ///< nothing is forwarded to the CPU interface
  std::uint32_t f2p_levels_ = 0;
  std::map<std::uint32_t, vp::Signal<bool>*> wires_;
  vp::RuleReports reports_{*this};
};

}  // namespace ps
