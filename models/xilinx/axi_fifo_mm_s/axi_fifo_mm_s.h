#pragma once

#include <axi_fifo_mm_s_registers.h>
#include <vp/axi_stream.h>
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
struct AxiFifoMmSBuild {
  bool use_tx_data = true, use_rx_data = true;  ///< which directions there are
  std::uint32_t tx_fifo_depth = 512;            ///< words
  std::uint32_t rx_fifo_depth = 512;            ///< words
  bool has_tkeep = false;  ///< without it, each word of a stream has four bytes
};

/// AXI4-Stream FIFO v4.2 (PG080), AXI4-Lite data, store and forward: a packet leaves once its
/// length is written, and is seen once its last word has come. One beat a clock in each direction.
/// What the chip answers with SLVERR is warned of, and changes nothing.
class AxiFifoMmS : public vp::Clocked, public vp::Ip {
 public:
  AxiFifoMmS(sc_core::sc_module_name name, vp::Clock& s_axi_aclk,
             const AxiFifoMmSBuild& build = {});
  const char* kind() const override { return "xilinx::AxiFifoMmS"; }

  vp::Parameter<bool> use_tx_data, use_rx_data;
  vp::Parameter<std::uint32_t> tx_fifo_depth, rx_fifo_depth;
  vp::Parameter<bool> has_tkeep;

  vp::In<bool> s_axi_aresetn{"s_axi_aresetn"};  ///< may be left open
  vp::RegisterBank s_axi;
  vp::Signal<bool> interrupt{"interrupt"};  ///< level, active high

  vp::AxiStreamMaster axi_str_txd{"axi_str_txd", *this};
  vp::AxiStreamSlave axi_str_rxd{"axi_str_rxd", *this};

 private:
  struct Beat {
    std::uint32_t data;
    bool last;
    std::uint8_t keep;
  };

  void edge() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void before_end_of_elaboration() override;
  void end_of_elaboration() override {}  // a stream may be left open
  vp::IpEstimate own_estimate() const override;
  void wire();
  void send_packet(std::uint32_t bytes);
  void take_word();
  void take_length();
  void reset_sending();
  void reset_receiving();
  void raise(std::uint32_t events, const char* warning = nullptr);
  void update();

  vp::Register &isr_, &ier_;
  std::deque<std::uint32_t> written_;   ///< of the packet that software writes
  std::deque<Beat> leaving_;            ///< on the stream
  std::deque<std::uint32_t> received_;  ///< words of whole packets
  std::deque<std::uint32_t> arriving_;  ///< words of the one that comes
  std::uint32_t arriving_bytes_ = 0;
  std::deque<std::uint32_t> lengths_;  ///< of the packets in received_, not read yet
  std::uint32_t readable_ = 0;         ///< words of the packet whose length was read
};

}  // namespace xilinx
