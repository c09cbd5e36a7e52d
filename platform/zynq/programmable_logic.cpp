#include <zynq/programmable_logic.h>

namespace platform {

namespace {

// Vivado's defaults for these IP; 64 KiB each.
constexpr std::uint64_t axi_dma_0_base = 0x4040'0000, axi_dma_1_base = 0x4041'0000,
                        axi_gpio_0_base = 0x4120'0000, axi_gpio_1_base = 0x4121'0000,
                        segment = 0x1'0000;

xilinx::AxiGpioBuild gpio(xilinx::GpioDirection direction) {
  xilinx::AxiGpioBuild build;
  build.gpio.direction = direction;
  return build;
}

xilinx::AxiDmaBuild one_channel(bool mm2s) {
  xilinx::AxiDmaBuild build;
  build.include_mm2s = mm2s;
  build.include_s2mm = !mm2s;
  return build;
}

}  // namespace

ProgrammableLogic::ProgrammableLogic(sc_core::sc_module_name name, vp::Clock& system_clk,
                                     vp::Clock& pixel_clk, pl::Fidelity otherwise)
    : FeatureExtraction(name, system_clk, pixel_clk, otherwise),
      proc_sys_reset("proc_sys_reset", system_clk),
      axi_interconnect("axi_interconnect", system_clk),
      axi_mem_interconnect("axi_mem_interconnect", system_clk),
      axi_gpio_0("axi_gpio_0", system_clk, gpio(xilinx::GpioDirection::all_outputs)),
      axi_gpio_1("axi_gpio_1", system_clk, gpio(xilinx::GpioDirection::all_inputs)),
      axi_dma_0("axi_dma_0", system_clk, one_channel(true)),
      axi_dma_1("axi_dma_1", system_clk, one_channel(false)),
      concat("concat", 2) {
  axi_interconnect.map("axi_dma_0", axi_dma_0_base, segment).bind(axi_dma_0.s_axi_lite.socket);
  axi_interconnect.map("axi_dma_1", axi_dma_1_base, segment).bind(axi_dma_1.s_axi_lite.socket);
  axi_interconnect.map("axi_gpio_0", axi_gpio_0_base, segment).bind(axi_gpio_0.s_axi.socket);
  axi_interconnect.map("axi_gpio_1", axi_gpio_1_base, segment).bind(axi_gpio_1.s_axi.socket);

  axi_gpio_0.s_axi_aresetn(proc_sys_reset.peripheral_aresetn);
  axi_gpio_1.s_axi_aresetn(proc_sys_reset.peripheral_aresetn);
  axi_dma_0.axi_resetn(proc_sys_reset.peripheral_aresetn);
  axi_dma_1.axi_resetn(proc_sys_reset.peripheral_aresetn);
  por()(proc_sys_reset.peripheral_reset);

  gpio_in()(axi_gpio_0.gpio.io_o);
  axi_gpio_1.gpio.io_i(feature_packaging.feature);
  axi_dma_0.mm2s().m_axis(image_stream_link);
  image_stream()(image_stream_link);
  binary_stream()(binary_stream_link);
  axi_dma_1.s2mm().s_axis(binary_stream_link);

  axi_dma_0.mm2s().m_axi.link.socket.bind(axi_mem_interconnect.socket);
  axi_dma_1.s2mm().m_axi.link.socket.bind(axi_mem_interconnect.socket);
  axi_dma_0.share_memory_path(memory_path_);
  axi_dma_1.share_memory_path(memory_path_);
  concat.in(0)(axi_dma_0.mm2s_introut);
  concat.in(1)(axi_dma_1.s2mm_introut);
}

}  // namespace platform
