#include <chip/block_design/shelf.h>

#include <string>
#include <utility>

// IP of AXI4-Streams, and FIFOs, by the parameters of the product guides.
namespace platform::block_design {

namespace {

/// Of a part that passes beats as they are: how wide they are, and what goes beside the bytes.
std::vector<ParameterRule> stream_parameters(std::vector<ParameterRule> list) {
  list.push_back({"TDATA_NUM_BYTES", "4", {}, 1, 128});
  list.push_back({"HAS_TSTRB", "0", {"0", "1"}});
  for (const char* name : {"TUSER_WIDTH", "TID_WIDTH", "TDEST_WIDTH"})
    list.push_back({name, "0", {}, 0, 1024});
  return list;
}

IpRule subset_converter() {
  std::vector<ParameterRule> list;
  for (const std::string end : {"S", "M"}) {
    list.push_back({end + "_TDATA_NUM_BYTES", "4", {}, 1, 128});
    for (const char* name : {"_TUSER_WIDTH", "_TID_WIDTH", "_TDEST_WIDTH"})
      list.push_back({end + name, "0", {}, 0, 64});
  }
  for (const char* name :
       {"TDATA_REMAP", "TUSER_REMAP", "TKEEP_REMAP", "TLAST_REMAP", "TID_REMAP", "TDEST_REMAP"})
    list.push_back({name, ""});
  list.push_back({"M_HAS_TKEEP", "0", {"0", "1"}});
  list.push_back({"M_HAS_TLAST", "1", {"0", "1"}});
  list.push_back({"DEFAULT_TLAST", "0"});
  return {"axis_subset_converter", Kind::model,
          "AXI4-Stream subset converter (PG085): takes a clock, where the vendor's has none unless "
          "it is asked for",
          std::move(list)};
}

IpRule fifo_generator() {
  return {"fifo_generator",
          Kind::model,
          "FIFO generator with native ports of equal widths, or AXI4-Stream (PG057)",
          {{"INTERFACE_TYPE", "Native", {"Native", "AXI_STREAM"}},
           {"C_COMMON_CLOCK", "1", {"0", "1"}},
           {"C_DIN_WIDTH", "18", {}, 1, 64},
           {"asymmetric_port_width", "false", {"false"}},
           {"C_WR_DEPTH", "1024", {}, 16, 131072},
           {"C_PRELOAD_LATENCY", "1", {"0", "1"}},
           {"C_SYNCHRONIZER_STAGE", "2", {}, 1, 8},
           {"C_USE_ECC", "0", {"0"}},
           {"C_VALID_LOW", "0", {"0"}},
           {"C_WR_ACK_LOW", "0", {"0"}},
           {"C_OVERFLOW_LOW", "0", {"0"}},
           {"C_UNDERFLOW_LOW", "0", {"0"}},
           {"TDATA_NUM_BYTES", "1", {}, 1, 128},
           {"TUSER_WIDTH", "4", {}, 0, 1024},
           {"TID_WIDTH", "0", {}, 0, 1024},
           {"TDEST_WIDTH", "0", {}, 0, 1024},
           {"Input_Depth_axis", "1024", {}, 16, 65536},
           {"FIFO_Implementation_axis", "Common_Clock_Block_RAM"},
           {"FIFO_Application_Type_axis", "Data_FIFO", {"Data_FIFO"}}}};
}

}  // namespace

std::vector<IpRule> stream_rules() {
  std::vector<ParameterRule> broadcaster{{"NUM_MI", "2", {}, 2, 16},
                                         {"S_TDATA_NUM_BYTES", "4", {}, 1, 128},
                                         {"M_TDATA_NUM_BYTES", "4", {}, 1, 128},
                                         {"S_TUSER_WIDTH", "0", {}, 0, 32},
                                         {"TID_WIDTH", "0", {"0"}},
                                         {"TDEST_WIDTH", "0", {"0"}}};
  for (unsigned n = 0; n < 16; ++n)
    broadcaster.push_back({(n < 10 ? "M0" : "M") + std::to_string(n) + "_TDATA_REMAP", ""});
  return {
      {"axis_data_fifo", Kind::model, "AXI4-Stream FIFO with one clock or two (PG085)",
       stream_parameters(
           {{"FIFO_DEPTH", "512"}, {"FIFO_MODE", "1", {"1"}}, {"IS_ACLK_ASYNC", "0", {"0", "1"}}})},
      {"axis_clock_converter", Kind::model,
       "AXI4-Stream clock converter (PG085): a FIFO of 32 beats (assumed)", stream_parameters({})},
      {"axis_register_slice", Kind::model, "AXI4-Stream register slice (PG085)",
       stream_parameters({})},
      {"axis_dwidth_converter",
       Kind::model,
       "AXI4-Stream width converter without TUSER, TID and TDEST (PG085)",
       {{"S_TDATA_NUM_BYTES", "4", {}, 1, 128},
        {"M_TDATA_NUM_BYTES", "4", {}, 1, 128},
        {"TUSER_BITS_PER_BYTE", "0", {"0"}},
        {"TID_WIDTH", "0", {"0"}},
        {"TDEST_WIDTH", "0", {"0"}}}},
      {"axis_broadcaster", Kind::model,
       "AXI4-Stream broadcaster without TID and TDEST (PG085): takes a clock",
       std::move(broadcaster)},
      {"axis_combiner",
       Kind::model,
       "AXI4-Stream combiner without TID and TDEST (PG085): takes a clock",
       {{"NUM_SI", "2", {}, 2, 16},
        {"TDATA_NUM_BYTES", "4", {}, 1, 64},
        {"TUSER_WIDTH", "0", {}, 0, 32},
        {"MASTER_PORT_NUM", "0", {}, 0, 15},
        {"TID_WIDTH", "0", {"0"}},
        {"TDEST_WIDTH", "0", {"0"}}}},
      subset_converter(),
      fifo_generator()};
}

}  // namespace platform::block_design
