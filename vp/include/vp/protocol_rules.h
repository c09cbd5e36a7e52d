#pragma once

#include <cstddef>

/// The rules of the links that checkers watch, once for models and documentation (docs/rules.md).
/// Names are those of the field: Arm's, as AMD's and Intel's public guides print them (PG101,
/// PG145, PG293). What has no name there has one of ours: TLM2_, BRAM_, RESET_, CLOCK_, INTERRUPT_.
namespace vp {

enum class Rule : unsigned {
  aw_addr_boundary,
  aw_addr_wrap_align,
  aw_len_wrap,
  aw_len_fixed,
  aw_burst,
  aw_size,
  aw_cache,
  aw_len_lock,
  aw_valid_reset,
  aw_valid_stable,
  aw_addr_stable,
  aw_id_stable,
  aw_len_stable,
  aw_size_stable,
  aw_burst_stable,
  aw_lock_stable,
  aw_cache_stable,
  aw_prot_stable,
  aw_qos_stable,
  aw_region_stable,
  ar_addr_boundary,
  ar_addr_wrap_align,
  ar_len_wrap,
  ar_len_fixed,
  ar_burst,
  ar_size,
  ar_cache,
  ar_len_lock,
  ar_valid_reset,
  ar_valid_stable,
  ar_addr_stable,
  ar_id_stable,
  ar_len_stable,
  ar_size_stable,
  ar_burst_stable,
  ar_lock_stable,
  ar_cache_stable,
  ar_prot_stable,
  ar_qos_stable,
  ar_region_stable,
  w_valid_reset,
  w_valid_stable,
  w_data_stable,
  w_strb_stable,
  w_last_stable,
  w_data_num,
  w_strb,
  b_valid_reset,
  b_valid_stable,
  b_id_stable,
  b_resp_stable,
  b_resp_aw,
  b_resp_wlast,
  b_id,
  b_resp_exokay,
  r_valid_reset,
  r_valid_stable,
  r_data_stable,
  r_id_stable,
  r_resp_stable,
  r_last_stable,
  r_id,
  r_data_num,
  r_resp_exokay,
  axi_all_done_eos,
  stream_valid_stable,
  stream_data_stable,
  stream_last_stable,
  stream_keep_stable,
  stream_strb_stable,
  stream_user_stable,
  stream_id_stable,
  stream_dest_stable,
  stream_valid_reset,
  stream_keep_strb,
  stream_id_dest_width,
  stream_keep_gap,
  tlm_response,
  tlm_data,
  tlm_streaming_width,
  tlm_byte_enables,
  tlm_kept,
  tlm_dmi_hint,
  tlm_dmi_range,
  bram_address,
  bram_collision,
  reset_width,
  reset_domain,
  clock_crossing,
  interrupt_pulse,
  count
};

constexpr std::size_t rule_count = static_cast<std::size_t>(Rule::count);

/// The rule of AR that is the one of AW.
constexpr Rule on_ar(Rule of_aw) {
  return static_cast<Rule>(static_cast<unsigned>(of_aw) -
                           static_cast<unsigned>(Rule::aw_addr_boundary) +
                           static_cast<unsigned>(Rule::ar_addr_boundary));
}

/// What a rule is called, and says.
struct RuleInfo {
  const char* name;
  const char* statement;
};

const RuleInfo& info_of(Rule rule);

}  // namespace vp
