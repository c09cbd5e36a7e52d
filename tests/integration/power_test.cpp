// What a run says of power, resources and timing, as users see it.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "executable.h"

using namespace integration;

namespace {

struct Run {
  kit::Outcome outcome;
  Json result;
};

Run run(const Arguments& arguments) {
  const Workplace place;
  Arguments all{"--quiet", "--no-pictures"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  Run done{place.run(all), {}};
  BOOST_TEST_REQUIRE(done.outcome.exit_code == 0, done.outcome.err);
  done.result = place.result();
  return done;
}

double total(const Json& result) {
  return result["summary"]["power_w"]["total"];
}
double per_frame(const Json& result) {
  return result["summary"]["energy_per_frame_mj"];
}

double module_w(const Json& result, const std::string& name) {
  double sum = 0;
  for (const Json& module : result["power"]["modules"]) {
    if (module["name"] == name) sum += module["w"].get<double>();
  }
  return sum;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const auto near = boost::test_tools::tolerance(1e-9);

}  // namespace

BOOST_AUTO_TEST_SUITE(power)

BOOST_AUTO_TEST_CASE(the_anchors_of_the_thesis) {
  const Json result = run({"demo"}).result;
  BOOST_TEST(result["power"]["mode"] == "vivado-default");
  BOOST_TEST(result["summary"]["power_w"]["ps"].get<double>() == 1.527,
             boost::test_tools::tolerance(0.01));
  BOOST_TEST(module_w(result, "pl.blob_detection") == 0.4, near);
}

BOOST_AUTO_TEST_CASE(what_stands_in_the_file_adds_up) {
  for (const char* mode : {"power.mode=vivado-default", "power.mode=activity"}) {
    const Json result = run({"demo", "squares15", "roll30", "--set", mode}).result;
    double modules = 0, mj = 0, rails = 0, frames = 0;
    for (const Json& module : result["power"]["modules"]) {
      modules += module["w"].get<double>();
      mj += module["mj"].get<double>();
    }
    for (const Json& rail : result["power"]["rails"]) rails += rail.get<double>();
    for (const Json& frame : result["frames"]) {
      const Json& energy = frame["energy_mj"];
      double groups = 0;
      for (const auto& [group, value] : energy.items()) {
        if (group != "total") groups += value.get<double>();
      }
      BOOST_TEST(groups == energy["total"].get<double>(), near);
      frames += groups;
    }
    BOOST_TEST(modules == total(result), near);
    BOOST_TEST(rails == total(result), near);
    BOOST_TEST(mj == per_frame(result), near);
    BOOST_TEST(frames == 3 * per_frame(result), near);
    BOOST_TEST(result["power"]["total_w"]["nominal"] == total(result));
    // Watts are millijoules a frame times frames a second.
    BOOST_TEST(
        per_frame(result) * result["summary"]["fps"]["mean"].get<double>() / 1e3 == total(result),
        boost::test_tools::tolerance(1e-6));
  }
}

// 2.23 W and 1.67 W; the thesis' mean frame rates make 16.6 mJ and 150 mJ of them.
BOOST_AUTO_TEST_CASE(the_hybrid_takes_more_power_and_far_less_energy) {
  const Json hybrid = run({"z1.0"}).result, ps_only = run({"z1.0", "--program", "ps-only"}).result;
  BOOST_TEST(total(hybrid) == 2.23, boost::test_tools::tolerance(0.01));
  BOOST_TEST(total(ps_only) == 1.667, boost::test_tools::tolerance(0.01));
  BOOST_TEST(ps_only["summary"]["power_w"]["pl"] == 0.0);
  BOOST_TEST(ps_only["resources"]["modules"].empty());
  BOOST_TEST(per_frame(ps_only) > 7 * per_frame(hybrid));
}

BOOST_AUTO_TEST_CASE(activity_is_below_the_vendors_estimate) {
  const Json vendor = run({"demo"}).result;
  const Json active = run({"demo", "--set", "power.mode=activity"}).result;
  BOOST_TEST(active["power"]["mode"] == "activity");
  BOOST_TEST(total(active) < total(vendor));
  BOOST_TEST(active["summary"]["power_w"]["static"] < vendor["summary"]["power_w"]["static"]);
}

BOOST_AUTO_TEST_CASE(a_point_above_fmax_runs_and_is_called_infeasible) {
  const Run fast = run({"demo", "--set", "ps.fclk_clk1.frequency=62.5 MHz"});
  const Json& timing = fast.result["timing"];
  BOOST_TEST(timing["met"] == false);
  BOOST_TEST(fast.result["frames"].size() == 1u);
  for (const Json& module : timing["modules"]) {
    BOOST_TEST(module["met"] == (module["name"] != "pl.blob_detection"));
  }
  BOOST_TEST(contains(fast.outcome.err, "pl.blob_detection misses timing"), fast.outcome.err);
  BOOST_TEST(contains(fast.outcome.out, "MISSED by pl.blob_detection"), fast.outcome.out);
  BOOST_TEST(fast.result["warnings"].size() == 1u);
  const Run usual = run({"demo"});
  BOOST_TEST(usual.result["timing"]["met"] == true);
  BOOST_TEST(!usual.result.contains("warnings"));
  BOOST_TEST(contains(usual.outcome.out, "timing   met, 10 % to spare (pl.blob_detection)"));
  BOOST_TEST(contains(usual.outcome.out, "mJ per frame"));
}

BOOST_AUTO_TEST_CASE(the_clock_that_a_chip_has_is_simulated_judged_and_said) {
  const Run made = run({"demo", "--set", "ps.fclk_clk1.frequency=55 MHz"});
  const Json& clock = made.result["clocks"]["list"][2];
  BOOST_TEST(clock["name"] == "ps.fclk_clk1");
  BOOST_TEST(clock["wish_mhz"] == 55.0);
  BOOST_TEST(clock["frequency_mhz"] == 55.555556);
  BOOST_TEST(clock["made"]["mhz"] == 55.555556);
  BOOST_TEST(clock["made"]["divisors"] == Json({18, 1}));
  BOOST_TEST(clock["below_mhz"] == 52.631579);
  BOOST_TEST(clock["within"] == true);
  BOOST_TEST(made.result["timing"]["met"] == false);  // Fmax is 55 MHz
  BOOST_TEST(contains(made.outcome.out,
                      "MISSED by pl.blob_detection: 55.556 MHz, at most 55 MHz; "
                      "the chip has 52.632 MHz\n"),
             made.outcome.out);
  BOOST_TEST(
      contains(made.outcome.out, "verdict  INFEASIBLE: timing missed by pl.blob_detection\n"));
  BOOST_TEST(contains(made.outcome.out,
                      "clock    ps.fclk_clk1 is 55.556 MHz: no PLL gives 55 MHz; else 52.632 MHz"),
             made.outcome.out);
  BOOST_TEST(made.result["configuration"]["ps.fclk_clk1.frequency"] == "55 MHz");

  const Run exact =
      run({"demo", "--set", "ps.fclk_clk1.frequency=55 MHz", "--set", "clocks=exact"});
  BOOST_TEST(exact.result["clocks"]["mode"] == "exact");
  BOOST_TEST(exact.result["clocks"]["list"][2]["frequency_mhz"] == 55.0);
  BOOST_TEST(exact.result["timing"]["met"] == true);
  BOOST_TEST(
      contains(exact.outcome.out,
               "clock    ps.fclk_clk1 is 55 MHz, exactly; a chip makes 52.632 MHz or 55.556 MHz"),
      exact.outcome.out);
  BOOST_TEST(exact.result["summary"]["fps"]["mean"] < made.result["summary"]["fps"]["mean"]);
  BOOST_TEST(!contains(run({"demo"}).outcome.out, "clock    "));
}

BOOST_AUTO_TEST_CASE(a_clock_beyond_the_speed_grade_is_told) {
  const Arguments fast{"demo", "--set", "ps.cpu_clk.frequency=766.667 MHz"};
  const Run slow_grade = run(fast);
  BOOST_TEST(slow_grade.result["clocks"]["legal"] == false);
  BOOST_TEST(slow_grade.result["clocks"]["list"][0]["within"] == false);
  BOOST_TEST(contains(slow_grade.outcome.err,
                      "ps.cpu_clk runs at 766.667 MHz, and an xc7z020-1 allows 667 MHz at most "
                      "(published, 13.0 % less)"),
             slow_grade.outcome.err);
  Arguments other = fast;
  other.insert(other.end(), {"--set", "device=xc7z020-2"});
  const Run fast_grade = run(other);
  BOOST_TEST(fast_grade.result["clocks"]["legal"] == true);
  BOOST_TEST(fast_grade.result["clocks"]["device"] == "xc7z020-2");
  BOOST_TEST(fast_grade.outcome.err == "");
}

BOOST_AUTO_TEST_CASE(a_design_that_does_not_fit_runs_and_says_so) {
  const Run large =
      run({"demo", "--set", "pl.blob_detection.label_count=1024", "--set", "device=xc7z010"});
  BOOST_TEST(large.result["resources"]["fits"] == false);
  BOOST_TEST(large.result["resources"]["over"] == Json::array({"lut", "bram36"}));
  BOOST_TEST(contains(large.outcome.err, "does not fit"), large.outcome.err);
  BOOST_TEST(contains(large.outcome.out, "TOO BIG"), large.outcome.out);
}

BOOST_AUTO_TEST_CASE(an_own_table_is_used_and_named) {
  const Workplace place;
  const std::string installed =
      kit::read_file(std::string(MARKERVP_SOURCE) + "/data/power/zynq7020.json");
  Json table = Json::parse(installed);
  table["name"] = "mine";
  for (Json& entry : table["entries"]) {
    if (entry["name"] == "ps.pll") entry["low"] = entry["nominal"] = entry["high"] = 0.125;
  }
  kit::write_file(place / "mine.json", table.dump());
  BOOST_TEST(place.run({"demo", "--set", "power.table=mine.json"}).exit_code == 0);
  BOOST_TEST(place.result()["power"]["table"] == "mine");
  BOOST_TEST(module_w(place.result(), "ps.pll") == 0.125, near);
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused_before_anything_is_written) {
  const Workplace place;
  kit::write_file(place / "bad.json", R"({"version": 7})");
  for (const auto& [setting, problem] : {std::pair{"power.table=bad.json", "version is 7"},
                                         {"power.table=nothing", "no power table 'nothing'"},
                                         {"power.mode=guess", "vivado-default or activity"},
                                         {"power.theta_ja=60", "thermal runaway"},
                                         {"power.theta_ja=28", "by the high estimate"},
                                         {"power.theta_ja=-1", "power.theta_ja"},
                                         {"power.ddr.width=20", "give 16 or 32"},
                                         {"timing.blob_detektion.fmax=60 MHz", "blob_detection"}}) {
    const kit::Outcome outcome = place.run({"demo", "--set", setting});
    BOOST_TEST(outcome.exit_code == 2, setting);
    BOOST_TEST(contains(outcome.err, problem), setting << ": " << outcome.err);
    BOOST_TEST(!std::filesystem::exists(place / "out"), setting);
  }
}

BOOST_AUTO_TEST_CASE(a_hot_chip_is_warned_of) {
  const Run hot = run({"demo", "--set", "power.ambient=70 C"});
  BOOST_TEST(contains(hot.outcome.err, "the junction settles at"), hot.outcome.err);
  BOOST_TEST(hot.result["power"]["junction_c"] > 85.0);
}

BOOST_AUTO_TEST_CASE(power_can_be_traced) {
  const Workplace place;
  const kit::Outcome outcome =
      place.run({"demo", "--quiet", "--no-pictures", "--set", "power.mode=activity", "--trace",
                 "run.vcd", "--trace-filter", "power.*", "--set", "fidelity=tlm"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  const std::string vcd = kit::read_file(place / "run.vcd");
  for (const char* name : {"total", "ps", "pl", "static"}) {
    BOOST_TEST(contains(vcd, std::string(" ") + name + " $end"), name << " is not traced");
  }
  BOOST_TEST(contains(vcd, "$var real"));
  // At least: the frame begins, the frame ends.
  BOOST_TEST(std::count(vcd.begin(), vcd.end(), 'r') > 6);
}

BOOST_AUTO_TEST_SUITE_END()
