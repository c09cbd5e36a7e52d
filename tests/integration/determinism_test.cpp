// Equal runs give equal files, byte for byte; a frame's result does not depend on what comes after
// it.
#include <boost/test/unit_test.hpp>

#include "executable.h"
#include "result_schema.h"

using namespace integration;

namespace {

/// The text of a result without its `provenance` member.
std::string without_provenance(std::string text) {
  const std::size_t begin = text.find("  \"provenance\": {\n");
  const std::size_t end = text.find("\n  },\n", begin);
  BOOST_TEST_REQUIRE(begin != std::string::npos);
  BOOST_TEST_REQUIRE(end != std::string::npos);
  return text.erase(begin, end + 6 - begin);
}

Json frames_of(const Arguments& arguments) {
  const Workplace place;
  Arguments all{"--quiet", "--no-pictures"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const kit::Outcome outcome = place.run(all);
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  const Json result = place.result();
  BOOST_TEST(schema_problems(result).empty());
  return result["frames"];
}

/// All of a result that does not say how it was made.
Json outcome_with(const Arguments& settings) {
  const Workplace place;
  Arguments all{"demo", "roll30", "--repeat", "2", "--quiet", "--no-pictures"};
  for (const std::string& setting : settings) all.insert(all.end(), {"--set", setting});
  const kit::Outcome outcome = place.run(all);
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  Json result = place.result();
  for (const char* member : {"configuration", "provenance"}) result.erase(member);
  BOOST_TEST(result["frames"].size() == 4u);
  return result;
}

std::vector<std::string> inputs_of(const Json& frames) {
  std::vector<std::string> names;
  for (const Json& frame : frames) names.push_back(frame["input"]);
  return names;
}

using Names = std::vector<std::string>;

}  // namespace

BOOST_AUTO_TEST_SUITE(determinism)

BOOST_AUTO_TEST_CASE(a_trace_may_go_into_the_new_output_folder) {
  const Workplace place;
  const kit::Outcome outcome = place.run(
      {"z1.0", "--quiet", "--no-pictures", "--trace", "out/run.vcd", "--trace-filter", "ps.cpu.*"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(std::filesystem::exists(place / "out/run.vcd"));
}

BOOST_AUTO_TEST_CASE(two_runs_write_the_same_bytes) {
  const Workplace first, second;
  const Arguments arguments{"demo",           "roll30",    "--trace",       "run.vcd",
                            "--trace-window", "6ms:6.2ms", "--trace-level", "registers"};
  const kit::Outcome a = first.run(arguments);
  const kit::Outcome b = second.run(arguments);
  BOOST_TEST(a.exit_code == 0, a.err);
  BOOST_TEST(a.out == b.out);
  BOOST_TEST(a.err == b.err);
  const std::string result = without_provenance(first.result_text());
  BOOST_TEST((result == without_provenance(second.result_text())), "result.json differs");
  BOOST_TEST(Json::parse(result).contains("frames"), "only the provenance was left out");
  for (const char* file : {"run.vcd", "out/0000_demo.png", "out/0001_roll30.png"}) {
    const std::string bytes = kit::read_file(first / file);
    BOOST_TEST(bytes.size() > 1000u, file << " has " << bytes.size() << " bytes");
    BOOST_TEST((bytes == kit::read_file(second / file)), file << " differs");
  }
}

BOOST_AUTO_TEST_CASE(host_and_paths_stand_in_the_provenance_only) {
  const Workplace place;
  BOOST_TEST(place
                 .run({"z1.0", "--output", place / "out", "--trace", place / "a.vcd",
                       "--trace-window", "6ms:6.01ms"})
                 .exit_code == 0);
  const std::string result = without_provenance(place.result_text());
  BOOST_TEST(result.find(place.path()) == std::string::npos);
  BOOST_TEST(result.find(place.result()["provenance"]["date"].get<std::string>()) ==
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(tracing_changes_no_result) {
  const Workplace traced, plain;
  BOOST_TEST(traced
                 .run({"demo", "--set", "fidelity=clocked", "--trace", "a.vcd", "--trace-window",
                       "6ms:6.05ms"})
                 .exit_code == 0);
  BOOST_TEST(plain.run({"demo", "--set", "fidelity=clocked"}).exit_code == 0);
  BOOST_TEST((without_provenance(traced.result_text()) == without_provenance(plain.result_text())));
}

BOOST_AUTO_TEST_CASE(what_only_saves_time_changes_no_result) {
  const Json usual = outcome_with({});
  BOOST_TEST((outcome_with({"ps.poll_elision=false"}) == usual));
  for (const char* quantum : {"0 ps", "1 us", "10 ms"}) {
    const std::string setting = std::string("ps.cpu.quantum=") + quantum;
    BOOST_TEST((outcome_with({setting}) == usual), setting);
    BOOST_TEST((outcome_with({setting, "ps.poll_elision=false"}) == usual), setting);
  }
  BOOST_TEST((outcome_with({"ps.m_axi_gp0.read_time=81 ns"}) != usual), "what costs time does");
}

BOOST_AUTO_TEST_CASE(frames_do_not_depend_on_what_comes_after_them) {
  const Json all = frames_of({"x"});
  BOOST_TEST(all.size() == 5u);
  const Json some = frames_of({"x", "--frames", "2"});
  BOOST_TEST_REQUIRE(some.size() == 2u);
  BOOST_TEST(some[0] == all[0]);
  BOOST_TEST(some[1] == all[1]);
  BOOST_TEST(frames_of({"x-1.0"})[0] == all[0]);
  BOOST_TEST(frames_of({"x-1.0", "demo"})[0] == all[0]);
}

BOOST_AUTO_TEST_CASE(frames_come_in_the_order_of_the_inputs) {
  BOOST_TEST(inputs_of(frames_of({"roll30", "z1.0", "y"})) ==
                 (Names{"roll30", "z1.0", "y-0.8", "y-0.4", "y0.0", "y0.4", "y0.8"}),
             boost::test_tools::per_element());
  BOOST_TEST(inputs_of(frames_of({"z1.0", "roll30", "--repeat", "2", "--frames", "3"})) ==
                 (Names{"z1.0", "roll30", "z1.0"}),
             boost::test_tools::per_element());
}

/// Only the threshold goes from frame to frame. Times differ by the phase of the clocks.
BOOST_AUTO_TEST_CASE(equal_pictures_after_equal_pictures_have_equal_results) {
  const Json frames = frames_of({"z1.0", "demo", "--repeat", "3"});
  BOOST_TEST_REQUIRE(frames.size() == 6u);
  for (const char* key : {"threshold", "counts", "markers"}) {
    BOOST_TEST(frames[1][key] == frames[3][key]);
    BOOST_TEST(frames[1][key] == frames[5][key]);
    BOOST_TEST(frames[2][key] == frames[4][key]);
  }
  for (std::size_t i = 0; i < frames.size(); ++i) BOOST_TEST(frames[i]["index"] == i);
}

BOOST_AUTO_TEST_CASE(parameters_reach_result_and_hash) {
  const Workplace usual, other;
  kit::write_file(other / "slow.yaml", "ps:\n  fclk_clk1:\n    frequency: 40 MHz\n");
  BOOST_TEST(usual.run({"z1.0"}).exit_code == 0);
  BOOST_TEST(other.run({"z1.0", "--config", "slow.yaml"}).exit_code == 0);
  const Json a = usual.result(), b = other.result();
  BOOST_TEST(a["configuration"]["ps.fclk_clk1.frequency"] == "50 MHz");
  BOOST_TEST(b["configuration"]["ps.fclk_clk1.frequency"] == "40 MHz");
  BOOST_TEST(a["provenance"]["configuration_hash"] != b["provenance"]["configuration_hash"]);
}

BOOST_AUTO_TEST_SUITE_END()
