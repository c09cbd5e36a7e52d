// What a trace says is what the simulation counted.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <filesystem>

#include "executable.h"

namespace {

using integration::Json;

// The software's stamps lie a reading of the timer beside the edges of the trace.
constexpr double stamp_us = 0.3;

struct Traced : integration::Workplace {
  kit::Outcome ask(const integration::Arguments& arguments) const {
    integration::Arguments all{"trace"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return kit::run_process(MARKERVP_EXECUTABLE, all, path());
  }
  void record(integration::Arguments arguments) const {
    arguments.insert(arguments.end(), {"-q", "--no-pictures", "--trace", "t.vcd"});
    BOOST_TEST_REQUIRE(run(arguments).exit_code == 0);
  }
  const integration::Arguments overflowing{"demo",
                                           "z0.5",
                                           "z1.0",
                                           "--set",
                                           "pl.feature_packaging.buffer_depth=2",
                                           "--set",
                                           "ps.m_axi_gp0.read_time=3 us"};
  const std::string checks = MARKERVP_SOURCE "/traces/checks/system.checks";
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(traces, Traced)

BOOST_AUTO_TEST_CASE(statistics_are_the_simulations_own_numbers_overflows_too) {
  record(overflowing);
  const kit::Outcome outcome = ask({"stats", "t.vcd", "--json"});
  BOOST_TEST_REQUIRE(outcome.exit_code == 0, outcome.err);
  const Json stats = Json::parse(outcome.out);
  const Json run = result();
  BOOST_TEST_REQUIRE(stats["frames"].size() == 3u);
  BOOST_TEST(run["frames"][0]["counts"]["feature_overflow"].get<int>() > 0);
  BOOST_TEST(run["frames"][2]["counts"]["feature_overflow"].get<int>() == 0);
  for (std::size_t i = 0; i < 3; ++i) {
    BOOST_TEST_CONTEXT("frame " << i) {
      const Json& counts = run["frames"][i]["counts"];
      BOOST_TEST(stats["frames"][i]["frame"] == i);
      for (const char* count : {"corners", "blobs", "feature_words", "feature_overflow",
                                "label_overflow", "bridge_overflow", "crossing_overflow"}) {
        BOOST_TEST(stats["frames"][i][count] == counts[count], count);
      }
      BOOST_TEST(stats["stages"][i]["frame"] == i);
      const Json& times = run["frames"][i]["time_us"];
      for (const char* stage :
           {"upload", "feature_extraction", "receive", "evaluation", "identification", "pose"}) {
        const double seen = stats["stages"][i][std::string(stage) + "_us"].get<double>();
        BOOST_TEST(std::abs(seen - times[stage].get<double>()) < stamp_us, stage);
      }
      const double latency = stats["stages"][i]["latency_us"].get<double>();
      BOOST_TEST(std::abs(latency - times["frame"].get<double>()) < stamp_us);
      BOOST_TEST(stats["frames"][i]["latency_us"].get<double>() == latency);
    }
  }
  BOOST_TEST(
      stats["summary"][0]["fps_mean"].get<double>() == run["summary"]["fps"]["mean"].get<double>(),
      boost::test_tools::tolerance(1e-4));
  BOOST_TEST(stats["links"][0]["beats"] == 3 * 640 * 480 / 4);
  BOOST_TEST(stats["links"][0]["packets"] == 3 * 2400);
  BOOST_TEST(stats["links"][1]["beats"] == 3 * 640 * 480 / 32);
  BOOST_TEST(stats["links"][1]["packets"] == 3 * 300);
}

BOOST_AUTO_TEST_CASE(our_checks_pass_and_say_where_something_is_lost) {
  record({"z1.0"});
  const kit::Outcome good = ask({"check", checks, "t.vcd"});
  BOOST_TEST(good.exit_code == 0, good.out);
  record(overflowing);
  const kit::Outcome bad = ask({"check", checks, "t.vcd"});
  BOOST_TEST(bad.exit_code == 1);
  BOOST_TEST(bad.out.find("FAIL no_feature_lost at ") != std::string::npos);
  BOOST_TEST(kit::read_file(*this / "t.vcd.failed.gtkw").find("feature_overflow[31:0]") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_run_does_not_differ_from_itself_but_from_another) {
  record({"z1.0", "--trace-filter", "pl.feature_packaging"});
  std::filesystem::rename(*this / "t.vcd", *this / "a.vcd");
  record({"z1.0", "--trace-filter", "pl.feature_packaging"});
  BOOST_TEST(ask({"diff", "a.vcd", "t.vcd"}).exit_code == 0);
  record({"demo", "--trace-filter", "pl.feature_packaging"});
  BOOST_TEST(ask({"diff", "a.vcd", "t.vcd"}).exit_code == 1);
}

BOOST_AUTO_TEST_CASE(gtkwave_shows_our_page,
                     *boost::unit_test::precondition([](boost::unit_test::test_unit_id) {
                       return std::filesystem::exists("/usr/bin/xvfb-run");
                     })) {
  record({"z1.0", "--trace-filter", "ps.cpu,ps.gic,pl.feature_packaging"});
  BOOST_TEST(ask({"gtkw", "t.vcd"}).exit_code == 0);
  kit::write_file(*this / "p.tcl",
                  "gtkwave::/Time/Zoom/Zoom_Full\ngtkwave::/File/Grab_To_File p.png\n"
                  "set f [open shown w]\nputs $f [gtkwave::getDisplayedSignals]\nclose $f\n"
                  "gtkwave::/File/Quit\n");
  kit::run_process(
      "/usr/bin/xvfb-run",
      {"-a", "-s", "-screen 0 1400x900x24", "gtkwave", "-S", "p.tcl", "t.vcd", "system.gtkw"},
      path());
  BOOST_TEST(std::filesystem::file_size(*this / "p.png") > 20'000u, "an empty one has 12 000");
  const std::string shown = kit::read_file(*this / "shown");
  for (const char* name : {"ps.cpu.function_name", "ps.gic.active", "feature_overflow"}) {
    BOOST_TEST(shown.find(name) != std::string::npos, name);
  }
}

BOOST_AUTO_TEST_SUITE_END()
