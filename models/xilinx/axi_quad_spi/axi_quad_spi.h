#pragma once

#include <axi_quad_spi_registers.h>
#include <board/hosts.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/register_bank.h>
#include <vp/signal.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <systemc>
#include <vector>

namespace xilinx {

/// Build options, as Vivado asks for them; the defaults of its parameters.
struct AxiQuadSpiBuild {
  std::uint32_t sck_ratio = 16;  ///< clocks of ext_spi_clk in a period of SCK
  std::uint32_t num_ss_bits = 1;
  std::uint32_t fifo_depth = 16;        ///< 16 or 256
  std::uint32_t num_transfer_bits = 8;  ///< of a word: 8, 16 or 32
};

/// AXI Quad SPI v3.2 (PG153) in standard mode as a master. Reading an empty SPI_DRR and writing a
/// full SPI_DTR are errors on the bus of the chip; here they are warned of, and change nothing.
/// Devices exchange bytes, the highest of a word first. Bytes from where no device is read 0xFF.
class AxiQuadSpi : public vp::Clocked, public vp::Ip, public board::SpiHost {
 public:
  /// `ext_spi_clk`: what SCK is made from; null: the clock of the registers.
  AxiQuadSpi(sc_core::sc_module_name name, vp::Clock& s_axi_aclk, const AxiQuadSpiBuild& build = {},
             vp::Clock* ext_spi_clk = nullptr);
  const char* kind() const override { return "xilinx::AxiQuadSpi"; }

  vp::Parameter<std::uint32_t> sck_ratio;
  vp::Parameter<std::uint32_t> num_ss_bits;
  vp::Parameter<std::uint32_t> fifo_depth;
  vp::Parameter<std::uint32_t> num_transfer_bits;

  vp::In<bool> s_axi_aresetn{"s_axi_aresetn"};  ///< may be left open
  vp::RegisterBank s_axi;
  vp::Signal<bool> ip2intc_irpt{"ip2intc_irpt"};  ///< level, active high

  void attach(unsigned slave, std::shared_ptr<board::SpiDevice> device) override;

 private:
  void edge() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void before_end_of_elaboration() override;
  void end_of_elaboration() override {}  // the reset may be left open
  vp::IpEstimate own_estimate() const override;
  void wire();
  void control_written(std::uint32_t word);
  void select();
  void reset();
  std::uint32_t exchange(std::uint32_t word);
  std::uint8_t exchange_byte(std::uint8_t byte);
  std::uint32_t status() const;
  std::uint64_t word_clocks() const;
  void update();

  vp::Clock& ext_spi_clk_;
  vp::Register &gie_, &isr_, &ier_, &cr_, &ssr_;
  std::deque<std::uint32_t> tx_, rx_;
  std::vector<std::shared_ptr<board::SpiDevice>> devices_;
  std::uint32_t selected_ = 0;  ///< bit n: device n
  std::uint64_t done_at_ = vp::Clock::never;
};

}  // namespace xilinx
