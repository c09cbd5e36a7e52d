// A DMA engine between two ends of streams that a test holds: it gives words to `source` and looks
// at what came to `sink`. The pins of a GPIO it holds, too.
#include <chip/system/design_plugin.h>
#include <vp/axi_stream.h>
#include <xilinx/axi_dma/axi_dma.h>
#include <xilinx/axi_gpio/axi_gpio.h>
#include <xilinx/axi_interconnect/axi_interconnect.h>

namespace {

class Ends : public sc_core::sc_module, public platform::Design {
 public:
  Ends(sc_core::sc_module_name name, platform::PlPorts& ports)
      : sc_module(name),
        registers_("axi_interconnect", ports.fclk_clk(0)),
        memory_("axi_mem_interconnect", ports.fclk_clk(0)),
        dma_("axi_dma_0", ports.fclk_clk(0)),
        gpio_("axi_gpio_0", ports.fclk_clk(0), {}),
        source_("source", ports.fclk_clk(0)),
        sink_("sink", ports.fclk_clk(0)) {
    ports.m_axi_gp0(registers_);
    ports.s_axi_hp0(memory_);
    registers_.connect(dma_.s_axi_lite, 0x4040'0000);
    registers_.connect(gpio_.s_axi, 0x4120'0000);
    gpio_.gpio.io_i(pins_);
    memory_.connect(dma_);
    dma_.axi_resetn(ports.fclk_reset0_n());
    source_.m_axis(in_);
    dma_.s2mm().s_axis(in_);
    dma_.mm2s().m_axis(out_);
    sink_.s_axis(out_);
  }

  platform::facts::Work work() const override { return {"", "the program ends well"}; }

 private:
  xilinx::AxiInterconnect registers_, memory_;
  xilinx::AxiDma dma_;
  xilinx::AxiGpio gpio_;
  vp::StreamSource source_;
  vp::StreamSink sink_;
  vp::AxiStream in_{"in"}, out_{"out"};
  vp::Signal<std::uint32_t> pins_{"pins"};
};

const platform::DesignInfo& info() {
  static const platform::DesignInfo ends{
      "ends",
      "a DMA engine between two ends of streams that a test holds",
      {"increment"},
      true,
      platform::no_words,
      [](const char* name, platform::PlPorts& ports) -> std::unique_ptr<platform::Design> {
        return std::make_unique<Ends>(name, ports);
      }};
  return ends;
}

}  // namespace

MARKERVP_DESIGN(info)
