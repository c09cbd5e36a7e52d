#include <chip/block_design/shelf.h>

#include <vp/text.h>

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
          {"C_SG_LENGTH_WIDTH", "14"},
          {"C_INCLUDE_MM2S", "1", {"0", "1"}},
          {"C_M_AXI_MM2S_DATA_WIDTH", "32", {"32", "64", "128", "256", "512"}},
          {"C_M_AXIS_MM2S_TDATA_WIDTH", "32", {"8", "16", "32"}},
          {"C_INCLUDE_MM2S_DRE", "0", {"0", "1"}},
          {"C_MM2S_BURST_SIZE", "16"},
          {"C_INCLUDE_S2MM", "1", {"0", "1"}},
          {"C_M_AXI_S2MM_DATA_WIDTH", "32", {"32", "64", "128", "256", "512"}},
          {"C_S_AXIS_S2MM_TDATA_WIDTH", "32", {"8", "16", "32"}},
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
                                  {"USE_DYN_RECONFIG", "false", {"false", "0"}},
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

std::vector<IpRule> rules() {
  const std::vector<ParameterRule> logic{{"C_OPERATION", "and", {"and", "or", "xor", "not"}},
                                         {"C_SIZE", "8"}};
  const std::vector<ParameterRule> slice{{"DIN_WIDTH", "32"}, {"DIN_FROM", "0"}, {"DIN_TO", "0"}};
  const std::vector<ParameterRule> constant{{"CONST_WIDTH", "1"}, {"CONST_VAL", "1"}};
  std::vector<IpRule> list{
      {"processing_system7", Kind::model, "processing system of the Zynq-7000 (UG585)"},
      {"axi_dma", Kind::model, "AXI DMA, direct and scatter-gather (PG021)", dma_parameters()},
      {"axi_gpio", Kind::model, "AXI GPIO (PG144)", gpio_parameters()},
      {"axi_bram_ctrl",
       Kind::model,
       "AXI BRAM controller with its memory (PG078)",
       {{"C_S_AXI_PROTOCOL", "AXI4", {"AXI4", "AXI4LITE"}},
        {"C_S_AXI_DATA_WIDTH", "32", {"32"}},
        {"C_SINGLE_PORT_BRAM", "0", {"0", "1"}},
        {"C_ECC", "0", {"0"}}}},
      {"proc_sys_reset",
       Kind::model,
       "processor system reset (PG164)",
       {{"C_EXT_RST_WIDTH", "4"},
        {"C_AUX_RST_WIDTH", "4"},
        {"C_EXT_RESET_HIGH", "0", {"0", "1"}},
        {"C_AUX_RESET_HIGH", "0", {"0", "1"}}}},
      {"clk_wiz", Kind::model, "MMCM or PLL of the fabric (PG065, UG472), without registers",
       clock_parameters()},
      {"axi_interconnect", Kind::bus, "AXI Interconnect (PG059)"},
      {"smartconnect", Kind::bus, "SmartConnect (PG247)"},
      {"axi_protocol_converter", Kind::bus, "AXI protocol converter (PG059)"},
      {"axi_dwidth_converter", Kind::bus, "AXI data width converter (PG059)"},
      {"axi_clock_converter", Kind::bus, "AXI clock converter (PG059)"},
      {"axi_register_slice", Kind::bus, "AXI register slice (PG059)"},
      {"axi_data_fifo", Kind::bus, "AXI data FIFO (PG059)"},
      {"axis_data_fifo",
       Kind::model,
       "AXI4-Stream FIFO of up to 32 bits (PG085)",
       {{"FIFO_DEPTH", "512"},
        {"FIFO_MODE", "1", {"1"}},
        {"IS_ACLK_ASYNC", "0", {"0"}},
        {"TDATA_NUM_BYTES", "4", {"1", "2", "3", "4"}}}},
      {"axis_register_slice",
       Kind::model,
       "AXI4-Stream register slice of up to 32 bits (PG085)",
       {{"TDATA_NUM_BYTES", "4", {"1", "2", "3", "4"}}}},
      {"axis_dwidth_converter",
       Kind::model,
       "AXI4-Stream width converter, 8 to 32 bits (PG085)",
       {{"S_TDATA_NUM_BYTES", "4", {"1", "2", "3", "4"}},
        {"M_TDATA_NUM_BYTES", "4", {"1", "2", "3", "4"}}}},
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
      {"blk_mem_gen", Kind::left_out, "block memory: that of a BRAM controller is part of it"},
      {"ila", Kind::left_out, "logic analyser"},
      {"system_ila", Kind::left_out, "logic analyser"},
      {"vio", Kind::left_out, "virtual pins of the debugger"},
      {"jtag_axi", Kind::left_out, "bus master of the debugger"},
      {"debug_bridge", Kind::left_out, "debugger"}};
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

const IpRule* rule_for(const std::string& vlnv) {
  const std::vector<std::string> parts = vp::split(vlnv, ':');
  if (parts.size() != 4) return nullptr;
  const bool is_vendors = (parts[0] == "xilinx.com" || parts[0] == "amd.com") &&
                          (parts[1] == "ip" || parts[1] == "inline_hdl");
  if (!is_vendors) return nullptr;
  const auto& list = shelf();
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const IpRule& rule) { return rule.ip == parts[2]; });
  return found == list.end() ? nullptr : &*found;
}

const ParameterRule* find_parameter(const IpRule& rule, const std::string& name) {
  const auto found = std::find_if(rule.parameters.begin(), rule.parameters.end(),
                                  [&](const ParameterRule& p) { return same(p.name, name); });
  return found == rule.parameters.end() ? nullptr : &*found;
}

bool is_allowed(const ParameterRule& rule, const std::string& value) {
  if (rule.allowed.empty() || rule.allowed.front() == "*") return true;
  return std::any_of(rule.allowed.begin(), rule.allowed.end(),
                     [&](const std::string& one) { return same(one, value); });
}

}  // namespace platform::block_design
