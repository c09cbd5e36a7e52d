#pragma once

#include <axi_uartlite_registers.h>
#include <board/hosts.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/register_bank.h>
#include <vp/signal.h>

#include <cstdint>
#include <deque>
#include <string_view>
#include <systemc>

namespace xilinx {

/// Build options, as Vivado asks for them; the defaults of its parameters.
struct AxiUartliteBuild {
  std::uint32_t baudrate = 9600;
  std::uint32_t data_bits = 8;  ///< 5 to 8
  bool use_parity = false, odd_parity = false;
};

/// AXI UART Lite v2.0 (PG142), at the level of whole characters. Its interrupt is a pulse of one
/// clock: connect it to an edge-sensitive input. Reading an empty receive FIFO and writing a full
/// send FIFO are errors on the bus of the chip; here they are warned of, and change nothing.
class AxiUartlite : public vp::Clocked, public vp::Ip, public board::SerialHost {
 public:
  AxiUartlite(sc_core::sc_module_name name, vp::Clock& s_axi_aclk,
              const AxiUartliteBuild& build = {});
  const char* kind() const override { return "xilinx::AxiUartlite"; }

  vp::Parameter<std::uint32_t> baudrate;
  vp::Parameter<std::uint32_t> data_bits;
  vp::Parameter<bool> use_parity;
  vp::Parameter<bool> odd_parity;

  vp::In<bool> s_axi_aresetn{"s_axi_aresetn"};  ///< may be left open
  vp::RegisterBank s_axi;
  vp::Signal<bool> interrupt{"interrupt"};

  void receive(std::string_view bytes) override;
  /// Characters of the one are such to the other: same rate and format.
  bool understands(const AxiUartlite& other) const;
  /// Wires its tx to the rx of another one that it understands.
  void connect(AxiUartlite& receiver) { receiver_ = &receiver; }

 private:
  void edge() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void before_end_of_elaboration() override;
  void end_of_elaboration() override {}  // the reset may be left open
  vp::IpEstimate own_estimate() const override;
  void wire();
  std::uint64_t character_clocks() const;
  std::uint32_t status() const;
  void pulse();
  void take(std::uint8_t byte);
  void update();

  std::deque<std::uint8_t> tx_, rx_, line_;
  AxiUartlite* receiver_ = nullptr;
  std::uint8_t leaving_ = 0;
  bool enabled_ = false;  ///< of the interrupt
  bool overrun_ = false;
  std::uint64_t sent_at_ = vp::Clock::never;      ///< end of the byte that leaves
  std::uint64_t received_at_ = vp::Clock::never;  ///< end of the byte that comes
  std::uint64_t pulse_end_ = vp::Clock::never;
};

}  // namespace xilinx
