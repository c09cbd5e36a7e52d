#include <chip/block_design/own_ip.h>
#include <chip/block_design/shelf.h>

#include <vp/text.h>
#include <vp/unit.h>

#include <strings.h>
#include <algorithm>

namespace platform::block_design {

namespace {

bool same(const std::string& a, const std::string& b) {
  return ::strcasecmp(a.c_str(), b.c_str()) == 0;
}

std::vector<ParameterRule> gpio_parameters() {
  std::vector<ParameterRule> list{{"C_IS_DUAL", "0", {"0", "1"}},
                                  {"C_INTERRUPT_PRESENT", "0", {"0", "1"}}};
  for (const std::string channel : {"", "_2"}) {
    const std::string gpio = channel.empty() ? "C_GPIO" : "C_GPIO2";
    list.push_back({gpio + "_WIDTH", "32"});
    list.push_back({"C_ALL_INPUTS" + channel, "0", {"0", "1"}});
    list.push_back({"C_ALL_OUTPUTS" + channel, "0", {"0", "1"}});
    list.push_back({"C_DOUT_DEFAULT" + channel, "0x00000000"});
    list.push_back({"C_TRI_DEFAULT" + channel, "0xFFFFFFFF"});
  }
  return list;
}

std::vector<ParameterRule> dma_parameters() {
  return {{"C_INCLUDE_SG", "1", {"0", "1"}},
          {"C_ENABLE_MULTI_CHANNEL", "0", {"0"}},
          {"C_MICRO_DMA", "0", {"0"}},
          {"C_SG_INCLUDE_STSCNTRL_STRM", "0", {"0"}},
          {"C_SINGLE_INTERFACE", "0", {"0", "1"}},
          {"C_SG_LENGTH_WIDTH", "14"},
          {"C_INCLUDE_MM2S", "1", {"0", "1"}},
          {"C_M_AXI_MM2S_DATA_WIDTH", "32", {"32", "64", "128", "256", "512", "1024"}},
          {"C_M_AXIS_MM2S_TDATA_WIDTH", "32", {"8", "16", "32", "64", "128", "256", "512", "1024"}},
          {"C_INCLUDE_MM2S_DRE", "0", {"0", "1"}},
          {"C_MM2S_BURST_SIZE", "16"},
          {"C_INCLUDE_S2MM", "1", {"0", "1"}},
          {"C_M_AXI_S2MM_DATA_WIDTH", "32", {"32", "64", "128", "256", "512", "1024"}},
          {"C_S_AXIS_S2MM_TDATA_WIDTH", "32", {"8", "16", "32", "64", "128", "256", "512", "1024"}},
          {"C_INCLUDE_S2MM_DRE", "0", {"0", "1"}},
          {"C_S2MM_BURST_SIZE", "16"}};
}

std::vector<ParameterRule> concat_parameters() {
  std::vector<ParameterRule> list{{"NUM_PORTS", "2"}};
  for (unsigned i = 0; i < 128; ++i) list.push_back({"IN" + std::to_string(i) + "_WIDTH", "1"});
  return list;
}

std::vector<ParameterRule> clock_parameters() {
  std::vector<ParameterRule> list{{"PRIM_IN_FREQ", "100.000"},
                                  {"PRIMITIVE", "MMCM", {"MMCM", "PLL", "Auto", "None"}},
                                  {"USE_DYN_RECONFIG", "false", {"false", "true", "0", "1"}},
                                  {"INTERFACE_SELECTION", "Enable_AXI", {"Enable_AXI"}},
                                  {"USE_DYN_PHASE_SHIFT", "false", {"false", "0"}},
                                  {"RESET_TYPE", "ACTIVE_HIGH", {"ACTIVE_HIGH", "ACTIVE_LOW"}},
                                  {"MMCM_DIVCLK_DIVIDE", "1"},
                                  {"MMCM_CLKFBOUT_MULT_F", "10.000"},
                                  {"MMCM_CLKOUT0_DIVIDE_F", "10.000"}};
  for (unsigned i = 1; i < 7; ++i)
    list.push_back({"MMCM_CLKOUT" + std::to_string(i) + "_DIVIDE", "1"});
  for (unsigned i = 1; i < 8; ++i) {
    const std::string n = std::to_string(i);
    list.push_back({"CLK_OUT" + n + "_PORT", "clk_out" + n, {"*"}});
  }
  return list;
}

/// Levels of single pins: Vivado writes "1" with quotation marks.
ParameterRule polarity(const std::string& name) {
  return {name, "1", {"0", "1"}};
}

/// A build option of which only one value is modelled.
ParameterRule only(const std::string& name, const std::string& value) {
  return {name, value, {value}};
}

ParameterRule in_range(const std::string& name, const std::string& usual, std::uint64_t least,
                       std::uint64_t most) {
  return {name, usual, {}, least, most};
}

IpRule memory() {
  std::vector<ParameterRule> list{only("C_INTERFACE_TYPE", "0"),
                                  {"C_MEM_TYPE", "0", {"0", "1", "2", "3", "4"}},
                                  {"C_USE_BRAM_BLOCK", "0", {"0", "1"}},
                                  {"C_BYTE_SIZE", "9", {"8", "9"}},
                                  only("C_USE_ECC", "0"),
                                  only("C_USE_SOFTECC", "0"),
                                  only("C_MUX_PIPELINE_STAGES", "0"),
                                  only("C_EN_SLEEP_PIN", "0"),
                                  {"C_LOAD_INIT_FILE", "0", {"0", "1"}},
                                  {"Coe_File", "no_coe_file_loaded", {"*"}},
                                  {"C_USE_DEFAULT_DATA", "0", {"0", "1"}},
                                  {"C_DEFAULT_DATA", "0", {"*"}},
                                  {"C_COUNT_36K_BRAM", "0"},
                                  {"C_COUNT_18K_BRAM", "0"}};
  for (const std::string end : {"A", "B"}) {
    list.push_back(in_range("C_WRITE_WIDTH_" + end, "9", 1, 64));
    list.push_back(in_range("C_READ_WIDTH_" + end, "9", 1, 64));
    list.push_back(in_range("C_WRITE_DEPTH_" + end, "2048", 2, 1u << 20));
    list.push_back(in_range("C_READ_DEPTH_" + end, "2048", 2, 1u << 20));
    list.push_back(
        {"C_WRITE_MODE_" + end, "WRITE_FIRST", {"WRITE_FIRST", "READ_FIRST", "NO_CHANGE"}});
    list.push_back({"C_INIT" + end + "_VAL", "0", {"*"}});
    for (const char* name :
         {"C_HAS_EN", "C_USE_BYTE_WE", "C_HAS_MEM_OUTPUT_REGS_", "C_HAS_MUX_OUTPUT_REGS_"})
      list.push_back({name + end, "0", {"0", "1"}});
  }
  return {
      "blk_mem_gen", Kind::model,
      "block memory with native ports (PG058); a BRAM controller at a port lets software see it",
      std::move(list)};
}

IpRule timer() {
  return {"axi_timer",
          Kind::model,
          "AXI timer (PG079)",
          {{"C_COUNT_WIDTH", "32", {"8", "16", "32"}},
           {"C_ONE_TIMER_ONLY", "0", {"0", "1"}},
           polarity("C_GEN0_ASSERT"),
           polarity("C_GEN1_ASSERT"),
           polarity("C_TRIG0_ASSERT"),
           polarity("C_TRIG1_ASSERT")}};
}

IpRule interrupt_controller() {
  return {"axi_intc",
          Kind::model,
          "AXI interrupt controller (PG099), without fast mode",
          {{"C_NUM_INTR_INPUTS", "1", {}, 1, 32},
           {"C_KIND_OF_INTR", "0xFFFFFFFF"},
           {"C_KIND_OF_EDGE", "0xFFFFFFFF"},
           {"C_KIND_OF_LVL", "0xFFFFFFFF"},
           only("C_HAS_FAST", "0"),
           only("C_HAS_ILR", "0"),
           only("C_HAS_IPR", "1"),
           only("C_HAS_SIE", "1"),
           only("C_HAS_CIE", "1"),
           only("C_HAS_IVR", "1"),
           only("C_NUM_SW_INTR", "0"),
           only("C_EN_CASCADE_MODE", "0"),
           only("C_IRQ_IS_LEVEL", "1"),
           {"C_IRQ_ACTIVE", "0x1", {"0x1", "1", "0x0", "0"}}}};
}

IpRule iic() {
  return {"axi_iic",
          Kind::model,
          "AXI IIC as a master (PG090)",
          {{"C_IIC_FREQ", "100000", {}, 1'000, 1'000'000},
           {"C_GPO_WIDTH", "1", {}, 1, 8},
           {"C_DEFAULT_VALUE", "0x00"},
           only("C_TEN_BIT_ADR", "0"),
           only("C_SMBUS_PMBUS_HOST", "0")}};
}

IpRule uartlite() {
  return {"axi_uartlite",
          Kind::model,
          "AXI UART Lite (PG142); `tx` may lead to the `rx` of another one",
          {{"C_BAUDRATE", "9600", {}, 110, 921'600},
           {"C_DATA_BITS", "8", {"5", "6", "7", "8"}},
           {"C_USE_PARITY", "0", {"0", "1"}},
           {"C_ODD_PARITY", "0", {"0", "1"}}}};
}

IpRule quad_spi() {
  return {"axi_quad_spi",
          Kind::model,
          "AXI Quad SPI as a master, standard mode (PG153)",
          {{"C_SCK_RATIO", "16", {}, 2, 2048},
           {"C_NUM_SS_BITS", "1", {}, 1, 32},
           {"C_FIFO_DEPTH", "16", {"16", "256"}},
           {"C_NUM_TRANSFER_BITS", "8", {"8", "16", "32"}},
           only("C_SPI_MODE", "0"),
           only("C_TYPE_OF_AXI4_INTERFACE", "0"),
           only("C_XIP_MODE", "0"),
           only("C_DUAL_QUAD_MODE", "0"),
           only("C_BYTE_LEVEL_INTERRUPT_EN", "0"),
           only("Master_mode", "1")}};
}

IpRule stream_fifo() {
  return {"axi_fifo_mm_s",
          Kind::model,
          "AXI4-Stream FIFO, store and forward, AXI4-Lite data (PG080)",
          {{"C_USE_TX_DATA", "1", {"0", "1"}},
           {"C_USE_RX_DATA", "1", {"0", "1"}},
           {"C_TX_FIFO_DEPTH", "512", {}, 512, 131'072},
           {"C_RX_FIFO_DEPTH", "512", {}, 512, 131'072},
           {"C_HAS_AXIS_TKEEP", "0", {"0", "1"}},
           only("C_DATA_INTERFACE_TYPE", "0"),
           only("C_USE_TX_CTRL", "0"),
           only("C_USE_TX_CUT_THROUGH", "0"),
           only("C_USE_RX_CUT_THROUGH", "0"),
           only("C_HAS_AXIS_TDEST", "0"),
           only("C_HAS_AXIS_TID", "0"),
           only("C_HAS_AXIS_TSTRB", "0"),
           only("C_HAS_AXIS_TUSER", "0"),
           only("C_AXI_STR_TXD_TDATA_WIDTH", "32"),
           only("C_AXI_STR_RXD_TDATA_WIDTH", "32")}};
}

IpRule central_dma() {
  return {"axi_cdma",
          Kind::model,
          "AXI central DMA, simple mode (PG034)",
          {only("C_INCLUDE_SG", "0"),
           only("C_INCLUDE_DRE", "0"),
           only("C_USE_DATAMOVER_LITE", "0"),
           {"C_M_AXI_DATA_WIDTH", "32", {"32", "64", "128", "256", "512", "1024"}},
           {"C_M_AXI_MAX_BURST_LEN", "16", {"2", "4", "8", "16", "32", "64", "128", "256"}}}};
}

IpRule video_dma() {
  std::vector<ParameterRule> list{{"C_NUM_FSTORES", "3", {}, 1, 16},
                                  only("C_INCLUDE_SG", "0"),
                                  only("C_ENABLE_VIDPRMTR_READS", "1"),
                                  only("C_FLUSH_ON_FSYNC", "1"),
                                  only("C_USE_MM2S_FSYNC", "0"),
                                  only("C_USE_S2MM_FSYNC", "2"),
                                  only("C_ENABLE_VERT_FLIP", "0"),
                                  {"C_USE_FSYNC", "1", {}, 0, 3},
                                  {"C_INCLUDE_INTERNAL_GENLOCK", "1", {"0", "1"}}};
  for (const std::string channel : {"MM2S", "S2MM"}) {
    const std::string stream = channel == "MM2S" ? "C_M_AXIS_MM2S" : "C_S_AXIS_S2MM";
    list.push_back({"C_INCLUDE_" + channel, "1", {"0", "1"}});
    list.push_back({"C_INCLUDE_" + channel + "_DRE", "0", {"0", "1"}});
    list.push_back({"C_" + channel + "_GENLOCK_MODE", channel == "MM2S" ? "1" : "0", {}, 0, 3});
    list.push_back(only("C_" + channel + "_SOF_ENABLE", "1"));
    list.push_back(
        {"C_M_AXI_" + channel + "_DATA_WIDTH", "64", {"32", "64", "128", "256", "512", "1024"}});
    list.push_back({stream + "_TDATA_WIDTH", "32", {}, 8, 1024});
    list.push_back({"C_" + channel + "_MAX_BURST_LENGTH", "8", {}, 2, 256});
    list.push_back({"C_" + channel + "_LINEBUFFER_DEPTH", "512", {}, 0, 65536});
  }
  return {"axi_vdma", Kind::model,
          "AXI VDMA, direct registers: MM2S free running, S2MM by TUSER(0) (PG020)",
          std::move(list)};
}

/// INIT_40 … INIT_5F of the converter, by the vendor's names of them.
std::vector<ParameterRule> converter_parameters() {
  std::vector<ParameterRule> list{only("INTERFACE_SELECTION", "Enable_AXI"),
                                  {"C_HAS_AXI4STREAM", "0", {"0", "1"}},
                                  only("C_HAS_EXTERNAL_MUX", "0"),
                                  only("TIMING_MODE", "Continuous"),
                                  {"CHANNEL_AVERAGING", "None", {"None", "16", "64", "256"}},
                                  {"SEQUENCER_MODE", "Off", {"Off", "Continuous"}},
                                  {"C_CONFIGURATION_R0", "0"},
                                  {"C_CONFIGURATION_R1", "0"},
                                  {"C_CONFIGURATION_R2", "1024", {}, 0x200, 0xFFFF},
                                  {"C_SEQUENCE_R0", "0"},
                                  {"C_SEQUENCE_R1", "0"},
                                  {"C_SEQUENCE_R2", "0"},
                                  {"C_SEQUENCE_R3", "0"},
                                  {"C_SEQUENCE_R4", "0"},
                                  {"C_SEQUENCE_R5", "0"},
                                  {"C_SEQUENCE_R6", "0"},
                                  {"C_SEQUENCE_R7", "0"}};
  for (unsigned i = 0; i < 16; ++i)
    list.push_back({"C_ALARM_LIMIT_R" + std::to_string(i), "0", {}, 0, 0xFFFF});
  return list;
}

std::vector<IpRule> rules() {
  const std::vector<ParameterRule> logic{{"C_OPERATION", "and", {"and", "or", "xor", "not"}},
                                         {"C_SIZE", "8"}};
  const std::vector<ParameterRule> slice{{"DIN_WIDTH", "32"}, {"DIN_FROM", "0"}, {"DIN_TO", "0"}};
  const std::vector<ParameterRule> constant{{"CONST_WIDTH", "1"}, {"CONST_VAL", "1"}};
  std::vector<IpRule> list{
      {"processing_system7", Kind::model,
       "processing system (UG585): M_AXI_GP0 and GP1, S_AXI_GP0, GP1, HP0 to HP3 and ACP to the "
       "DDR (ACP without coherence, so warnings of caches are those of HP), FCLK 0 to 3, IRQ_F2P, "
       "Core0_nFIQ and Core0_nIRQ, "
       "EMIO GPIO; other pins drive 0, and Core1_nFIQ and Core1_nIRQ are not taken (warning)"},
      {"axi_dma", Kind::model,
       "AXI DMA, direct and scatter-gather (PG021); of a memory map wider than the stream MM2S has "
       "the stream's width: the same bytes, longer on the bus",
       dma_parameters()},
      {"axi_gpio", Kind::model, "AXI GPIO (PG144)", gpio_parameters()},
      {"axi_bram_ctrl",
       Kind::model,
       "AXI BRAM controller with its memory, as large as its segment (PG078)",
       {{"C_S_AXI_PROTOCOL", "AXI4", {"AXI4", "AXI4LITE"}},
        {"C_S_AXI_DATA_WIDTH", "32", {"32", "64", "128", "256", "512", "1024"}},
        {"C_SINGLE_PORT_BRAM", "0", {"0", "1"}},
        {"C_ECC", "0", {"0"}}}},
      {"proc_sys_reset",
       Kind::model,
       "processor system reset (PG164)",
       {{"C_EXT_RST_WIDTH", "4"},
        {"C_AUX_RST_WIDTH", "4"},
        {"C_EXT_RESET_HIGH", "0", {"0", "1"}},
        {"C_AUX_RESET_HIGH", "0", {"0", "1"}}}},
      {"clk_wiz", Kind::model, "MMCM or PLL of the fabric (PG065, UG472)", clock_parameters()},
      timer(),
      interrupt_controller(),
      iic(),
      uartlite(),
      quad_spi(),
      stream_fifo(),
      central_dma(),
      video_dma(),
      {"xadc_wiz", Kind::model, "XADC with registers and alarms, without its stream (PG091, UG480)",
       converter_parameters()},
      {"axi_interconnect", Kind::bus,
       "AXI Interconnect (PG059): a way for addresses, with `read_latency` and `write_latency`"},
      {"smartconnect", Kind::bus,
       "SmartConnect (PG247): a way for addresses, with `read_latency` and `write_latency`"},
      {"axi_apb_bridge", Kind::bus,
       "AXI to APB bridge (PG073): a way for addresses, with `read_latency` and `write_latency`"},
      {"axi_protocol_converter", Kind::bus,
       "AXI protocol converter (PG059): a way for addresses, with `read_latency` and "
       "`write_latency`"},
      {"axi_dwidth_converter", Kind::bus,
       "AXI data width converter (PG059): a way for addresses, with `read_latency` and "
       "`write_latency`"},
      {"axi_clock_converter", Kind::bus,
       "AXI clock converter (PG059): a way for addresses, with `read_latency` and `write_latency`"},
      {"axi_register_slice", Kind::bus,
       "AXI register slice (PG059): a way for addresses, with `read_latency` and `write_latency`"},
      {"axi_data_fifo", Kind::bus,
       "AXI data FIFO (PG059): a way for addresses, with `read_latency` and `write_latency`"},
      {"xlconcat", Kind::wiring, "concat", concat_parameters()},
      {"ilconcat", Kind::wiring, "concat", concat_parameters()},
      {"xlslice", Kind::wiring, "slice", slice},
      {"ilslice", Kind::wiring, "slice", slice},
      {"xlconstant", Kind::wiring, "constant", constant},
      {"ilconstant", Kind::wiring, "constant", constant},
      {"util_vector_logic", Kind::wiring, "gates bit by bit", logic},
      {"ilvector_logic", Kind::wiring, "gates bit by bit", logic},
      {"util_reduced_logic",
       Kind::wiring,
       "one gate of all bits",
       {{"C_OPERATION", "and", {"and", "or", "xor"}}, {"C_SIZE", "8"}}},
      memory(),
      {"ila", Kind::left_out, "logic analyser: software sees nothing of it"},
      {"system_ila", Kind::left_out, "logic analyser: software sees nothing of it"},
      {"vio", Kind::left_out, "virtual pins of the debugger"},
      {"jtag_axi", Kind::left_out, "bus master of the debugger"},
      {"debug_bridge", Kind::left_out, "debugger"}};
  for (IpRule& rule : stream_rules()) list.push_back(std::move(rule));
  for (IpRule& rule : video_rules()) list.push_back(std::move(rule));
  for (const OwnIp& own : own_ips()) list.push_back(own.rule);
  std::sort(list.begin(), list.end(), [](const IpRule& a, const IpRule& b) { return a.ip < b.ip; });
  return list;
}

}  // namespace

const char* to_string(Kind kind) {
  switch (kind) {
    case Kind::model:
      return "model";
    case Kind::bus:
      return "bus";
    case Kind::wiring:
      return "wiring";
    case Kind::left_out:
      return "left out";
    case Kind::rtl:
      return "RTL";
    case Kind::stub:
      break;
  }
  return "stub";
}

const std::vector<IpRule>& shelf() {
  static const std::vector<IpRule> list = rules();
  return list;
}

std::string shelf_table() {
  std::string text = "| IP | Here | What | Values that are modelled, where not all are |\n";
  text += "|---|---|---|---|\n";
  for (const IpRule& rule : shelf()) {
    std::vector<std::string> limits;
    for (const ParameterRule& parameter : rule.parameters) {
      const bool has_limits =
          parameter.most != 0 || (!parameter.allowed.empty() && parameter.allowed.front() != "*");
      if (has_limits) limits.push_back("`" + parameter.name + "` " + allowed_values(parameter));
    }
    const std::string of = rule.maker.empty() ? "" : " of `" + rule.maker + "`";
    text += "| `" + rule.ip + "`" + of + " | " + to_string(rule.kind) + " | " + rule.what + " | " +
            vp::join(limits, "; ") + " |\n";
  }
  return text;
}

bool is_of(const IpRule& rule, const std::string& vlnv) {
  const std::vector<std::string> parts = vp::split(vlnv, ':');
  if (parts.size() != 4 || parts[2] != rule.ip) return false;
  if (!rule.maker.empty()) return parts[0] + ":" + parts[1] == rule.maker;
  return (parts[0] == "xilinx.com" || parts[0] == "amd.com") &&
         (parts[1] == "ip" || parts[1] == "inline_hdl");
}

const IpRule* rule_for(const std::string& vlnv) {
  const auto& list = shelf();
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const IpRule& rule) { return is_of(rule, vlnv); });
  return found == list.end() ? nullptr : &*found;
}

const ParameterRule* find_parameter(const IpRule& rule, const std::string& name) {
  const auto found = std::find_if(rule.parameters.begin(), rule.parameters.end(),
                                  [&](const ParameterRule& p) { return same(p.name, name); });
  return found == rule.parameters.end() ? nullptr : &*found;
}

bool is_allowed(const ParameterRule& rule, const std::string& value) {
  if (rule.most != 0) {
    const auto number = vp::Decimal::parse(unquoted(value));
    const auto whole = number ? number->whole() : std::nullopt;
    return whole && *whole >= rule.least && *whole <= rule.most;
  }
  if (rule.allowed.empty() || rule.allowed.front() == "*") return true;
  return std::any_of(rule.allowed.begin(), rule.allowed.end(),
                     [&](const std::string& one) { return same(one, unquoted(value)); });
}

std::string allowed_values(const ParameterRule& rule) {
  if (rule.most != 0) return std::to_string(rule.least) + " to " + std::to_string(rule.most);
  return vp::one_of(rule.allowed);
}

std::string unquoted(std::string word) {
  word.erase(std::remove(word.begin(), word.end(), '"'), word.end());
  return word;
}

}  // namespace platform::block_design
