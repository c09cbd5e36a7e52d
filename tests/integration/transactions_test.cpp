// markervp trace transactions, as users call it.
#include <boost/test/unit_test.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

#include "executable.h"

namespace {

/// A stream of two packets on a clock of 10 ns, of which the second one is not taken.
const std::string stream =
    "$timescale 1ns $end\n$scope module tb $end\n$var wire 1 ! clk $end\n"
    "$var wire 1 \" m_axis_tvalid $end\n$var wire 1 # m_axis_tready $end\n"
    "$var wire 1 $ m_axis_tlast $end\n$upscope $end\n$enddefinitions $end\n#0 0! 0\" 1# 1$\n";

std::string trace() {
  std::string text = stream;
  for (unsigned ns = 5; ns < 400; ++ns) {
    if (ns % 5 != 0 && ns != 16 && ns != 26 && ns != 36) continue;
    text += "#" + std::to_string(ns) + "\n";
    if (ns % 10 == 5) text += "1!\n";
    if (ns % 10 == 0) text += "0!\n";
    if (ns == 16) text += "1\"\n";
    if (ns == 26) text += "0\" 0#\n";
    if (ns == 36) text += "1\"\n";
  }
  return text;
}

struct Transactions : integration::Workplace {
  Transactions() { kit::write_file(*this / "t.vcd", trace()); }
  kit::Outcome ask(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"trace", "transactions", "t.vcd"});
    return kit::run_process(MARKERVP_EXECUTABLE, arguments, path());
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(transactions_command, Transactions)

BOOST_AUTO_TEST_CASE(for_people_spreadsheets_and_programs) {
  const kit::Outcome text = ask({});
  BOOST_TEST(text.exit_code == 0, text.err);
  BOOST_TEST(text.out.find("tb.m_axis  axi-stream  tb.clk") != std::string::npos, text.out);
  BOOST_TEST(text.out.find("Nothing moves at the end: tb waits for the receiver of tb.m_axis since "
                           "45 ns (TREADY, 36 clocks, low since cycle 3)") != std::string::npos,
             text.out);
  const kit::Outcome csv = ask({"--csv"});
  BOOST_TEST(std::count(csv.out.begin(), csv.out.end(), '\n') == 3);
  BOOST_TEST(csv.out.find("axi-stream,tb.m_axis,packet,") != std::string::npos);
  const auto json = nlohmann::json::parse(ask({"--json"}).out);
  BOOST_TEST_REQUIRE(json["transactions"].size() == 2u);
  BOOST_TEST(json["transactions"][0]["begin_ps"] == 25'000);
  BOOST_TEST(json["transactions"][0]["end_ps"] == 25'000);
  BOOST_TEST(json["transactions"][1]["open"] == 1);
  BOOST_TEST(json["summary"][0]["transactions"] == 2);
  BOOST_TEST(json["waiting"][0]["clocks"] == 36);
}

BOOST_AUTO_TEST_CASE(only_those_that_are_asked_for) {
  const auto count = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> all = arguments;
    all.emplace_back("--csv");
    const kit::Outcome outcome = ask(all);
    BOOST_TEST(outcome.exit_code == 0, outcome.err);
    return std::count(outcome.out.begin(), outcome.out.end(), '\n') - 1;
  };
  BOOST_TEST(count({"--where", "open == 1"}) == 1);
  BOOST_TEST(count({"--window", "0ns:30ns"}) == 1);
  BOOST_TEST(count({"--most", "1"}) == 1);
  BOOST_TEST(count({"--kind", "axi4,axi-stream"}) == 2);
  for (const auto& arguments : std::vector<std::vector<std::string>>{{"--kind", "axi5"},
                                                                     {"--where", "lateness > 3"},
                                                                     {"--kind", "uart"},
                                                                     {"--filter", "nothing.**"},
                                                                     {"--as", "uart"},
                                                                     {"--window", "3"}}) {
    const kit::Outcome outcome = ask(arguments);
    BOOST_TEST(outcome.exit_code == 2, arguments.back());
    BOOST_TEST(outcome.err != "");
  }
}

BOOST_AUTO_TEST_CASE(a_pipe_cannot_be_read_twice) {
  const kit::Outcome piped = kit::run_process(
      "/bin/sh", {"-c", "cat t.vcd | " MARKERVP_EXECUTABLE " trace transactions /dev/stdin"},
      path());
  BOOST_TEST(piped.exit_code == 2);
  BOOST_TEST(piped.err.find("write it into a file first") != std::string::npos, piped.err);
}

BOOST_AUTO_TEST_CASE(lanes_in_files) {
  BOOST_TEST(ask({"--perfetto", "lanes.json", "--lanes", "lanes.fst"}).exit_code == 0);
  BOOST_TEST(nlohmann::json::parse(kit::read_file(*this / "lanes.json"))["traceEvents"].size() >
             4u);
  const kit::Outcome values = kit::run_process(
      MARKERVP_EXECUTABLE, {"trace", "values", "lanes.fst", "packet_1", "--at", "27ns"}, path());
  BOOST_TEST(values.exit_code == 0, values.err);
  BOOST_TEST(values.out.find("packet") != std::string::npos, values.out);
}

// No wire is traced: the links tell what passes them.
BOOST_AUTO_TEST_CASE(a_run_writes_its_transactions_and_is_the_same_with_and_without) {
  const auto transactions = [&](const std::string& fidelity) {
    const kit::Outcome outcome = run({"z1.0", "--fidelity", fidelity, "--transactions",
                                      fidelity + ".json", "--no-report", "--no-pictures"});
    BOOST_TEST(outcome.exit_code == 0, outcome.err);
    return nlohmann::json::parse(kit::read_file(*this / (fidelity + ".json")));
  };
  const auto tlm = transactions("tlm");
  const auto with = result()["frames"];
  run({"z1.0", "--fidelity", "tlm", "--no-report", "--no-pictures"});
  BOOST_TEST((result()["frames"] == with), "watching changes no result");

  const auto& all = tlm["transactions"];
  BOOST_TEST_REQUIRE(all.size() > 100u);
  std::map<std::string, unsigned> seen;
  std::uint64_t last_ps = 0;
  for (const auto& one : all) {
    ++seen[one["interface"].get<std::string>() + " " + one["operation"].get<std::string>()];
    BOOST_TEST(one["begin_ps"].get<std::uint64_t>() >= last_ps);
    last_ps = one["begin_ps"].get<std::uint64_t>();
    BOOST_TEST(one["latency_ps"].get<std::uint64_t>() ==
               one["end_ps"].get<std::uint64_t>() - last_ps);
    BOOST_TEST(!one.contains("clocks"), "there is no clock to count by");
  }
  BOOST_TEST(seen["ps.cpu.m_axi read"] > 0u);
  BOOST_TEST(seen["ps.cpu.m_axi write"] > 0u);
  std::uint64_t written = 0;
  for (const auto& row : tlm["summary"]) {
    const std::string key =
        row["interface"].get<std::string>() + " " + row["operation"].get<std::string>();
    BOOST_TEST(row["transactions"] == seen[key], key);
    if (row["interface"].get<std::string>().find("axi_dma_1") != std::string::npos)
      written += row["bytes"].get<std::uint64_t>();
  }
  BOOST_TEST(written == 640u * 480 / 8, "the binary image");
  BOOST_TEST((transactions("clocked")["transactions"] == all), "both fidelities agree");
}

BOOST_AUTO_TEST_SUITE_END()
