#pragma once

#include <axi_intc_registers.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/register_bank.h>
#include <vp/signal.h>

#include <cstdint>
#include <deque>
#include <systemc>

namespace xilinx {

/// Build options, as Vivado asks for them; the defaults of its parameters.
struct AxiIntcBuild {
  std::uint32_t num_intr_inputs = 32;  ///< 1 to 32
  std::uint32_t kind_of_intr = 0;      ///< bit n: 1 edge, 0 level
};

/// AXI interrupt controller v4.1 (PG099), without fast mode, cascade and software interrupts.
///
/// An input is seen `input_latency` clocks after it changes. A level that went low again stays
/// pending until it is acknowledged.
class AxiIntc : public vp::Clocked, public vp::Ip {
 public:
  AxiIntc(sc_core::sc_module_name name, vp::Clock& s_axi_aclk, const AxiIntcBuild& build = {});
  const char* kind() const override { return "xilinx::AxiIntc"; }

  vp::Parameter<std::uint32_t> num_intr_inputs;
  vp::Parameter<std::uint32_t> kind_of_intr;
  vp::Parameter<std::uint32_t> input_latency;

  vp::In<bool> s_axi_aresetn{"s_axi_aresetn"};  ///< may be left open
  vp::RegisterBank s_axi;
  vp::Signal<bool> irq{"irq"};  ///< level, active high

  /// Input `number`; std::out_of_range beyond num_intr_inputs. May be left open.
  vp::In<bool>& intr(unsigned number) { return intr_.at(number); }

 private:
  void edge() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void before_end_of_elaboration() override;
  void end_of_elaboration() override {}  // inputs may be left open
  vp::IpEstimate own_estimate() const override;
  void wire();
  std::uint32_t all() const;
  void update();

  struct Change {
    std::uint64_t due;
    std::uint32_t levels;
  };

  std::deque<vp::In<bool>> intr_;
  vp::Register &isr_, &ier_, &mer_;
  std::uint32_t levels_ = 0;  ///< of the inputs now
  std::uint32_t seen_ = 0;    ///< behind the synchroniser
  bool hardware_ = false;     ///< MER.HIE
  std::deque<Change> under_way_;
};

}  // namespace xilinx
