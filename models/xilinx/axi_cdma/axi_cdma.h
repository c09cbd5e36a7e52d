#pragma once

#include <axi_cdma_registers.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/register_bank.h>
#include <vp/signal.h>
#include <xilinx/axi_dma/memory_port.h>

#include <array>
#include <cstdint>
#include <systemc>

namespace xilinx {

/// Build options, as Vivado asks for them; the defaults of its parameters.
struct AxiCdmaBuild {
  std::uint32_t burst_beats = 16;  ///< 2 to 256
  std::uint32_t memory_bytes = 4;  ///< of a beat: 4 to 128
};

/// AXI Central DMA v4.1 (PG034), simple mode, without data realignment: addresses are multiples of
/// a beat. A burst is read, then written; the next one is read meanwhile. A beat takes a clock.
class AxiCdma : public vp::Clocked, public vp::Ip {
 public:
  AxiCdma(sc_core::sc_module_name name, vp::Clock& s_axi_aclk, const AxiCdmaBuild& build = {});
  const char* kind() const override { return "xilinx::AxiCdma"; }

  vp::Parameter<std::uint32_t> burst_beats;
  vp::Parameter<std::uint32_t> memory_bytes;
  vp::Parameter<std::uint32_t> start_clocks;
  vp::Parameter<std::uint32_t> read_clocks;

  vp::In<bool> s_axi_aresetn{"s_axi_aresetn"};  ///< may be left open
  vp::RegisterBank s_axi_lite;
  MemoryPort m_axi;  ///< bind m_axi.link.socket, or connect it through an AxiInterconnect
  vp::Signal<bool> cdma_introut{"cdma_introut"};  ///< level, active high

 private:
  enum class State { idle, starting, reading, writing };
  static constexpr std::uint32_t most_burst_bytes = 4096;

  void edge() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void before_end_of_elaboration() override;
  void end_of_elaboration() override {}  // the reset may be left open
  vp::IpEstimate own_estimate() const override;
  void wire();
  void start();
  void fail(std::uint32_t error);
  /// Ends the transfer with what the memory port answered.
  void fail_on_bus(bool nothing_there);
  void reset();
  void read_burst();
  void write_burst();
  void burst_written();
  std::uint32_t beats(std::uint32_t bytes) const;
  void take(State state, std::uint64_t clocks);
  void update();

  vp::Register &cr_, &sr_, &sa_, &da_, &btt_;
  State state_ = State::idle;
  std::array<unsigned char, most_burst_bytes> data_{};
  std::uint32_t done_bytes_ = 0;   ///< of the transfer
  std::uint32_t burst_bytes_ = 0;  ///< under way
  std::uint64_t done_at_ = vp::Clock::never;
};

}  // namespace xilinx
