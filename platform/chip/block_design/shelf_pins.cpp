#include <chip/block_design/shelf.h>

#include <algorithm>
#include <map>

// Pins of the vendor's IP that the models have not as wires, by the names of the product guides.
namespace platform::block_design {

namespace {

using Names = std::vector<std::string>;

/// Analogue inputs are the board's, and so are those of serial lines: their devices are wired to
/// the model as a whole.
Names xadc_inputs() {
  Names names{"vp_in", "vn_in"};
  for (unsigned n = 0; n < 16; ++n) {
    names.push_back("vauxp" + std::to_string(n));
    names.push_back("vauxn" + std::to_string(n));
  }
  return names;
}

const Names& find(const std::map<std::string, Names>& table, const std::string& ip) {
  static const Names none;
  const auto found = table.find(ip);
  return found == table.end() ? none : found->second;
}

const std::map<std::string, Names>& outputs_without_model() {
  static const std::map<std::string, Names> table{
      {"axi_bram_ctrl",
       {"bram_rst_a", "bram_clk_a", "bram_en_a", "bram_we_a", "bram_addr_a", "bram_wrdata_a",
        "bram_rst_b", "bram_clk_b", "bram_en_b", "bram_we_b", "bram_addr_b", "bram_wrdata_b"}},
      {"axi_cdma", {"axi_cdma_tstvec", "cdma_tvect_out"}},
      {"axi_dma", {"axi_dma_tstvec"}},
      {"axi_fifo_mm_s",
       {"mm2s_prmry_reset_out_n", "mm2s_cntrl_reset_out_n", "s2mm_prmry_reset_out_n"}},
      {"axi_iic", {"scl_o", "scl_t", "sda_o", "sda_t"}},
      {"axi_intc", {"interrupt_address"}},
      {"axi_quad_spi",
       {"io0_o", "io0_t", "io1_o", "io1_t", "sck_o", "sck_t", "ss_o", "ss_t", "ss1_o", "ss1_t",
        "cfgclk", "cfgmclk", "eos", "preq"}},
      {"axi_uartlite", {"tx"}},
      {"axi_vdma",
       {"mm2s_frame_ptr_out", "s2mm_frame_ptr_out", "mm2s_fsync_out", "s2mm_fsync_out",
        "mm2s_prmtr_update", "s2mm_prmtr_update", "mm2s_buffer_empty", "mm2s_buffer_almost_empty",
        "s2mm_buffer_full", "s2mm_buffer_almost_full", "mm2s_prmry_reset_out_n",
        "s2mm_prmry_reset_out_n", "axi_vdma_tstvec"}},
      {"blk_mem_gen", {"sbiterra", "dbiterra", "rdaddrecca", "sbiterrb", "dbiterrb", "rdaddreccb"}},
      {"axis_data_fifo",
       {"axis_data_count", "axis_wr_data_count", "axis_rd_data_count", "almost_empty",
        "almost_full", "prog_empty", "prog_full"}},
      {"clk_wiz", {"psdone", "input_clk_stopped", "clkfb_stopped", "cddcdone", "interrupt"}},
      {"fifo_generator",
       {"data_count", "wr_data_count", "rd_data_count", "prog_full", "prog_empty", "wr_rst_busy",
        "rd_rst_busy", "axis_data_count", "axis_wr_data_count", "axis_rd_data_count",
        "axis_prog_full", "axis_prog_empty", "axis_overflow", "axis_underflow", "sbiterr",
        "dbiterr"}},
      {"axis_subset_converter", {"transfer_dropped", "sparse_tkeep_removed"}},
      {"v_axi4s_vid_out", {"status", "fifo_read_level", "sof_state_out", "vid_field_id"}},
      {"v_tc", {"active_chroma_out", "field_id_out"}},
      {"v_vid_in_axi4s", {"fid", "vtd_field_id"}},
      {"xadc_wiz",
       {"channel_out", "eoc_out", "eos_out", "busy_out", "temp_out", "muxaddr_out",
        "jtaglocked_out", "jtagmodified_out", "jtagbusy_out"}}};
  return table;
}

}  // namespace

const std::vector<std::string>& board_inputs(const std::string& ip) {
  static const std::map<std::string, Names> table{
      {"axi_iic", {"scl_i", "sda_i"}},
      {"axi_quad_spi", {"io0_i", "io1_i", "sck_i", "ss_i", "spisel"}},
      {"axi_uartlite", {"rx"}},
      {"xadc_wiz", xadc_inputs()}};
  return find(table, ip);
}

bool may_drive_board_input(const std::string& ip, const std::string& driver,
                           const std::string& pin) {
  const IpRule* rule = rule_for(driver);
  if (!rule) return false;
  const bool is_constant = rule->ip == "xlconstant" || rule->ip == "ilconstant";
  const bool is_serial_line = ip == "axi_uartlite" && rule->ip == "axi_uartlite" && pin == "tx";
  return is_constant || is_serial_line;
}

bool lacks_output(const IpRule& rule, const std::string& pin) {
  if (rule.kind == Kind::left_out) return true;
  const Names& names = find(outputs_without_model(), rule.ip);
  return std::find(names.begin(), names.end(), pin) != names.end();
}

bool idles_high(const std::string& pin) {
  return pin.size() > 2 && pin.compare(pin.size() - 2, 2, "_n") == 0;
}

}  // namespace platform::block_design
