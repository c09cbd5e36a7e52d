// Transactions: streams, APB, Wishbone, names of buses, copies, conditions, lanes.
#include <boost/test/unit_test.hpp>

#include <trace/transactions/lanes.h>
#include <trace/transactions/record_fields.h>

#include <random>

#include "clocked_bus.h"

using namespace platform::trace;

namespace {

/// A packet of three beats, of which the second waits a clock, and one of one beat.
const std::string stream =
    "m_axis_tvalid 1, m_axis_tready 1, m_axis_tdata 16, m_axis_tkeep 2, m_axis_tstrb 2, "
    "m_axis_tlast 1, m_axis_tdest 2";

ClockedBus::Script packets() {
  ClockedBus::Script script;
  const auto set = [&](unsigned clock, const std::string& name, const std::string& digits) {
    script[{clock, "m_axis_" + name}] = digits;
  };
  set(2, "tvalid", "1"), set(2, "tready", "1"), set(2, "tdata", "1"), set(2, "tkeep", "11");
  set(2, "tdest", "10"), set(3, "tdata", "10"), set(3, "tready", "0"), set(4, "tready", "1");
  set(5, "tdata", "11"), set(5, "tlast", "1"), set(5, "tkeep", "1"), set(6, "tvalid", "0");
  set(8, "tvalid", "1"), set(9, "tvalid", "0");
  return script;
}

std::string all_brief(const FoundTransactions& found) {
  std::string text;
  for (const Transaction& one : found.all) text += brief(one) + " ";
  return text;
}

std::string stream_rules(const ClockedBus::Script& other) {
  ClockedBus::Script script = packets();
  for (const auto& [key, digits] : other) script[{key.first, "m_axis_" + key.second}] = digits;
  return transactions_of(ClockedBus(stream, script, 12)).rules();
}

/// Interfaces among signals of one bit that never change, and why others are left out.
std::string found_among(const std::string& signals) {
  const Waves waves(signals, "#0\n");
  const TraceFile file(waves.file);
  const FoundInterfaces found = find_interfaces(file);
  std::string text;
  for (const BusInterface& one : found.interfaces)
    text += one.name + ":" + bus_kind_name(one.kind) + " ";
  for (const LeftOut& one : found.left_out) text += "(" + one.name + " " + one.reason + ") ";
  return text;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(transactions)

BOOST_AUTO_TEST_CASE(streams_have_packets) {
  const auto found = transactions_of(ClockedBus(stream, packets(), 12));
  BOOST_TEST(found.rules() == "");
  BOOST_TEST(all_brief(found) == "packet 0x2 25-55 packet 0x2 85-85 ");
  BOOST_TEST(found.all[0].beats == 3u);
  BOOST_TEST(found.all[0].bytes == 5u);
  BOOST_TEST(found.all[0].data_wait == 1u);
  BOOST_TEST(found.all[0].strobe == "mixed");
  BOOST_TEST(stream_rules({{{4, "tdata"}, "111"}}) == "AXI4STREAM_ERRM_TDATA_STABLE ");
  BOOST_TEST(stream_rules({{{4, "tlast"}, "1"}, {{5, "tlast"}, "1"}}) ==
             "AXI4STREAM_ERRM_TLAST_STABLE ");
  BOOST_TEST(stream_rules({{{4, "tvalid"}, "0"}, {{5, "tvalid"}, "1"}}) ==
             "AXI4STREAM_ERRM_TVALID_STABLE ");
  BOOST_TEST(stream_rules({{{5, "tstrb"}, "10"}}) == "AXI4STREAM_ERRM_TKEEP_TSTRB ");
}

BOOST_AUTO_TEST_CASE(an_open_packet_and_who_stops_it) {
  ClockedBus::Script script = packets();
  script.erase({5, "m_axis_tlast"}), script[{8, "m_axis_tready"}] = "0";
  script.erase({9, "m_axis_tvalid"});
  const auto found = transactions_of(ClockedBus(stream, script, 24));
  BOOST_TEST(all_brief(found) == "packet 0x2 25- ");
  BOOST_TEST(found.end.hang ==
             "top waits for the receiver of top.m_axis since 85 ns (TREADY, 16 clocks, low since "
             "cycle 8): the receiver of top.m_axis is the root; the last thing that moved was a "
             "beat on top.m_axis at 55 ns.");
}

BOOST_AUTO_TEST_CASE(a_chain_of_waits_ends_at_its_root) {
  const std::string two = "s_axis_tvalid 1, s_axis_tready 1, m_axis_tvalid 1, m_axis_tready 1";
  const auto found = transactions_of(
      ClockedBus(two, {{{2, "s_axis_tvalid"}, "1"}, {{3, "m_axis_tvalid"}, "1"}}, 20, "tb.dut."));
  BOOST_TEST(found.end.hang.find("the sender of tb.dut.s_axis waits for tb.dut since 25 ns") == 0u);
  BOOST_TEST(
      found.end.hang.find(", tb.dut waits for the receiver of tb.dut.m_axis since 35 ns "
                          "(TREADY, 17 clocks, low since cycle 0): the receiver of "
                          "tb.dut.m_axis is the root; nothing ever moved.") != std::string::npos,
      found.end.hang);
}

BOOST_AUTO_TEST_CASE(accesses_of_apb) {
  const std::string apb =
      "psel 1, penable 1, pready 1, pwrite 1, paddr 12, pwdata 32, prdata 32, pslverr 1";
  ClockedBus::Script script = {
      {{2, "psel"}, "1"},     {{2, "pwrite"}, "1"},    {{2, "paddr"}, "100"},
      {{2, "pwdata"}, "111"}, {{3, "penable"}, "1"},   {{4, "pready"}, "1"},
      {{5, "penable"}, "0"},  {{5, "pwrite"}, "0"},    {{5, "paddr"}, "1000"},
      {{6, "penable"}, "1"},  {{6, "prdata"}, "1001"}, {{6, "pslverr"}, "1"},
      {{7, "psel"}, "0"},     {{7, "penable"}, "0"}};
  const auto found = transactions_of(ClockedBus(apb, script, 10));
  BOOST_TEST(found.interfaces() == "top:apb ");
  BOOST_TEST(all_brief(found) == "write 0x4 25-45 OKAY read 0x8 55-65 SLVERR ");
  BOOST_TEST(found.all[0].response_wait == 1u);
  BOOST_TEST(found.all[0].data.front() == "0x7");
  BOOST_TEST(found.all[1].data.front() == "0x9");
  BOOST_TEST(found.rules() == "");
  const auto rules = [&](const ClockedBus::Script& other) {
    ClockedBus::Script all = script;
    for (const auto& [key, digits] : other) all[key] = digits;
    return transactions_of(ClockedBus(apb, all, 10)).rules();
  };
  BOOST_TEST(rules({{{2, "penable"}, "1"}}) == "APB_SETUP ");
  BOOST_TEST(rules({{{4, "paddr"}, "101"}}) == "APB_PADDR_STABLE ");
  BOOST_TEST(rules({{{4, "pwdata"}, "101"}}) == "APB_PWDATA_STABLE ");
  BOOST_TEST(rules({{{4, "psel"}, "0"}, {{5, "psel"}, "1"}}) == "APB_PSEL_STABLE ");
  BOOST_TEST(rules({{{4, "penable"}, "0"}}).find("APB_PENABLE_STABLE ") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(wishbone_classic_and_pipelined) {
  const std::string classic =
      "wb_cyc_i 1, wb_stb_i 1, wb_we_i 1, wb_ack_o 1, wb_adr_i 8, wb_dat_i 32, wb_dat_o 32, "
      "wb_sel_i 4";
  ClockedBus::Script script = {
      {{2, "wb_cyc_i"}, "1"},   {{2, "wb_stb_i"}, "1"},   {{2, "wb_we_i"}, "1"},
      {{2, "wb_adr_i"}, "100"}, {{2, "wb_dat_i"}, "101"}, {{2, "wb_sel_i"}, "1111"},
      {{4, "wb_ack_o"}, "1"},   {{5, "wb_we_i"}, "0"},    {{5, "wb_adr_i"}, "1000"},
      {{5, "wb_dat_o"}, "110"}, {{6, "wb_cyc_i"}, "0"},   {{6, "wb_stb_i"}, "0"},
      {{6, "wb_ack_o"}, "0"}};
  const auto one = transactions_of(ClockedBus(classic, script, 10));
  BOOST_TEST(one.interfaces() == "top.wb:wishbone ");
  BOOST_TEST(all_brief(one) == "write 0x4 25-45 ACK read 0x8 55-55 ACK ");
  BOOST_TEST(one.all[0].data.front() == "0x5");
  BOOST_TEST(one.all[1].data.front() == "0x6");
  script[{8, "wb_cyc_i"}] = "1", script[{8, "wb_ack_o"}] = "1";
  BOOST_TEST(transactions_of(ClockedBus(classic, script, 10)).rules() == "WISHBONE_ACK ");
  const std::string pipelined = "o_wb_cyc 1, o_wb_stb 1, i_wb_stall 1, i_wb_ack 1, o_wb_addr 8";
  const auto two = transactions_of(ClockedBus(pipelined,
                                              {{{2, "o_wb_cyc"}, "1"},
                                               {{2, "o_wb_stb"}, "1"},
                                               {{2, "i_wb_stall"}, "1"},
                                               {{3, "i_wb_stall"}, "0"},
                                               {{4, "o_wb_addr"}, "100"},
                                               {{5, "o_wb_stb"}, "0"},
                                               {{6, "i_wb_ack"}, "1"},
                                               {{8, "i_wb_ack"}, "0"}},
                                              10));
  BOOST_TEST(all_brief(two) == "read 0x0 25-65 ACK read 0x4 45-75 ACK ");
  BOOST_TEST(two.all[0].request_wait == 1u);
  BOOST_TEST(two.all[1].outstanding == 1u);
  BOOST_TEST(two.rules() == "");
}

BOOST_AUTO_TEST_CASE(buses_are_found_by_their_names) {
  const std::string read = "arvalid 1, ~arready 1, ~araddr 32, ~rvalid 1, ~rready 1, ~rdata 32";
  const auto with = [](std::string text, const std::string& prefix) {
    for (auto at = text.find('~'); at != std::string::npos; at = text.find('~'))
      text.replace(at, 1, prefix);
    return prefix + text;
  };
  BOOST_TEST(found_among(with(read, "S00_AXI_")) == "S00_AXI:axi4-lite ");
  BOOST_TEST(found_among("t.m_axi_gmem_ARVALID 1, t.m_axi_gmem_ARREADY 1, t.m_axi_gmem_ARLEN 8, "
                         "t.m_axi_gmem_RVALID 1, t.m_axi_gmem_RREADY 1") == "t.m_axi_gmem:axi4 ");
  BOOST_TEST(found_among("t.slv_req_i.ar_valid 1, t.slv_resp_o.ar_ready 1, t.slv_resp_o.r_valid 1, "
                         "t.slv_req_i.r_ready 1, t.slv_resp_o.r.last 1") == "t.slv:axi4 ");
  BOOST_TEST(found_among("t.req.ar.valid 1, t.rsp.ar.ready 1, t.rsp.r.valid 1, t.req.r.ready 1") ==
             "t:axi4-lite ");
  BOOST_TEST(found_among("t.io_mem_ar_valid 1, t.io_mem_ar_ready 1, t.io_mem_ar_bits_len 8, "
                         "t.io_mem_r_valid 1, t.io_mem_r_ready 1") == "t.io_mem:axi4 ");
  BOOST_TEST(found_among("t.in_r_TVALID 1, t.in_r_TREADY 1, t.in_r_TDATA 8") ==
             "t.in_r:axi-stream ");
  BOOST_TEST(found_among("t.link.tvalid 1, t.link.tready 1") == "t.link:axi-stream ");
  BOOST_TEST(found_among("t.startvalid 1, t.startready 1, t.error_valid 1, t.error_ready 1") == "");
  BOOST_TEST(found_among("t.s_axi_arvalid 2, t.s_axi_arready 2, t.s_axi_rvalid 2, "
                         "t.s_axi_rready 2") ==
             "(t.s_axi arvalid has 2 bits: several buses in one vector are not taken apart) ");
  BOOST_TEST(found_among("t.s_axi_awvalid 1, t.s_axi_awready 1") == "(t.s_axi has no wvalid) ");
  BOOST_TEST(found_among("t.uart_tx 1, t.other_tx 1, t.irq 1, t.irq_enable 1, t.irq_f2p 16") ==
             "t.irq:irq t.irq_f2p:irq t.uart_tx:uart ");
  BOOST_TEST(found_among("t.scl_i 1, t.scl_o 1, t.sda_i 1, t.flash_mosi 1, t.flash_sck 1, "
                         "t.flash_cs_n 1") == "t:i2c t.flash:spi ");
}

BOOST_AUTO_TEST_CASE(a_bus_at_several_levels_is_one) {
  const std::string twice =
      "m_axis_tvalid 1, m_axis_tready 1, u.core.s_axis_tvalid 1, u.core.s_axis_tready 1";
  ClockedBus::Script script;
  for (const char* name : {"m_axis_t", "u.core.s_axis_t"}) {
    script[{2, std::string(name) + "valid"}] = "1";
    script[{3, std::string(name) + "ready"}] = "1";
    script[{5, std::string(name) + "valid"}] = "0";
  }
  const auto found = transactions_of(ClockedBus(twice, script, 20, "tb."));
  BOOST_TEST(found.interfaces() == "tb.m_axis:axi-stream ");
  BOOST_TEST_REQUIRE(found.survey.interfaces[0].bus.copies.size() == 1u);
  BOOST_TEST(found.survey.interfaces[0].bus.copies[0].name == "tb.u.core.s_axis");
  // One value that differs makes them two.
  script[{7, "u.core.s_axis_tvalid"}] = "1";
  BOOST_TEST(transactions_of(ClockedBus(twice, script, 20, "tb.")).interfaces() ==
             "tb.m_axis:axi-stream tb.u.core.s_axis:axi-stream ");
}

BOOST_AUTO_TEST_CASE(a_bus_that_the_user_describes) {
  TransactionsOptions options;
  options.described = {"axi-stream foreign: tvalid=n1 tready=n2 tdata=top.n3"};
  const ClockedBus bus("n1 1, n2 1, n3 8", {{{2, "n1"}, "1"}, {{3, "n2"}, "1"}, {{4, "n1"}, "0"}},
                       8);
  const auto found = transactions_of(bus, options);
  BOOST_TEST(found.interfaces() == "foreign:axi-stream ");
  BOOST_TEST(all_brief(found) == "packet 25-35 ");
  const auto refused = [&](const std::string& text) {
    options.described = {text};
    return complaint([&] { transactions_of(bus, options); });
  };
  BOOST_TEST(refused("stream a: tvalid=n1").find("is no kind of bus") != std::string::npos);
  BOOST_TEST(refused("axi-stream a: tvalidd=n1").find("did you mean 'tvalid'?") !=
             std::string::npos);
  BOOST_TEST(refused("axi-stream a: tdata=n3").find("needs tvalid") != std::string::npos);
  BOOST_TEST(refused("axi-stream a: tvalid=n3").find("is a vector of 8 bits") != std::string::npos);
  BOOST_TEST(refused("axi-stream a: tvalid=zzz").find("zzz") != std::string::npos);
  BOOST_TEST(refused("axi4 a: arvalid=n1 arready=n2").find("needs") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_bus_that_follows_no_clock_is_left_out_unless_it_is_named) {
  std::string changes = "#0 0! 0\" 1# \n";
  for (int i = 1; i < 40; ++i) {
    changes += "#" + std::to_string(i * 50) + (i % 2 != 0 ? " 1!\n" : " 0!\n");
    changes += "#" + std::to_string(i * 50 + i) + (i % 2 != 0 ? " 1\"\n" : " 0\"\n");
  }
  const std::string signals = "top.clk 1, top.m_tvalid 1, top.m_tready 1";
  TransactionsOptions options;
  const std::string why = complaint([&] { transactions_of(signals, changes, options); });
  BOOST_TEST(why.find("top.m 3") != std::string::npos, why);
  BOOST_TEST(why.find("changes do not follow the clock top.clk") != std::string::npos, why);
  options.clocks.clock = parse_clock_edge("top.clk falling");
  const auto found = transactions_of(signals, changes, options);
  BOOST_TEST(found.survey.interfaces[0].clock_text == "top.clk falling");
  BOOST_TEST(found.all.size() == 19u);
}

BOOST_AUTO_TEST_CASE(without_a_clock_in_the_trace_one_is_assumed) {
  TransactionsOptions options;
  options.clocks.system_hz = 100'000'000;
  // From 26 to 56 ns: the edges at 30, 40 and 50 ns.
  const auto found =
      transactions_of("t.m_tvalid 1, t.m_tready 1", "#0 0! 1\"\n#26 1!\n#56 0!\n#90 0!\n", options);
  BOOST_TEST(found.survey.interfaces[0].clock_text == "100 MHz");
  BOOST_TEST(all_brief(found) == "packet 30-30 packet 40-40 packet 50-50 ");
  BOOST_TEST(found.all[0].begin_cycle == 3u);
  // A constant handshake over a long time is rather another clock than so many packets.
  const Waves waves("t.m_tvalid 1", "#0 1!\n#900000000 0!\n");
  TraceFile first(waves.file), second(waves.file);
  const Survey survey = survey_transactions(first, options);
  BOOST_TEST(complaint([&] {
               read_transactions(second, survey, options, 10, [](const Transaction&) {});
             }).find("give the right clock with --clock") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(conditions_over_fields) {
  const auto found = transactions_of(ClockedBus(stream, packets(), 12));
  const auto count = [&](const std::string& text) {
    const TransactionCondition condition(text);
    return std::count_if(found.all.begin(), found.all.end(), [&](const Transaction& one) {
      return condition.holds(one, found.survey.interfaces[one.interface]);
    });
  };
  BOOST_TEST(count("operation == 'packet'") == 2);
  BOOST_TEST(count("latency > 20 ns and beats == 3") == 1);
  BOOST_TEST(count("begin >= 80 ns or address == 0") == 1);
  BOOST_TEST(count("response == 'SLVERR'") == 0);
  BOOST_TEST(count("not (response == 'SLVERR')") == 0);
  BOOST_TEST(count("AXI4STREAM_ERRM_TDATA_STABLE == 0") == 2);
  BOOST_TEST(complaint([] {
               TransactionCondition("latencyy > 1 us");
             }).find("did you mean 'latency'?") != std::string::npos);
  BOOST_TEST(complaint([] { TransactionCondition("latency > 1 MHz"); }) != "");
  BOOST_TEST(complaint([] { TransactionCondition("latency > 100"); }) != "");
  BOOST_TEST(complaint([] { TransactionCondition("kind == 3"); }) != "");
}

BOOST_AUTO_TEST_CASE(lanes_for_what_overlaps) {
  Survey survey;
  survey.interfaces.emplace_back();
  survey.interfaces[0].bus.name = "top.m";
  survey.last_ps = 1000;
  Lanes lanes(survey);
  const auto add = [&](std::uint64_t from, std::uint64_t to) {
    Transaction one;
    one.operation = "read";
    one.begin_ps = from;
    if (to != 0) one.end_ps = to;
    return lanes.add(one).lane;
  };
  BOOST_TEST(add(0, 100) == 0u);
  BOOST_TEST(add(50, 150) == 1u);
  BOOST_TEST(add(100, 120) == 0u);
  BOOST_TEST(add(110, 0) == 2u);
  BOOST_TEST(add(120, 130) == 0u);
  BOOST_TEST(add(900, 910) == 0u);
  BOOST_TEST(lanes.counts().begin()->second == 3u);
  BOOST_TEST(lanes.name({0, "read"}, 2) == "top.m.read_3");
}

BOOST_AUTO_TEST_CASE(lanes_as_signals_and_for_perfetto) {
  const auto found = transactions_of(ClockedBus(stream, packets(), 12));
  const Waves folder("t.x 1", "#0\n");
  Lanes lanes(found.survey);
  for (const Transaction& one : found.all) lanes.add(one);
  WaveLanes signals(folder / "lanes.vcd", found.survey, lanes.counts());
  PerfettoLanes perfetto(folder / "lanes.json", found.survey);
  for (const Transaction& one : found.all) {
    signals.add(one);
    perfetto.add(one);
  }
  signals.close();
  perfetto.close();
  TraceFile file(folder / "lanes.vcd");
  Replay replay(file);
  struct Texts : Replay::Listener {
    Replay* replay = nullptr;
    std::string all;
    bool instant(std::uint64_t ps) override {
      for (const auto slot : replay->changed())
        all += std::to_string(ps / 1000) + ":" + replay->text(slot) + " ";
      return true;
    }
  } texts;
  texts.replay = &replay;
  replay.watch("top.m_axis.packet_1");
  replay.run(texts);
  BOOST_TEST(texts.all == "0: 25:0x2 3 beats 55: 85:0x2 0x3 95: ");
  const std::string json = kit::read_file(folder / "lanes.json");
  BOOST_TEST(json.find(R"("ts":0.025000,"dur":0.030000,"name":"0x2 3 beats")") !=
             std::string::npos);
  BOOST_TEST(json.find(R"("ts":0.055000,"name":"outstanding","args":{"transactions":0})") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(latencies_are_counted_exactly_while_they_are_few) {
  Histogram few;
  for (const std::uint64_t length : {7U, 3U, 3U, 100'001U}) few.add(length);
  BOOST_TEST(few.percentile(50) == 3u);
  BOOST_TEST(few.percentile(75) == 7u);
  BOOST_TEST(few.percentile(99) == 100'001u);
  Histogram many;
  for (std::uint64_t i = 0; i < 100'000; ++i) many.add(i * 7);
  BOOST_TEST(many.all().size() < 20'000u);
  BOOST_TEST(many.percentile(50) >= 349'000u);
  BOOST_TEST(many.percentile(50) <= 350'000u);
  BOOST_TEST(many.most() == 699'993u);
}

BOOST_AUTO_TEST_CASE(nonsense_on_all_wires_is_no_crash) {
  std::mt19937 random(7);
  const std::string wires =
      "m_axi_awvalid 1, m_axi_awready 1, m_axi_awid 2, m_axi_awaddr 32, m_axi_awlen 8, "
      "m_axi_awsize 3, m_axi_awburst 2, m_axi_wvalid 1, m_axi_wready 1, m_axi_wdata 64, "
      "m_axi_wstrb 8, m_axi_wlast 1, m_axi_bvalid 1, m_axi_bready 1, m_axi_bid 2, "
      "m_axi_arvalid 1, m_axi_arready 1, m_axi_arid 2, m_axi_araddr 8, m_axi_arlen 8, "
      "m_axi_rvalid 1, m_axi_rready 1, m_axi_rid 2, m_axi_rlast 1, psel 2, penable 1, paddr 8, "
      "wb_cyc 1, wb_stb 1, wb_ack 1, wb_stall 1, t_tvalid 1, t_tready 1, t_tlast 1, t_tid 8, "
      "scl 1, sda 1, uart_tx 1, mosi 1, sck 1, cs_n 1, irq 4";
  std::vector<std::pair<std::string, unsigned>> names;
  for (std::size_t at = 0; at < wires.size();) {
    const std::size_t end = std::min(wires.find(", ", at), wires.size());
    const std::size_t blank = wires.find(' ', at);
    names.emplace_back(wires.substr(at, blank - at), std::stoul(wires.substr(blank + 1)));
    at = end + 2;
  }
  ClockedBus::Script script;
  for (unsigned clock = 0; clock < 400; ++clock) {
    for (const auto& [name, width] : names) {
      if (random() % 3 != 0) continue;
      std::string digits;
      for (unsigned i = 0; i < width; ++i) digits += "0001110101xz"[random() % 12];
      script[{clock, name}] = digits;
    }
  }
  const auto found = transactions_of(ClockedBus(wires, script, 400));
  BOOST_TEST(found.survey.interfaces.size() == 8u);
  BOOST_TEST(found.all.size() > 300u);
  BOOST_TEST(found.end.broken.size() > 20u);
  for (const Transaction& one : found.all) {
    BOOST_REQUIRE(one.interface < found.survey.interfaces.size());
    BOOST_REQUIRE(!one.end_ps || *one.end_ps >= one.begin_ps);
  }
}

BOOST_AUTO_TEST_SUITE_END()
