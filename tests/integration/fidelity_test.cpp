// The same result.json at either fidelity, with every instruction set, quantum and way of polling,
// outside `fidelity`, `configuration` and `provenance`.
#include <pl/common/simd_target.h>
#include <boost/test/unit_test.hpp>

#include "executable.h"

using namespace integration;

namespace {

Json result_of(const Arguments& arguments) {
  const Workplace place;
  Arguments all{"--quiet", "--no-pictures"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const kit::Outcome outcome = place.run(all);
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  Json result = place.result();
  BOOST_TEST(result.dump().find("/markervp/") == std::string::npos,
             "a diagnostic of what the software did wrong: it did nothing wrong");
  for (const char* key : {"fidelity", "configuration", "provenance"}) result.erase(key);
  return result;
}

Arguments with(Arguments arguments, const std::string& assignment) {
  arguments.insert(arguments.end(), {"--set", assignment});
  return arguments;
}

/// Empty if equal; else the first place where they differ.
std::string difference(const Json& a, const Json& b) {
  const Json patch = Json::diff(a, b);
  return patch.empty() ? "" : patch[0].dump();
}

const Arguments inputs{"demo", "squares15", "roll30", "front7", "z4.5", "--repeat", "2"};

const Json& expected() {
  static const Json result = result_of(with(inputs, "fidelity=clocked"));
  return result;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(fidelity)

BOOST_AUTO_TEST_CASE(tlm_is_the_default) {
  const Workplace place;
  BOOST_TEST(place.run({"demo", "--quiet", "--no-pictures"}).exit_code == 0);
  BOOST_TEST(place.result()["fidelity"] == "tlm");
  BOOST_TEST(place.result()["configuration"]["pl.fidelity.blob_detection"] == "tlm");
}

BOOST_AUTO_TEST_CASE(larger_frames_than_the_thesis_packets_could_address) {
  for (const char* size : {"1280x720", "1920x1080"}) {
    BOOST_TEST_CONTEXT(size) {
      const std::string width = std::string(size).substr(0, 4),
                        height = std::string(size).substr(5);
      const Arguments scene = with(with({"demo", "--repeat", "2"}, "pl.width=" + width + " px"),
                                   "pl.height=" + height + " px");
      const Json fast = result_of(with(scene, "fidelity=tlm"));
      const Json slow = result_of(with(scene, "fidelity=clocked"));
      BOOST_TEST(difference(fast, slow) == "");
      BOOST_TEST(fast["summary"]["detected"] == 2);
      // The frame store alone is more than the chip has: said by the resources.
      BOOST_TEST(fast["resources"]["over"].dump().find("bram36") != std::string::npos);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_trace_shows_the_clocked_model_unless_asked_otherwise) {
  const Arguments trace{"demo",  "--quiet",        "--no-pictures", "--trace",
                        "a.vcd", "--trace-window", "6ms:6.01ms"};
  const Workplace clocked, tlm;
  BOOST_TEST(clocked.run(trace).exit_code == 0);
  BOOST_TEST(clocked.result()["fidelity"] == "clocked");
  BOOST_TEST(tlm.run(with(trace, "fidelity=tlm")).exit_code == 0);
  BOOST_TEST(tlm.result()["fidelity"] == "tlm");
}

BOOST_AUTO_TEST_CASE(an_ip_that_cannot_be_fed_is_refused_with_advice) {
  const Workplace place;
  const kit::Outcome outcome = place.run({"demo", "--set", "pl.fidelity.corner_detection=clocked",
                                          "--set", "pl.fidelity.sensor_input=tlm"});
  BOOST_TEST(outcome.exit_code == 2);
  BOOST_TEST(outcome.err.find("pl.fidelity.sensor_input") != std::string::npos, outcome.err);
  BOOST_TEST(outcome.err.find("pl.fidelity.corner_detection") != std::string::npos, outcome.err);
}

BOOST_AUTO_TEST_CASE(nothing_differs_at_transaction_level) {
  BOOST_TEST(difference(result_of(inputs), expected()) == "");
}

BOOST_AUTO_TEST_CASE(nothing_differs_on_any_scene_of_the_catalogue) {
  for (const char* group : {"x", "y", "z", "pitch", "yaw", "roll", "squares", "id", "front"}) {
    BOOST_TEST_CONTEXT(group) {
      BOOST_TEST(difference(result_of({group}), result_of({group, "--set", "fidelity=clocked"})) ==
                 "");
    }
  }
}

BOOST_AUTO_TEST_CASE(nothing_differs_in_a_mixture) {
  BOOST_TEST(difference(result_of(with(inputs, "pl.fidelity.corner_detection=clocked")),
                        expected()) == "");
  BOOST_TEST(
      difference(result_of(with(inputs, "pl.fidelity.blob_detection=clocked")), expected()) == "");
}

BOOST_AUTO_TEST_CASE(nothing_differs_for_any_quantum) {
  for (const char* quantum : {"0 us", "1 us", "100 us", "10 ms"}) {
    BOOST_TEST_CONTEXT(quantum) {
      BOOST_TEST(difference(result_of(with(inputs, std::string("ps.cpu.quantum=") + quantum)),
                            expected()) == "");
    }
  }
}

BOOST_AUTO_TEST_CASE(nothing_differs_with_any_instruction_set) {
  for (const std::string& target : pl::simd_targets()) {
    BOOST_TEST_CONTEXT(target) {
      BOOST_TEST(difference(result_of(with(inputs, "pl.simd=" + target)), expected()) == "");
    }
  }
}

BOOST_AUTO_TEST_CASE(an_instruction_set_that_is_not_there_is_refused) {
  const Workplace place;
  const kit::Outcome outcome = place.run({"demo", "--set", "pl.simd=NEON"});
  BOOST_TEST(outcome.exit_code == 2);
  BOOST_TEST(outcome.err.find("pl.simd = NEON: this host and build have best") != std::string::npos,
             outcome.err);
}

BOOST_AUTO_TEST_CASE(nothing_differs_when_every_poll_is_made) {
  BOOST_TEST(difference(result_of(with(inputs, "ps.poll_elision=false")), expected()) == "");
}

BOOST_AUTO_TEST_CASE(nothing_differs_at_other_clocks) {
  for (const char* clock :
       {"ps.fclk_clk1.frequency=74.25 MHz", "ps.fclk_clk0.frequency=33.333333 MHz",
        "ps.fclk_clk1.frequency=200 MHz", "ps.cpu_clk.frequency=123.456789 MHz"}) {
    BOOST_TEST_CONTEXT(clock) {
      const Arguments arguments = with(with({"demo", "--repeat", "2"}, clock), "clocks=exact");
      BOOST_TEST(difference(result_of(arguments), result_of(with(arguments, "fidelity=clocked"))) ==
                 "");
    }
  }
}

BOOST_AUTO_TEST_CASE(energy_by_activity_does_not_differ) {
  for (const char* program : {"hybrid", "ps-only"}) {
    const Arguments arguments =
        with({"demo", "squares15", "roll30", "--program", program}, "power.mode=activity");
    const Json usual = result_of(arguments);
    BOOST_TEST(difference(usual, result_of(with(arguments, "fidelity=clocked"))) == "");
    BOOST_TEST(difference(usual, result_of(with(arguments, "ps.cpu.quantum=1 us"))) == "");
    BOOST_TEST(difference(usual, result_of(with(arguments, "ps.poll_elision=false"))) == "");
  }
}

// The program ends in the middle of a frame: what is counted until then is the same, energy, too.
BOOST_AUTO_TEST_CASE(nothing_differs_when_the_software_gives_up) {
  std::string noise = "P5\n640 480\n255\n";
  std::uint64_t random = 1;
  for (int i = 0; i < 640 * 480; ++i) {
    random = random * 6'364'136'223'846'793'005u + 1'442'695'040'888'963'407u;
    noise += static_cast<char>(random >> 56);
  }
  const auto result = [&](const char* fidelity) {
    const Workplace place;
    kit::write_file(place / "noise.pgm", noise);
    const kit::Outcome outcome =
        place.run({"noise.pgm", "demo", "--quiet", "--no-pictures", "--set",
                   "pl.blob_detection.label_count=4", "--set", "ps.fclk_clk1.frequency=25 MHz",
                   "--set", "power.mode=activity", "--fidelity", fidelity});
    BOOST_TEST(outcome.exit_code == 1, outcome.err);
    Json json = place.result();
    BOOST_TEST(json["frames"][0]["counts"]["label_overflow"] > 1000);
    for (const char* key : {"fidelity", "configuration", "provenance"}) json.erase(key);
    return json;
  };
  BOOST_TEST(difference(result("tlm"), result("clocked")) == "");
}

// One key for bridge, engines and program.
BOOST_AUTO_TEST_CASE(each_length_of_a_burst_works_and_nothing_differs) {
  for (const char* words : {"4", "8", "16", "64", "128"}) {
    BOOST_TEST_CONTEXT(words << " words") {
      const Arguments arguments =
          with({"demo", "squares15", "--repeat", "2"}, std::string("pl.burst_words=") + words);
      const Json usual = result_of(arguments);
      BOOST_TEST(usual["summary"]["detected"] == 4);
      BOOST_TEST(usual["verdict"]["job"]["holds"] == "yes", usual["verdict"]["job"]);
      BOOST_TEST(difference(usual, result_of(with(arguments, "fidelity=clocked"))) == "");
    }
  }
}

BOOST_AUTO_TEST_CASE(nothing_differs_at_a_rate_of_the_camera) {
  for (const char* system : {"hybrid", "ps-only"}) {
    for (const char* rate : {"60", "150"}) {  // some frames are dropped at the second
      const Arguments arguments{"demo",      "squares15", "--repeat", "2",
                                "--program", system,      "--rate",   rate};
      const Json usual = result_of(arguments);
      BOOST_TEST(usual.contains("camera"));
      BOOST_TEST(difference(usual, result_of(with(arguments, "fidelity=clocked"))) == "");
      BOOST_TEST(difference(usual, result_of(with(arguments, "ps.cpu.quantum=1 us"))) == "");
      BOOST_TEST(difference(usual, result_of(with(arguments, "ps.poll_elision=false"))) == "");
    }
  }
}

BOOST_AUTO_TEST_CASE(nothing_differs_when_the_image_is_there_already) {
  const Arguments arguments = with({"demo", "--repeat", "2"}, "sw.upload=0");
  BOOST_TEST(difference(result_of(arguments), result_of(with(arguments, "fidelity=clocked"))) ==
             "");
}

BOOST_AUTO_TEST_SUITE_END()
