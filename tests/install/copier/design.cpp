// The thesis' marker detector, and a DMA engine that copies: what it reads it writes elsewhere.
#include <chip/system/design_plugin.h>
#include <marker/designs/marker/marker_design.h>

namespace {

class Copier : public platform::MarkerDesign {
 public:
  Copier(sc_core::sc_module_name name, platform::PlPorts& ports)
      : MarkerDesign(name, ports), axi_dma_2_("axi_dma_2", ports.fclk_clk(0)) {
    axi_interconnect.connect(axi_dma_2_.s_axi_lite, 0x4042'0000);
    axi_mem_interconnect.connect(axi_dma_2_);
    concat.connect_interrupt(axi_dma_2_.s2mm_introut, 63);
    axi_dma_2_.axi_resetn(proc_sys_reset.peripheral_aresetn);
    axi_dma_2_.mm2s().m_axis(stream_);
    axi_dma_2_.s2mm().s_axis(stream_);
  }

 private:
  xilinx::AxiDma axi_dma_2_;
  vp::AxiStream stream_{"copy_stream"};
};

const platform::DesignInfo& info() {
  static const platform::DesignInfo copier{
      "copier",
      "the marker detector, and a DMA engine that copies",
      {"copying"},
      true,
      platform::marker_words,
      [](const char* name, platform::PlPorts& ports) -> std::unique_ptr<platform::Design> {
        return std::make_unique<Copier>(name, ports);
      }};
  return copier;
}

}  // namespace

MARKERVP_DESIGN(info)
