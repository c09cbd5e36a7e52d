// A DMA engine whose output stream is its input stream, and a GPIO whose first channel drives its
// second.
#include <chip/system/design_plugin.h>

#include <vp/axi_stream.h>
#include <xilinx/axi_dma/axi_dma.h>
#include <xilinx/axi_gpio/axi_gpio.h>
#include <xilinx/axi_interconnect/axi_interconnect.h>
#include <xilinx/concat/concat.h>

namespace {

xilinx::AxiGpioBuild dual_with_interrupt() {
  xilinx::AxiGpioBuild build;
  build.is_dual = build.interrupt_present = true;
  build.gpio.width = build.gpio2.width = 8;
  return build;
}

class Loop : public sc_core::sc_module, public platform::Design {
 public:
  Loop(sc_core::sc_module_name name, platform::PlPorts& ports)
      : sc_module(name),
        registers_("axi_interconnect", ports.fclk_clk(0)),
        memory_("axi_mem_interconnect", ports.fclk_clk(0)),
        dma_("axi_dma_0", ports.fclk_clk(0)),
        gpio_("buttons", ports.fclk_clk(0), dual_with_interrupt()),
        concat_("concat", 3) {
    ports.m_axi_gp0(registers_);
    ports.s_axi_hp0(memory_);
    registers_.connect(dma_.s_axi_lite, 0x4040'0000);
    // Neither its name nor its place are those of the default design.
    registers_.connect(gpio_.s_axi, 0x4123'0000);
    memory_.connect(dma_);
    dma_.axi_resetn(ports.fclk_reset0_n());
    dma_.mm2s().m_axis(stream_);
    dma_.s2mm().s_axis(stream_);
    gpio_.gpio2.io_i(gpio_.gpio.io_o);
    concat_.connect_interrupt(dma_.mm2s_introut, 61);
    concat_.connect_interrupt(dma_.s2mm_introut, 62);
    concat_.connect_interrupt(gpio_.ip2intc_irpt, 63);
    ports.irq_f2p(concat_.dout);
  }

  platform::facts::Work work() const override { return {"", "the program ends well"}; }

 private:
  xilinx::AxiInterconnect registers_, memory_;
  xilinx::AxiDma dma_;
  xilinx::AxiGpio gpio_;
  xilinx::Concat concat_;
  vp::AxiStream stream_{"stream"};
};

// `map` asks for a design's program; those here are built with what it prints.
const platform::DesignInfo& info() {
  static const platform::DesignInfo loop{
      "loop",
      "a DMA engine and a GPIO that hear themselves",
      {"hybrid"},
      true,
      platform::no_words,
      [](const char* name, platform::PlPorts& ports) -> std::unique_ptr<platform::Design> {
        return std::make_unique<Loop>(name, ports);
      }};
  return loop;
}

}  // namespace

MARKERVP_DESIGN(info)
