// Transactions of AXI4: exact times, pairing, and each rule with a trace that breaks it.
#include <boost/test/unit_test.hpp>

#include "clocked_bus.h"

using namespace platform::trace;

namespace {

const std::string signals =
    "aresetn 1, m_axi_awvalid 1, m_axi_awready 1, m_axi_awid 1, m_axi_awaddr 32, m_axi_awlen 8, "
    "m_axi_awsize 3, m_axi_awburst 2, m_axi_awcache 4, m_axi_wvalid 1, m_axi_wready 1, "
    "m_axi_wdata 32, m_axi_wstrb 4, m_axi_wlast 1, m_axi_bvalid 1, m_axi_bready 1, m_axi_bid 1, "
    "m_axi_bresp 2, m_axi_arvalid 1, m_axi_arready 1, m_axi_arid 1, m_axi_araddr 32, "
    "m_axi_arlen 8, m_axi_arsize 3, m_axi_arburst 2, m_axi_arlock 1, m_axi_rvalid 1, "
    "m_axi_rready 1, m_axi_rid 1, m_axi_rdata 32, m_axi_rresp 2, m_axi_rlast 1";

/// A write of two beats to 0x100 and a read of two beats from 0x200, both with waits.
ClockedBus::Script good() {
  ClockedBus::Script script;
  const auto set = [&](unsigned clock, const std::string& name, const std::string& digits) {
    script[{clock, "m_axi_" + name}] = digits;
  };
  script[{2, "aresetn"}] = "1";
  set(4, "awvalid", "1"), set(4, "awaddr", "100000000"), set(4, "awlen", "1");
  set(4, "awsize", "10"), set(4, "awburst", "1"), set(5, "awready", "1");
  set(6, "awvalid", "0"), set(6, "awready", "0");
  set(6, "wvalid", "1"), set(6, "wready", "1"), set(6, "wdata", "10100000");
  set(6, "wstrb", "1111"), set(7, "wdata", "10100001"), set(7, "wlast", "1");
  set(8, "wvalid", "0"), set(8, "wlast", "0"), set(8, "bvalid", "1"), set(9, "bready", "1");
  set(10, "bvalid", "0"), set(10, "bready", "0");
  set(12, "arvalid", "1"), set(12, "araddr", "1000000000"), set(12, "arlen", "1");
  set(12, "arsize", "10"), set(12, "arburst", "1"), set(13, "arready", "1");
  set(14, "arvalid", "0"), set(14, "arready", "0");
  set(16, "rvalid", "1"), set(16, "rdata", "1"), set(17, "rready", "1");
  set(18, "rdata", "10"), set(18, "rlast", "1"), set(19, "rvalid", "0"), set(19, "rlast", "0");
  return script;
}

constexpr unsigned clocks = 24;

/// The rules that are broken when some values are other ones.
std::string broken_by(const ClockedBus::Script& other, const TransactionsOptions& options = {}) {
  ClockedBus::Script script = good();
  for (const auto& [key, digits] : other) {
    script[{key.first, key.second == "aresetn" ? key.second : "m_axi_" + key.second}] = digits;
  }
  return transactions_of(ClockedBus(signals, script, clocks), options).rules();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(axi_transactions)

BOOST_AUTO_TEST_CASE(a_write_and_a_read_at_their_edges) {
  TransactionsOptions options;
  options.decode.data_beats = 4;
  const auto found = transactions_of(ClockedBus(signals, good(), clocks), options);
  BOOST_TEST(found.interfaces() == "top.m_axi:axi4 ");
  BOOST_TEST(found.survey.interfaces[0].clock_text == "top.clk");
  BOOST_TEST(found.rules() == "");
  BOOST_TEST(found.end.hang == "");
  BOOST_TEST_REQUIRE(found.all.size() == 2u);
  const Transaction &write = found.all[0], &read = found.all[1];
  BOOST_TEST(brief(write) == "write 0x100 45-95 OKAY");
  BOOST_TEST(*write.accepted_ps == 55'000u);
  BOOST_TEST(*write.first_data_ps == 65'000u);
  BOOST_TEST(*write.last_data_ps == 75'000u);
  BOOST_TEST(write.begin_cycle == 4u);
  BOOST_TEST(write.end_cycle == 9u);
  BOOST_TEST(write.request_wait == 1u);
  BOOST_TEST(write.response_wait == 1u);
  BOOST_TEST(write.bytes == 8u);
  BOOST_TEST(write.strobe == "0xf");
  BOOST_TEST(write.data == (std::vector<std::string>{"0xa0", "0xa1"}));
  BOOST_TEST(brief(read) == "read 0x200 125-185 OKAY");
  BOOST_TEST(*read.first_data_ps == 175'000u);
  BOOST_TEST(read.data_wait == 1u);
  BOOST_TEST(read.beats_done == 2u);
  BOOST_TEST(read.burst == "INCR");
}

BOOST_AUTO_TEST_CASE(each_rule_has_a_trace_that_breaks_it) {
  const auto contains = [](const std::string& all, const std::string& rule) {
    return all.find("AXI4_" + rule + " ") != std::string::npos;
  };
  const std::vector<std::pair<std::string, ClockedBus::Script>> faults = {
      {"ERRM_AWVALID_STABLE", {{{5, "awvalid"}, "0"}, {{5, "awready"}, "0"}}},
      {"ERRM_AWADDR_STABLE", {{{5, "awaddr"}, "100001000"}}},
      {"ERRM_AWLEN_STABLE", {{{5, "awlen"}, "11"}}},
      {"ERRM_AWVALID_RESET", {{{1, "awvalid"}, "1"}}},
      {"ERRM_AWADDR_BOUNDARY", {{{4, "awaddr"}, "111111111100"}}},
      {"ERRM_AWADDR_WRAP_ALIGN", {{{4, "awaddr"}, "100000010"}, {{4, "awburst"}, "10"}}},
      {"ERRM_ARLEN_WRAP", {{{12, "arlen"}, "10"}, {{12, "arburst"}, "10"}}},
      {"ERRM_ARLEN_FIXED", {{{12, "arlen"}, "10000"}, {{12, "arburst"}, "0"}}},
      {"ERRM_AWBURST", {{{4, "awburst"}, "11"}}},
      {"ERRM_ARSIZE", {{{12, "arsize"}, "11"}}},
      {"ERRM_AWCACHE", {{{4, "awcache"}, "1000"}}},
      {"ERRM_ARLEN_LOCK", {{{12, "arlock"}, "1"}, {{12, "araddr"}, "1000000100"}}},
      {"ERRM_WVALID_STABLE", {{{6, "wready"}, "0"}, {{7, "wvalid"}, "0"}}},
      {"ERRM_WDATA_STABLE", {{{6, "wready"}, "0"}, {{8, "wready"}, "1"}}},
      {"ERRM_WLAST_STABLE", {{{6, "wready"}, "0"}, {{8, "wready"}, "1"}}},
      {"ERRM_WDATA_NUM", {{{6, "wlast"}, "1"}}},
      {"ERRM_WDATA_NUM", {{{7, "wlast"}, "0"}}},
      {"ERRM_WSTRB", {{{4, "awsize"}, "0"}}},
      {"ERRS_BVALID_STABLE", {{{9, "bvalid"}, "0"}}},
      {"ERRS_BRESP_STABLE", {{{9, "bresp"}, "10"}}},
      {"ERRS_BRESP_AW", {{{5, "bvalid"}, "1"}}},
      {"ERRS_BID", {{{8, "bid"}, "1"}}},
      {"ERRS_BRESP_AW", {{{2, "bvalid"}, "1"}, {{2, "bready"}, "1"}, {{3, "bvalid"}, "0"}}},
      {"ERRS_BRESP_WLAST", {{{7, "bvalid"}, "1"}}},
      {"ERRS_BRESP_EXOKAY", {{{8, "bresp"}, "1"}}},
      {"ERRS_RVALID_STABLE", {{{17, "rvalid"}, "0"}, {{17, "rready"}, "0"}}},
      {"ERRS_RDATA_STABLE", {{{17, "rdata"}, "11"}}},
      {"ERRS_RID", {{{16, "rid"}, "1"}}},
      {"ERRS_RID", {{{13, "rvalid"}, "1"}, {{13, "rready"}, "1"}}},
      {"ERRS_RDATA_NUM", {{{16, "rlast"}, "1"}}},
      {"ERRS_RDATA_NUM", {{{18, "rlast"}, "0"}}},
      {"ERRS_RRESP_EXOKAY", {{{16, "rresp"}, "1"}}},
      {"ERRM_ARVALID_X", {{{10, "arvalid"}, "x"}}},
      {"ERRS_AWREADY_X", {{{10, "awready"}, "x"}}}};
  for (const auto& [rule, script] : faults) {
    const std::string broken = broken_by(script);
    BOOST_TEST(contains(broken, rule), rule << " is not among " << broken);
  }
  // Faults of one value break one rule.
  BOOST_TEST(broken_by({{{5, "awaddr"}, "100001000"}}) == "AXI4_ERRM_AWADDR_STABLE ");
  BOOST_TEST(broken_by({{{4, "awcache"}, "1000"}}) == "AXI4_ERRM_AWCACHE ");
  BOOST_TEST(broken_by({{{8, "bresp"}, "10"}}) == "");
  TransactionsOptions options;
  options.decode.max_wait = 1;
  BOOST_TEST(broken_by({{{17, "rready"}, "0"}, {{19, "rvalid"}, "1"}}, options) ==
             "AXI4_ERRS_RDATA_STABLE AXI4_ERRS_RLAST_STABLE AXI4_RECM_RREADY_MAX_WAIT ");
}

BOOST_AUTO_TEST_CASE(data_before_the_address_and_reads_that_overtake) {
  ClockedBus::Script script = good();
  const auto set = [&](unsigned clock, const std::string& name, const std::string& digits) {
    script[{clock, "m_axi_" + name}] = digits;
  };
  // The data of the write come three clocks before its address.
  for (const char* name : {"wvalid", "wready", "wdata", "wstrb"})
    script.erase({6, std::string("m_axi_") + name});
  script.erase({7, "m_axi_wdata"}), script.erase({7, "m_axi_wlast"});
  script.erase({8, "m_axi_wvalid"}), script.erase({8, "m_axi_wlast"});
  set(3, "wvalid", "1"), set(3, "wready", "1"), set(3, "wstrb", "11"), set(4, "wlast", "1");
  set(5, "wvalid", "0"), set(5, "wlast", "0");
  // A read of id 1 is answered before the one of id 0.
  set(14, "arvalid", "1"), set(14, "arready", "1"), set(14, "arid", "1"), set(14, "arlen", "0");
  set(14, "araddr", "1100000000"), set(15, "arvalid", "0"), set(15, "arready", "0");
  set(15, "rvalid", "1"), set(15, "rready", "1"), set(15, "rid", "1"), set(15, "rlast", "1");
  set(16, "rid", "0"), set(16, "rlast", "0"), set(16, "rready", "0");
  const auto found = transactions_of(ClockedBus(signals, script, clocks));
  BOOST_TEST(found.rules() == "");
  BOOST_TEST_REQUIRE(found.all.size() == 3u);
  BOOST_TEST(brief(found.all[0]) == "write 0x100 45-95 OKAY");
  BOOST_TEST(*found.all[0].first_data_ps == 35'000u);
  BOOST_TEST(found.all[0].bytes == 4u);
  BOOST_TEST(found.all[0].note == "data before address");
  BOOST_TEST(brief(found.all[1]) == "read 0x200 125-185 OKAY");
  BOOST_TEST(brief(found.all[2]) == "read 0x300 145-155 OKAY");
  BOOST_TEST(found.all[2].outstanding == 1u);
  BOOST_TEST(found.all[2].note == "overtakes the read of 0x200");
}

BOOST_AUTO_TEST_CASE(what_hangs_is_said_in_a_sentence) {
  ClockedBus::Script script = good();
  script[{13, "m_axi_arready"}] = "0";
  script.erase({14, "m_axi_arvalid"});
  const auto never = transactions_of(ClockedBus(signals, script, clocks));
  BOOST_TEST(
      never.end.hang.find("top waits for the subordinate of top.m_axi since 125 ns "
                          "(ARREADY for the read of 0x200, 12 clocks, low since cycle 2)") == 0u,
      never.end.hang);
  // A subordinate that waits for WVALID, and a manager that gives it behind AWREADY only.
  script = good();
  for (auto step = script.begin(); step != script.end();)
    step = step->first.first > 4 ? script.erase(step) : std::next(step);
  script[{4, "m_axi_wready"}] = "1";
  const auto both = transactions_of(ClockedBus(signals, script, clocks));
  BOOST_TEST(both.end.hang.find("AWREADY for the write of 0x100, 20 clocks") != std::string::npos);
  BOOST_TEST(both.end.hang.find("WVALID for the write of 0x100, 19 clocks): a deadlock") !=
                 std::string::npos,
             both.end.hang);
  // A short wait is no hang.
  BOOST_TEST(transactions_of(ClockedBus(signals, script, 10)).end.hang == "");
}

BOOST_AUTO_TEST_CASE(a_reset_ends_what_is_open) {
  ClockedBus::Script script = good();
  script[{15, "aresetn"}] = "0";
  const auto found = transactions_of(ClockedBus(signals, script, clocks));
  BOOST_TEST_REQUIRE(found.all.size() == 2u);
  BOOST_TEST(brief(found.all[1]) == "read 0x200 125-");
  BOOST_TEST(found.all[1].note == "reset at cycle 15");
}

BOOST_AUTO_TEST_CASE(lite_has_no_bursts_and_no_exclusive_answers) {
  const std::string lite =
      "s_awvalid 1, s_awready 1, s_awaddr 8, s_wvalid 1, s_wready 1, s_wdata 32, s_wstrb 4, "
      "s_bvalid 1, s_bready 1, s_bresp 2";
  ClockedBus::Script script = {
      {{1, "s_awvalid"}, "1"}, {{1, "s_awready"}, "1"}, {{1, "s_awaddr"}, "100"},
      {{1, "s_wvalid"}, "1"},  {{1, "s_wready"}, "1"},  {{1, "s_wstrb"}, "1111"},
      {{2, "s_awvalid"}, "0"}, {{2, "s_wvalid"}, "0"},  {{2, "s_bvalid"}, "1"},
      {{2, "s_bready"}, "1"},  {{3, "s_bvalid"}, "0"}};
  const auto found = transactions_of(ClockedBus(lite, script, 6));
  BOOST_TEST(found.interfaces() == "top.s:axi4-lite ");
  BOOST_TEST(found.rules() == "");
  BOOST_TEST_REQUIRE(found.all.size() == 1u);
  BOOST_TEST(brief(found.all[0]) == "write 0x4 15-25 OKAY");
  BOOST_TEST(found.all[0].burst == "");
  script[{2, "s_bresp"}] = "1";
  BOOST_TEST(transactions_of(ClockedBus(lite, script, 6)).rules() == "AXI4LITE_ERRS_BRESP_EXOKAY ");
}

BOOST_AUTO_TEST_SUITE_END()
