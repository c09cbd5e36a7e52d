#include "thesis_handoff.h"

namespace kit {

namespace {

std::string system_clk(const std::string& name) {
  return pin("I", name, "ps_FCLK_CLK0", 1, R"(SIGIS="clk" CLKFREQUENCY="100000000")");
}

std::string resetn(const std::string& name) {
  return pin("I", name, "rst_aresetn", 1, R"(SIGIS="rst" POLARITY="ACTIVE_LOW")");
}

std::string parameters(const std::vector<std::pair<std::string, std::string>>& list) {
  std::string text;
  for (const auto& [name, value] : list) text += parameter(name, value);
  return text;
}

void add_processing_system(HwhText& text) {
  text.module(
      "processing_system7_0", "xilinx.com:ip:processing_system7:5.5",
      parameters({{"PCW_CRYSTAL_PERIPHERAL_FREQMHZ", "33.333333333333332"},
                  {"PCW_ACT_APU_PERIPHERAL_FREQMHZ", "666.666667"},
                  {"PCW_DDR_RAM_HIGHADDR", "0x1FFFFFFF"},
                  {"PCW_UIPARAM_DDR_BUS_WIDTH", "32 Bit"},
                  {"PCW_ENET0_PERIPHERAL_ENABLE", "1"},
                  {"PCW_UART0_PERIPHERAL_ENABLE", "1"},
                  {"PCW_UART1_PERIPHERAL_ENABLE", "1"}}),
      pin("O", "FCLK_CLK0", "ps_FCLK_CLK0", 1, R"(SIGIS="clk" CLKFREQUENCY="100000000")") +
          pin("O", "FCLK_CLK1", "ps_FCLK_CLK1", 1, R"(SIGIS="clk" CLKFREQUENCY="50000000")") +
          pin("O", "FCLK_RESET0_N", "ps_FCLK_RESET0_N", 1, R"(SIGIS="rst")") +
          system_clk("M_AXI_GP0_ACLK") + system_clk("S_AXI_HP0_ACLK") +
          pin("I", "IRQ_F2P", "concat_dout", 2),
      bus("MASTER", "M_AXI_GP0", "ps_M_AXI_GP0") + bus("SLAVE", "S_AXI_HP0", "mem_M00_AXI"),
      segment("M_AXI_GP0", "axi_dma_0", "S_AXI_LITE", "0x40400000", "0x4040FFFF") +
          segment("M_AXI_GP0", "axi_dma_1", "S_AXI_LITE", "0x40410000", "0x4041FFFF") +
          segment("M_AXI_GP0", "axi_gpio_0", "S_AXI", "0x41200000", "0x4120FFFF") +
          segment("M_AXI_GP0", "axi_gpio_1", "S_AXI", "0x41210000", "0x4121FFFF"));
}

void add_buses(HwhText& text) {
  text.module("axi_interconnect", "xilinx.com:ip:axi_interconnect:2.1", "", system_clk("ACLK"),
              bus("SLAVE", "S00_AXI", "ps_M_AXI_GP0") + bus("MASTER", "M00_AXI", "periph_M00") +
                  bus("MASTER", "M01_AXI", "periph_M01") + bus("MASTER", "M02_AXI", "periph_M02") +
                  bus("MASTER", "M03_AXI", "periph_M03"));
  text.module("axi_mem_interconnect", "xilinx.com:ip:axi_interconnect:2.1", "", system_clk("ACLK"),
              bus("SLAVE", "S00_AXI", "dma_0_MM2S") + bus("SLAVE", "S01_AXI", "dma_1_S2MM") +
                  bus("MASTER", "M00_AXI", "mem_M00_AXI"));
  text.module("proc_sys_reset", "xilinx.com:ip:proc_sys_reset:5.0",
              parameter("C_EXT_RESET_HIGH", "0"),
              system_clk("slowest_sync_clk") + pin("I", "ext_reset_in", "ps_FCLK_RESET0_N") +
                  pin("O", "peripheral_aresetn", "rst_aresetn") +
                  pin("O", "peripheral_reset", "rst_reset"));
  text.module("xlconcat", "xilinx.com:ip:xlconcat:2.1", parameter("NUM_PORTS", "2"),
              pin("I", "In0", "dma_0_introut") + pin("I", "In1", "dma_1_introut") +
                  pin("O", "dout", "concat_dout", 2));
}

/// Each has one channel: images to the logic, and what the threshold makes of them back.
void add_engines(HwhText& text) {
  text.module("axi_dma_0", "xilinx.com:ip:axi_dma:7.1",
              parameters({{"C_INCLUDE_SG", "0"},
                          {"C_INCLUDE_MM2S", "1"},
                          {"C_INCLUDE_S2MM", "0"},
                          {"C_MM2S_BURST_SIZE", "32"}}),
              system_clk("s_axi_lite_aclk") + system_clk("m_axi_mm2s_aclk") + resetn("axi_resetn") +
                  pin("O", "mm2s_introut", "dma_0_introut"),
              bus("SLAVE", "S_AXI_LITE", "periph_M00") + bus("MASTER", "M_AXI_MM2S", "dma_0_MM2S") +
                  bus("INITIATOR", "M_AXIS_MM2S", "image", "axis"),
              segment("M_AXI_MM2S", "processing_system7_0", "S_AXI_HP0", "0x00000000", "0x1FFFFFFF",
                      "MEMORY"));
  text.module("axi_dma_1", "xilinx.com:ip:axi_dma:7.1",
              parameters({{"C_INCLUDE_SG", "0"},
                          {"C_INCLUDE_MM2S", "0"},
                          {"C_INCLUDE_S2MM", "1"},
                          {"C_S2MM_BURST_SIZE", "32"}}),
              system_clk("s_axi_lite_aclk") + system_clk("m_axi_s2mm_aclk") + resetn("axi_resetn") +
                  pin("O", "s2mm_introut", "dma_1_introut"),
              bus("SLAVE", "S_AXI_LITE", "periph_M01") + bus("MASTER", "M_AXI_S2MM", "dma_1_S2MM") +
                  bus("TARGET", "S_AXIS_S2MM", "binary", "axis"),
              segment("M_AXI_S2MM", "processing_system7_0", "S_AXI_HP0", "0x00000000", "0x1FFFFFFF",
                      "MEMORY"));
}

void add_pins(HwhText& text) {
  text.module(
      "axi_gpio_0", "xilinx.com:ip:axi_gpio:2.0",
      parameters({{"C_GPIO_WIDTH", "32"}, {"C_ALL_OUTPUTS", "1"}}),
      system_clk("s_axi_aclk") + resetn("s_axi_aresetn") + pin("O", "gpio_io_o", "control", 32),
      bus("SLAVE", "S_AXI", "periph_M02"));
  text.module(
      "axi_gpio_1", "xilinx.com:ip:axi_gpio:2.0",
      parameters({{"C_GPIO_WIDTH", "32"}, {"C_ALL_INPUTS", "1"}}),
      system_clk("s_axi_aclk") + resetn("s_axi_aresetn") + pin("I", "gpio_io_i", "feature", 32),
      bus("SLAVE", "S_AXI", "periph_M03"));
}

}  // namespace

HwhText thesis_handoff() {
  HwhText text("thesis_bd");
  add_processing_system(text);
  add_buses(text);
  add_engines(text);
  add_pins(text);
  text.module(
      "feature_extraction_0", "markervp:marker:feature_extraction:1.0",
      parameters({{"WIDTH", "640"}, {"HEIGHT", "480"}, {"BURST_WORDS", "32"}}),
      system_clk("system_clk") +
          pin("I", "pixel_clk", "ps_FCLK_CLK1", 1, R"(SIGIS="clk" CLKFREQUENCY="50000000")") +
          pin("I", "por", "rst_reset", 1, R"(SIGIS="rst" POLARITY="ACTIVE_HIGH")") +
          pin("I", "gpio_in", "control", 32) + pin("O", "feature", "feature", 32),
      bus("TARGET", "image", "image", "axis") + bus("INITIATOR", "binary", "binary", "axis"));
  return text;
}

}  // namespace kit
