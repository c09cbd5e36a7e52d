#pragma once

#include <ps/gic/interrupt_logic.h>
#include <vp/counter.h>
#include <vp/register_bank.h>
#include <vp/signal.h>
#include <cstdint>
#include <map>
#include <systemc>

namespace vp {
class ClockScheduler;
}

namespace ps {

/// The interrupt controller of the Cortex-A9 MPCore for CPU 0: registers of distributor and CPU
/// interface around InterruptLogic. Combinational: an input that rises lowers nIRQ at the same
/// time.
class Gic : public sc_core::sc_module, public vp::SignalListener {
 public:
  Gic(sc_core::sc_module_name name, vp::ClockScheduler& scheduler);
  const char* kind() const override { return "ps::Gic"; }

  vp::RegisterBank cpu_interface;  ///< at 0xF8F0_0100
  vp::RegisterBank distributor;    ///< at 0xF8F0_1000

  /// IRQ_F2P[15:0] from the PL: bits 0 … 7 are interrupts 61 … 68, bits 8 … 15 are 84 … 91.
  vp::In<std::uint32_t> irq_f2p{"irq_f2p"};
  vp::Signal<bool> n_irq{"n_irq", 1, true};  ///< to the CPU, active low
  vp::Signal<bool> n_fiq{"n_fiq", 1, true};  ///< to the CPU, active low

  /// The interrupt that software acknowledged and has not ended; 1023 for none.
  vp::Signal<std::uint16_t> active{"active", 10, 1023};

  vp::Counter acknowledged{"acknowledged", "interrupts acknowledged by reading ICCIAR"};
  vp::Counter spurious{"spurious", "reads of ICCIAR when no interrupt was signalled"};

  /// Wires `signal` to interrupt `id` (16 … 95), active high: before the simulation starts.
  void connect(std::uint32_t id, vp::Signal<bool>& signal);

  const InterruptLogic& logic() const { return logic_; }

 private:
  void end_of_elaboration() override;
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
  void update_outputs();
  void update_lines();

  InterruptLogic logic_;
  std::uint32_t acknowledgeable_ = gic::spurious_id;  ///< what ICCIAR would return
  bool idle_ = false;                                 ///< nothing is forwarded to the CPU interface
  std::uint32_t f2p_levels_ = 0;
  std::map<std::uint32_t, vp::Signal<bool>*> wires_;
};

}  // namespace ps
