// A configuration that `markervp config` printed makes the run that it describes.
#include <boost/test/unit_test.hpp>

#include "executable.h"

using namespace integration;

namespace {

/// The result without what names machine and command line.
Json result_of(const Workplace& place, const Arguments& arguments) {
  Arguments all{"--quiet", "--no-pictures", "--no-report"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const kit::Outcome outcome = place.run(all);
  BOOST_TEST_REQUIRE(outcome.exit_code == 0, outcome.err);
  Json result = place.result();
  result.erase("provenance");
  return result;
}

/// `platform`: words for both `config` and `run`.
void check_round_trip(const Arguments& platform) {
  const Workplace place;
  Arguments config{"config"};
  config.insert(config.end(), platform.begin(), platform.end());
  const kit::Outcome printed = kit::run_process(MARKERVP_EXECUTABLE, config, place.path());
  BOOST_TEST_REQUIRE(printed.exit_code == 0, printed.err);
  kit::write_file(place / "d.yaml", printed.out);
  Arguments from_file{"--config", "d.yaml"};
  for (std::size_t i = 0; i < platform.size(); ++i) {
    // The file holds what --set set; the program is not in it.
    if (platform[i] == "--set") {
      ++i;
    } else {
      from_file.push_back(platform[i]);
    }
  }
  BOOST_TEST(result_of(place, platform).dump() == result_of(place, from_file).dump());
}

}  // namespace

BOOST_AUTO_TEST_SUITE(configuration)

BOOST_AUTO_TEST_CASE(a_printed_configuration_makes_the_same_run) {
  check_round_trip({});
  check_round_trip({"--program", "ps-only"});
  check_round_trip({"--program", "ps-only", "--set", "ps.cpu_clk.frequency=333 MHz"});
  check_round_trip({"--set", "profile=a9-O2", "--set", "ps.fclk_clk1.frequency=51.3 MHz"});
  check_round_trip({"--program", MARKERVP_LOSSES});
}

BOOST_AUTO_TEST_CASE(what_follows_another_key_follows_it_from_a_printed_configuration_too) {
  const Workplace place;
  for (const std::string change :
       {"fidelity=clocked", "profile=a9-O2", "ps.cpu_clk.frequency=500 MHz"}) {
    const auto config = [&](const Arguments& arguments) {
      Arguments all{"config", "--program", change == "fidelity=clocked" ? "hybrid" : "ps-only"};
      all.insert(all.end(), arguments.begin(), arguments.end());
      const kit::Outcome printed = kit::run_process(MARKERVP_EXECUTABLE, all, place.path());
      BOOST_TEST(printed.exit_code == 0, printed.err);
      return printed.out;
    };
    kit::write_file(place / "d.yaml", config({}));
    BOOST_TEST(config({"--config", "d.yaml", "--set", change}) == config({"--set", change}),
               change);
  }
}

// The software takes addresses and interrupts from the platform, so nothing else changes.
BOOST_AUTO_TEST_CASE(devices_may_be_elsewhere) {
  const Workplace place;
  const Json usual = result_of(place, {"demo", "z2.0"});
  const Arguments moved{"--set", "pl.axi_gpio_0.base_address=0x7FFF0000",
                        "--set", "pl.axi_gpio_1.base_address=0x40000000",
                        "--set", "pl.axi_dma_0.base_address=0x41200000",
                        "--set", "pl.axi_dma_1.base_address=0x43C00000",
                        "--set", "pl.axi_dma_0.mm2s_introut_id=84",
                        "--set", "pl.axi_dma_1.s2mm_introut_id=61"};
  Arguments run{"demo", "z2.0", "--trace", "moved.vcd", "--fidelity", "tlm"};
  run.insert(run.end(), moved.begin(), moved.end());
  const Json elsewhere = result_of(place, run);
  BOOST_TEST(usual["frames"] == elsewhere["frames"]);
  BOOST_TEST(usual["power"] == elsewhere["power"]);
  const auto output = [&](Arguments arguments) {
    const kit::Outcome outcome = kit::run_process(MARKERVP_EXECUTABLE, arguments, place.path());
    BOOST_TEST_REQUIRE(outcome.exit_code == 0, outcome.err);
    return outcome.out;
  };
  // Those who look at a trace find out which number an interrupt has.
  const std::string stats = output({"trace", "stats", "moved.vcd"});
  BOOST_TEST(stats.find("pl.axi_dma_0.mm2s_introut  84") != std::string::npos, stats);
  Arguments map{"map"};
  map.insert(map.end(), moved.begin(), moved.end());
  const std::string shown = output(map);
  for (const char* words : {"0x7FFF0000..0x7FFFFFFF", "84  pl.axi_dma_0.mm2s_introut",
                            "61  pl.axi_dma_1.s2mm_introut"}) {
    BOOST_TEST(shown.find(words) != std::string::npos, shown);
  }
}

BOOST_AUTO_TEST_CASE(a_program_is_built_for_the_clock_that_it_has) {
  const Workplace place;
  const auto clock = [&](const Arguments& more) {
    Arguments all{"--program", "ps-only"};
    all.insert(all.end(), more.begin(), more.end());
    const Json result = result_of(place, all);
    BOOST_TEST(result["frames"][0]["time_us"]["capture"].get<double>() == 6144.0,
               boost::test_tools::tolerance(1e-3));
    return result["configuration"]["sw.cpu_clock"].get<std::string>();
  };
  BOOST_TEST(clock({}) == "666.666667 MHz");
  BOOST_TEST(clock({"--set", "ps.cpu_clk.frequency=333 MHz"}) == "333.333333 MHz");
  const kit::Outcome wrong = place.run(
      {"--program", "ps-only", "--set", "clocks=exact", "--set", "ps.cpu_clk.frequency=500 kHz"});
  BOOST_TEST(wrong.exit_code == 2);
  BOOST_TEST(
      wrong.err.find("program 'ps-only' can be built for 1 MHz to 10 GHz") != std::string::npos,
      wrong.err);
}

BOOST_AUTO_TEST_CASE(a_limit_of_the_users_own_is_known) {
  const Workplace place;
  const auto is_bound = [&](const std::string& fmax) {
    const Json result = result_of(place, {"--set", "timing.corner_detection.fmax=" + fmax});
    for (const Json& module : result["timing"]["modules"]) {
      if (module["name"] == "pl.corner_detection")
        return module["fmax_high_mhz"] > module["fmax_mhz"];
    }
    BOOST_FAIL("no pl.corner_detection");
    return false;
  };
  BOOST_TEST(is_bound("100 MHz"), "the default, written down");
  BOOST_TEST(!is_bound("120 MHz"));
}

BOOST_AUTO_TEST_SUITE_END()
