#pragma once

#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/register_bank.h>
#include <vp/signal.h>
#include <xilinx/axi_vdma/vdma_reader.h>
#include <xilinx/axi_vdma/vdma_writer.h>

#include <cstdint>
#include <memory>
#include <systemc>

namespace xilinx {

/// Build options, as Vivado asks for them.
struct AxiVdmaBuild {
  std::uint32_t frame_stores = 3;  ///< 1 to 16
  VdmaChannelBuild mm2s, s2mm;
};

/// AXI VDMA v6.3 (PG020), direct register mode: MM2S runs freely, S2MM begins a frame with
/// TUSER(0). Both channels are locked inside the core where their modes are a pair, master and
/// slave or dynamic master and dynamic slave. Not modelled: scatter-gather, external frame sync and
/// genlock, the delay counter, vertical flip.
class AxiVdma : public vp::Clocked, public vp::Ip {
 public:
  /// `mm2s_aclk`, `s2mm_aclk`: of stream and memory port of the channels, whichever are built.
  /// Throws vp::InputError if none is.
  AxiVdma(sc_core::sc_module_name name, vp::Clock& s_axi_lite_aclk, vp::Clock& mm2s_aclk,
          vp::Clock& s2mm_aclk, const AxiVdmaBuild& build = {});
  const char* kind() const override { return "xilinx::AxiVdma"; }

  vp::Parameter<std::uint32_t> frame_stores;

  vp::In<bool> axi_resetn{"axi_resetn"};  ///< may be left open
  vp::RegisterBank s_axi_lite;
  vp::Signal<bool> mm2s_introut{"mm2s_introut"};  ///< level, active high
  vp::Signal<bool> s2mm_introut{"s2mm_introut"};

  /// Null: not built.
  VdmaReader* mm2s() const { return mm2s_.get(); }
  VdmaWriter* s2mm() const { return s2mm_.get(); }
  /// Both channels are locked inside the core.
  bool has_internal_genlock() const;

 private:
  void edge() override { sleep(); }
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void before_end_of_elaboration() override;
  void end_of_elaboration() override {}  // the reset may be left open
  void start_of_simulation() override;
  vp::IpEstimate own_estimate() const override;
  void remove_channel(const axi_vdma::ChannelOffsets& offsets);

  std::unique_ptr<VdmaReader> mm2s_;
  std::unique_ptr<VdmaWriter> s2mm_;
};

}  // namespace xilinx
