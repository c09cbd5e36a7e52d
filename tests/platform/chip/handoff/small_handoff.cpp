#include "small_handoff.h"

#include <boost/test/unit_test.hpp>

namespace kit {

namespace {

constexpr const char* clock = R"(SIGIS="clk" CLKFREQUENCY="100000000")";
constexpr const char* fclk = "ps_FCLK_CLK0";

std::string clocked(const std::string& name) {
  return pin("I", name, fclk, 1, clock);
}

std::string list(const std::string& name, const std::string& items) {
  return "<" + name + ">" + items + "</" + name + ">";
}

}  // namespace

std::string element(const std::string& name,
                    const std::vector<std::pair<std::string, std::string>>& attributes,
                    const std::string& inside) {
  std::string text = "<" + name;
  for (const auto& [key, value] : attributes) text += " " + key + "=\"" + value + "\"";
  return text + (inside.empty() ? "/>\n" : ">" + inside + "</" + name + ">\n");
}

std::string pin(const std::string& direction, const std::string& name, const std::string& signal,
                unsigned width, const std::string& more) {
  std::string text = "<PORT DIR=\"" + direction + "\" NAME=\"" + name + "\"";
  if (width > 1) text += " LEFT=\"" + std::to_string(width - 1) + "\" RIGHT=\"0\"";
  if (!signal.empty()) text += " SIGNAME=\"" + signal + "\"";
  return text + " " + (more.empty() ? "SIGIS=\"undef\"" : more) + "/>\n";
}

std::string parameter(const std::string& name, const std::string& value) {
  return element("PARAMETER", {{"NAME", name}, {"VALUE", value}});
}

std::string bus(const std::string& type, const std::string& name, const std::string& bus_name,
                const std::string& kind) {
  return element("BUSINTERFACE", {{"BUSNAME", bus_name},
                                  {"NAME", name},
                                  {"TYPE", type},
                                  {"VLNV", "xilinx.com:interface:" + kind + ":1.0"}});
}

std::string segment(const std::string& master, const std::string& instance,
                    const std::string& slave, const std::string& base, const std::string& last,
                    const std::string& type) {
  return element("MEMRANGE", {{"BASEVALUE", base},
                              {"HIGHVALUE", last},
                              {"INSTANCE", instance},
                              {"MASTERBUSINTERFACE", master},
                              {"MEMTYPE", type},
                              {"SLAVEBUSINTERFACE", slave}});
}

HwhText& HwhText::module(const std::string& instance, const std::string& vlnv,
                         const std::string& parameters, const std::string& pins,
                         const std::string& buses, const std::string& segments) {
  const std::string type = vlnv.substr(vlnv.find(':', vlnv.find(':') + 1) + 1);
  modules_ += element("MODULE",
                      {{"FULLNAME", "/" + instance},
                       {"INSTANCE", instance},
                       {"MODTYPE", type.substr(0, type.find(':'))},
                       {"VLNV", vlnv}},
                      list("PARAMETERS", parameters) + list("PORTS", pins) +
                          list("BUSINTERFACES", buses) + list("MEMORYMAP", segments));
  return *this;
}

HwhText& HwhText::external(const std::string& text) {
  external_ += text;
  return *this;
}

std::string HwhText::text() const {
  return "<?xml version=\"1.0\"?>\n" +
         element("EDKSYSTEM", {{"EDWVERSION", "1.2"}, {"VIVADOVERSION", "2021.1"}},
                 element("SYSTEMINFO", {{"ARCH", arch},
                                        {"DEVICE", device},
                                        {"NAME", name_},
                                        {"PACKAGE", "clg400"},
                                        {"SPEEDGRADE", "-1"}}) +
                     list("EXTERNALPORTS", external_) + list("MODULES", modules_));
}

HwhText small_handoff() {
  HwhText text;
  text.module("ps", "xilinx.com:ip:processing_system7:5.5",
              parameter("PCW_CRYSTAL_PERIPHERAL_FREQMHZ", "50") +
                  parameter("PCW_ACT_APU_PERIPHERAL_FREQMHZ", "650.000000") +
                  parameter("PCW_DDR_RAM_HIGHADDR", "0x1FFFFFFF") +
                  parameter("PCW_UIPARAM_DDR_BUS_WIDTH", "16 Bit") +
                  parameter("PCW_UART0_PERIPHERAL_ENABLE", "1") +
                  parameter("PCW_MIO_3_PULLUP", "disabled") +
                  parameter("PCW_MIO_14_PULLUP", "disabled") +
                  parameter("PCW_MIO_15_PULLUP", "&lt;Select&gt;") +
                  parameter("PCW_MIO_16_PULLUP", "enabled"),
              pin("O", "FCLK_CLK0", fclk, 1, clock) +
                  pin("O", "FCLK_RESET0_N", "ps_FCLK_RESET0_N", 1, R"(SIGIS="rst")") +
                  clocked("M_AXI_GP0_ACLK") + clocked("S_AXI_HP0_ACLK") +
                  pin("I", "IRQ_F2P", "lines_dout", 3),
              bus("MASTER", "M_AXI_GP0", "ps_M_AXI_GP0") + bus("SLAVE", "S_AXI_HP0", "mem_M00_AXI"),
              segment("M_AXI_GP0", "axi_dma_0", "S_AXI_LITE", "0x40400000", "0x4040FFFF") +
                  segment("M_AXI_GP0", "axi_gpio_0", "S_AXI", "0x41200000", "0x4120FFFF") +
                  segment("M_AXI_GP0", "own_0", "S00_AXI", "0x43C00000", "0x43C0FFFF"));
  text.module("periph", "xilinx.com:ip:axi_interconnect:2.1", "",
              clocked("ACLK") + clocked("S00_ACLK"),
              bus("SLAVE", "S00_AXI", "ps_M_AXI_GP0") + bus("MASTER", "M00_AXI", "periph_M00") +
                  bus("MASTER", "M01_AXI", "periph_M01") + bus("MASTER", "M02_AXI", "periph_M02"));
  text.module("mem", "xilinx.com:ip:smartconnect:1.0", "", clocked("aclk"),
              bus("SLAVE", "S00_AXI", "dma_MM2S") + bus("SLAVE", "S01_AXI", "dma_S2MM") +
                  bus("MASTER", "M00_AXI", "mem_M00_AXI"));
  text.module("rst_0", "xilinx.com:ip:proc_sys_reset:5.0", parameter("C_EXT_RESET_HIGH", "0"),
              clocked("slowest_sync_clk") + pin("I", "ext_reset_in", "ps_FCLK_RESET0_N") +
                  pin("I", "dcm_locked", "clk_0_locked") +
                  pin("O", "peripheral_aresetn", "rst_0_aresetn"));
  text.module(
      "clk_0", "xilinx.com:ip:clk_wiz:6.0",
      parameter("PRIMITIVE", "MMCM") + parameter("MMCM_DIVCLK_DIVIDE", "4") +
          parameter("MMCM_CLKFBOUT_MULT_F", "37.125") +
          parameter("MMCM_CLKOUT0_DIVIDE_F", "12.500") + parameter("CLK_OUT1_PORT", "pixel_clk"),
      clocked("clk_in1") + pin("O", "locked", "clk_0_locked") +
          pin("O", "pixel_clk", "clk_0_pixel_clk", 1, R"(SIGIS="clk" CLKFREQUENCY="7.425e+07")"));
  text.module("axi_dma_0", "xilinx.com:ip:axi_dma:7.1",
              parameter("C_INCLUDE_SG", "0") + parameter("C_SG_LENGTH_WIDTH", "20"),
              clocked("s_axi_lite_aclk") + clocked("m_axi_mm2s_aclk") + clocked("m_axi_s2mm_aclk") +
                  pin("I", "axi_resetn", "rst_0_aresetn") +
                  pin("O", "mm2s_introut", "dma_mm2s_introut") +
                  pin("O", "s2mm_introut", "dma_s2mm_introut"),
              bus("SLAVE", "S_AXI_LITE", "periph_M00") + bus("MASTER", "M_AXI_MM2S", "dma_MM2S") +
                  bus("MASTER", "M_AXI_S2MM", "dma_S2MM") +
                  bus("INITIATOR", "M_AXIS_MM2S", "loop", "axis") +
                  bus("TARGET", "S_AXIS_S2MM", "loop", "axis"),
              segment("M_AXI_MM2S", "ps", "S_AXI_HP0", "0x00000000", "0x1FFFFFFF", "MEMORY") +
                  segment("M_AXI_S2MM", "ps", "S_AXI_HP0", "0x00000000", "0x1FFFFFFF", "MEMORY"));
  text.module("axi_gpio_0", "xilinx.com:ip:axi_gpio:2.0",
              parameter("C_GPIO_WIDTH", "4") + parameter("C_INTERRUPT_PRESENT", "1") +
                  parameter("C_IS_DUAL", "0"),
              clocked("s_axi_aclk") + pin("I", "s_axi_aresetn", "rst_0_aresetn") +
                  pin("I", "gpio_io_i", "buttons", 4) + pin("O", "gpio_io_o", "leds", 4) +
                  pin("O", "ip2intc_irpt", "gpio_irpt"),
              bus("SLAVE", "S_AXI", "periph_M01"));
  text.module("own_0", "me:user:own:1.0", parameter("WIDTH", "8"),
              clocked("s00_axi_aclk") + pin("O", "done", "own_done"),
              bus("SLAVE", "S00_AXI", "periph_M02") + bus("MASTER", "M_NOTHING", "__NOC__"));
  text.module("of_dma", "xilinx.com:ip:xlconcat:2.1", parameter("NUM_PORTS", "2"),
              pin("I", "In0", "dma_s2mm_introut") + pin("I", "In1", "dma_mm2s_introut") +
                  pin("O", "dout", "of_dma_dout", 2));
  text.module("lines", "xilinx.com:ip:xlconcat:2.1",
              parameter("NUM_PORTS", "2") + parameter("IN0_WIDTH", "2"),
              pin("I", "In0", "of_dma_dout", 2) + pin("I", "In1", "gpio_irpt") +
                  pin("O", "dout", "lines_dout", 3));
  text.external(pin("I", "buttons", "buttons", 4) + pin("O", "leds", "leds", 4));
  return text;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  BOOST_TEST_REQUIRE(at != std::string::npos, what);
  return text.replace(at, what.size(), by);
}

}  // namespace kit
