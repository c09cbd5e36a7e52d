#pragma once

#include <axi_iic_registers.h>
#include <board/hosts.h>
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
struct AxiIicBuild {
  std::uint32_t iic_freq = 100'000;  ///< Hz
  std::uint32_t gpo_width = 1;       ///< 1 to 8
  std::uint32_t gpo_default = 0;     ///< after reset
};

/// AXI IIC v2.1 (PG090) as a master, static and dynamic, at the level of whole bytes: a start or a
/// stop takes one period of SCL, each byte with its acknowledge nine. The slave's side is not
/// modelled, and the timing registers are stored only: SCL is that of the build.
class AxiIic : public vp::Clocked, public vp::Ip, public board::I2cHost {
 public:
  AxiIic(sc_core::sc_module_name name, vp::Clock& s_axi_aclk, const AxiIicBuild& build = {});
  const char* kind() const override { return "xilinx::AxiIic"; }

  vp::Parameter<std::uint32_t> iic_freq;
  vp::Parameter<std::uint32_t> gpo_width;

  vp::In<bool> s_axi_aresetn{"s_axi_aresetn"};  ///< may be left open
  vp::RegisterBank s_axi;
  vp::Signal<bool> iic2intc_irpt{"iic2intc_irpt"};  ///< level, active high
  vp::Signal<std::uint8_t> gpo;

  board::I2cBus bus;  ///< what it is wired to
  board::I2cBus& i2c_bus() override { return bus; }

 private:
  /// What the bus does. `waiting`: SCL is held low until software acts.
  enum class State { idle, address, sending, receiving, stopping, waiting };

  void edge() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void before_end_of_elaboration() override;
  void end_of_elaboration() override {}  // the reset may be left open
  vp::IpEstimate own_estimate() const override;
  void wire();
  void control_written();
  void reset();
  std::uint64_t periods(std::uint64_t scl) const;
  void take(State state, std::uint64_t scl_periods);
  void proceed();
  void begin(std::uint32_t word);
  void address_sent();
  void byte_sent();
  void byte_received();
  void stop();
  bool is_dynamic() const { return dynamic_; }
  std::uint32_t status() const;
  void update();

  vp::Register &gie_, &isr_, &ier_, &cr_, &pirq_;
  std::deque<std::uint32_t> tx_;
  std::deque<std::uint8_t> rx_;
  State state_ = State::idle;
  bool busy_ = false;          ///< between start and stop
  bool reads_ = false;         ///< direction of the transfer
  bool dynamic_ = false;       ///< begun by a word of TX_FIFO
  bool wants_stop_ = false;    ///< after the byte under way
  std::uint32_t to_come_ = 0;  ///< bytes of a dynamic read
  std::uint32_t word_ = 0;     ///< under way
  std::uint64_t done_at_ = vp::Clock::never;
};

}  // namespace xilinx
