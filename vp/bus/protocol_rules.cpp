#include <vp/protocol_rules.h>

namespace vp {

namespace {

constexpr RuleInfo rules[] = {
    {"AXI4_ERRM_AWADDR_BOUNDARY", "an INCR burst stays within 4 KiB"},
    {"AXI4_ERRM_AWADDR_WRAP_ALIGN", "a WRAP burst begins at a multiple of its size"},
    {"AXI4_ERRM_AWLEN_WRAP", "a WRAP burst has 2, 4, 8 or 16 beats"},
    {"AXI4_ERRM_AWLEN_FIXED", "a FIXED burst has 16 beats at most"},
    {"AXI4_ERRM_AWBURST", "burst type 3 is reserved"},
    {"AXI4_ERRM_AWSIZE", "a beat is no wider than the data"},
    {"AXI4_ERRM_AWCACHE", "what is not modifiable has no allocate bits"},
    {"AXI4_ERRM_AWLEN_LOCK",
     "an exclusive access has 16 beats and 128 bytes at most, a power of two, and is aligned"},
    {"AXI4_ERRM_AWVALID_RESET", "AWVALID is low during reset and on the first edge behind it"},
    {"AXI4_ERRM_AWVALID_STABLE", "AWVALID stays until AWREADY"},
    {"AXI4_ERRM_AWADDR_STABLE", "AWADDR stays while AWVALID waits for AWREADY"},
    {"AXI4_ERRM_AWID_STABLE", "AWID stays while AWVALID waits for AWREADY"},
    {"AXI4_ERRM_AWLEN_STABLE", "AWLEN stays while AWVALID waits for AWREADY"},
    {"AXI4_ERRM_AWSIZE_STABLE", "AWSIZE stays while AWVALID waits for AWREADY"},
    {"AXI4_ERRM_AWBURST_STABLE", "AWBURST stays while AWVALID waits for AWREADY"},
    {"AXI4_ERRM_AWLOCK_STABLE", "AWLOCK stays while AWVALID waits for AWREADY"},
    {"AXI4_ERRM_AWCACHE_STABLE", "AWCACHE stays while AWVALID waits for AWREADY"},
    {"AXI4_ERRM_AWPROT_STABLE", "AWPROT stays while AWVALID waits for AWREADY"},
    {"AXI4_ERRM_AWQOS_STABLE", "AWQOS stays while AWVALID waits for AWREADY"},
    {"AXI4_ERRM_AWREGION_STABLE", "AWREGION stays while AWVALID waits for AWREADY"},
    {"AXI4_ERRM_ARADDR_BOUNDARY", "an INCR burst stays within 4 KiB"},
    {"AXI4_ERRM_ARADDR_WRAP_ALIGN", "a WRAP burst begins at a multiple of its size"},
    {"AXI4_ERRM_ARLEN_WRAP", "a WRAP burst has 2, 4, 8 or 16 beats"},
    {"AXI4_ERRM_ARLEN_FIXED", "a FIXED burst has 16 beats at most"},
    {"AXI4_ERRM_ARBURST", "burst type 3 is reserved"},
    {"AXI4_ERRM_ARSIZE", "a beat is no wider than the data"},
    {"AXI4_ERRM_ARCACHE", "what is not modifiable has no allocate bits"},
    {"AXI4_ERRM_ARLEN_LOCK",
     "an exclusive access has 16 beats and 128 bytes at most, a power of two, and is aligned"},
    {"AXI4_ERRM_ARVALID_RESET", "ARVALID is low during reset and on the first edge behind it"},
    {"AXI4_ERRM_ARVALID_STABLE", "ARVALID stays until ARREADY"},
    {"AXI4_ERRM_ARADDR_STABLE", "ARADDR stays while ARVALID waits for ARREADY"},
    {"AXI4_ERRM_ARID_STABLE", "ARID stays while ARVALID waits for ARREADY"},
    {"AXI4_ERRM_ARLEN_STABLE", "ARLEN stays while ARVALID waits for ARREADY"},
    {"AXI4_ERRM_ARSIZE_STABLE", "ARSIZE stays while ARVALID waits for ARREADY"},
    {"AXI4_ERRM_ARBURST_STABLE", "ARBURST stays while ARVALID waits for ARREADY"},
    {"AXI4_ERRM_ARLOCK_STABLE", "ARLOCK stays while ARVALID waits for ARREADY"},
    {"AXI4_ERRM_ARCACHE_STABLE", "ARCACHE stays while ARVALID waits for ARREADY"},
    {"AXI4_ERRM_ARPROT_STABLE", "ARPROT stays while ARVALID waits for ARREADY"},
    {"AXI4_ERRM_ARQOS_STABLE", "ARQOS stays while ARVALID waits for ARREADY"},
    {"AXI4_ERRM_ARREGION_STABLE", "ARREGION stays while ARVALID waits for ARREADY"},
    {"AXI4_ERRM_WVALID_RESET", "WVALID is low during reset and on the first edge behind it"},
    {"AXI4_ERRM_WVALID_STABLE", "WVALID stays until WREADY"},
    {"AXI4_ERRM_WDATA_STABLE", "data of set strobes stay while WVALID waits for WREADY"},
    {"AXI4_ERRM_WSTRB_STABLE", "WSTRB stays while WVALID waits for WREADY"},
    {"AXI4_ERRM_WLAST_STABLE", "WLAST stays while WVALID waits for WREADY"},
    {"AXI4_ERRM_WDATA_NUM", "a write has AWLEN + 1 beats, WLAST with the last and only there"},
    {"AXI4_ERRM_WSTRB", "strobes are set only on lanes that address and size select"},
    {"AXI4_ERRS_BVALID_RESET", "BVALID is low during reset and on the first edge behind it"},
    {"AXI4_ERRS_BVALID_STABLE", "BVALID stays until BREADY"},
    {"AXI4_ERRS_BID_STABLE", "BID stays while BVALID waits for BREADY"},
    {"AXI4_ERRS_BRESP_STABLE", "BRESP stays while BVALID waits for BREADY"},
    {"AXI4_ERRS_BRESP_AW", "no response before the address has passed"},
    {"AXI4_ERRS_BRESP_WLAST", "no response before the last data have passed"},
    {"AXI4_ERRS_BID", "a response has the ID of a write that waits for it"},
    {"AXI4_ERRS_BRESP_EXOKAY", "EXOKAY answers exclusive accesses only, and none of AXI4-Lite"},
    {"AXI4_ERRS_RVALID_RESET", "RVALID is low during reset and on the first edge behind it"},
    {"AXI4_ERRS_RVALID_STABLE", "RVALID stays until RREADY"},
    {"AXI4_ERRS_RDATA_STABLE", "RDATA stay while RVALID waits for RREADY"},
    {"AXI4_ERRS_RID_STABLE", "RID stays while RVALID waits for RREADY"},
    {"AXI4_ERRS_RRESP_STABLE", "RRESP stays while RVALID waits for RREADY"},
    {"AXI4_ERRS_RLAST_STABLE", "RLAST stays while RVALID waits for RREADY"},
    {"AXI4_ERRS_RID", "data have the ID of a read that waits for them"},
    {"AXI4_ERRS_RDATA_NUM", "a read has ARLEN + 1 beats, RLAST with the last and only there"},
    {"AXI4_ERRS_RRESP_EXOKAY", "EXOKAY answers exclusive accesses only, and none of AXI4-Lite"},
    {"AXI4_ERR_ALL_DONE_EOS", "nothing is outstanding at the end"},
    {"AXI4STREAM_ERRM_TVALID_STABLE", "TVALID stays until TREADY"},
    {"AXI4STREAM_ERRM_TDATA_STABLE", "data of kept bytes stay while TVALID waits for TREADY"},
    {"AXI4STREAM_ERRM_TLAST_STABLE", "TLAST stays while TVALID waits for TREADY"},
    {"AXI4STREAM_ERRM_TKEEP_STABLE", "TKEEP stays while TVALID waits for TREADY"},
    {"AXI4STREAM_ERRM_TKEEP_GAP",
     "words are whole but for the last of a packet: receivers do not realign (a rule of the "
     "platform)"},
};
static_assert(sizeof rules / sizeof *rules == rule_count);

}  // namespace

const RuleInfo& info_of(Rule rule) {
  return rules[static_cast<std::size_t>(rule)];
}

std::optional<Rule> find_rule(const std::string& name) {
  for (std::size_t i = 0; i < rule_count; ++i) {
    if (name == rules[i].name) return static_cast<Rule>(i);
  }
  return {};
}

}  // namespace vp
