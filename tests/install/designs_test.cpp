// Designs built outside of the tree, on the installed executable.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "installation.h"

using namespace install_test;

namespace {

using Json = nlohmann::ordered_json;

struct Designs {
  Designs() {
    installed.build(installed / "share/markervp/examples/06_own_ip", "smooth");
    installed.build(project("designs"), "designs");
  }

  std::string smooth() const { return installed.beside("smooth/smooth.so"); }
  kit::Outcome mistake(const std::string& name) const {
    return installed.markervp(
        {"run", "--design", installed.beside("designs/" + name + ".so"), "--output", "never"});
  }
  Json run(const std::string& name, const Words& more) const {
    return installed.result(name, more);
  }
  std::string output(const Words& arguments) const {
    const kit::Outcome outcome = installed.markervp(arguments);
    BOOST_TEST_REQUIRE(outcome.exit_code == 0, outcome.err);
    return outcome.out;
  }

  const Installation& installed = Installation::get();
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(designs, Designs)

// The same words at the same clocks: so the same result, whatever the fidelity.
BOOST_AUTO_TEST_CASE(the_template_at_both_fidelities) {
  for (const char* scene : {"demo", "z2.0"}) {
    const Json fast = run("smooth_tlm", {scene, "--design", smooth()});
    const Json slow = run("smooth_clocked", {scene, "--design", smooth(), "--fidelity", "clocked"});
    BOOST_TEST(fast["frames"] == slow["frames"]);
    BOOST_TEST(fast["summary"]["detected"] == 1);
    BOOST_TEST(fast["design"] == "smooth");
    BOOST_TEST(fast["system"] == "counting");
  }
}

// One line and two pixels later than without it, as far as polls can tell; and other corners.
BOOST_AUTO_TEST_CASE(the_filter_filters) {
  constexpr double filter_us = 642 * 0.02, poll_us = 0.5;
  const Json smoothed = run("smooth_demo", {"demo", "--design", smooth()})["frames"][0];
  const Json plain = run("plain_demo", {"demo"})["frames"][0];
  const auto extraction = [](const Json& frame) {
    return frame["time_us"]["feature_extraction"].get<double>();
  };
  const double later = extraction(smoothed) - extraction(plain);
  BOOST_TEST(later > filter_us - poll_us);
  BOOST_TEST(later < filter_us + poll_us);
  BOOST_TEST(smoothed["counts"]["corners"] != plain["counts"]["corners"]);
}

BOOST_AUTO_TEST_CASE(its_device_and_its_program) {
  const std::string out = output({"run", "demo", "z2.0", "z3.0", "--design", smooth(), "--output",
                                  "counted", "--no-pictures"});
  BOOST_TEST(contains(out, "frames counted: 3\n"), out);
  const std::string map = output({"map", "--design", smooth()});
  BOOST_TEST(contains(map, "0x41220000..0x4122FFFF"), map);
  BOOST_TEST(contains(map, "Frame counter"), map);
  BOOST_TEST(contains(map, "63  pl.frame_counter.irq"), map);
  const std::string registers = output({"map", "frame_counter", "--design", smooth()});
  BOOST_TEST(contains(registers, "frames that began while they were counted"), registers);
}

// Its address and interrupt are properties like those of the parts that come with the platform.
BOOST_AUTO_TEST_CASE(its_device_may_be_elsewhere) {
  const Words moved{"--design", smooth(),
                    "--set",    "pl.frame_counter.base_address=0x43C00000",
                    "--set",    "pl.frame_counter.irq_id=90"};
  Words arguments{"run", "demo", "z2.0", "--output", "moved", "--no-pictures"};
  arguments.insert(arguments.end(), moved.begin(), moved.end());
  BOOST_TEST(contains(output(arguments), "frames counted: 2\n"));
  arguments = {"map", "--xparameters"};
  arguments.insert(arguments.end(), moved.begin(), moved.end());
  const std::string header = output(arguments);
  BOOST_TEST(contains(header, "XPAR_FRAME_COUNTER_BASEADDR 0x43C00000U\n"), header);
  BOOST_TEST(contains(header, "XPAR_FABRIC_FRAME_COUNTER_IRQ_INTR 90\n"), header);
}

// A newcomer's task: docs/designs.md says what it takes.
BOOST_AUTO_TEST_CASE(another_dma_engine) {
  installed.build(project("copier"), "copier");
  const Words design{"--design", installed.beside("copier/copier.so")};
  Words arguments{"run", "demo", "--output", "copied", "--no-pictures"};
  arguments.insert(arguments.end(), design.begin(), design.end());
  const std::string out = output(arguments);
  BOOST_TEST(contains(out, "bytes copied: 4096\n"), out);
  BOOST_TEST(contains(out, "1 frame, 1 with a marker"), out);
  const std::string map = output({"map", "--design", design[1]});
  BOOST_TEST(contains(map, "0x40420000..0x4042FFFF"), map);
  BOOST_TEST(contains(map, "63  pl.axi_dma_2.s2mm_introut"), map);
  const Json result = Json::parse(kit::read_file(installed.beside("copied/result.json")));
  BOOST_TEST(contains(result["resources"].dump(), "pl.axi_dma_2"));
}

BOOST_AUTO_TEST_CASE(its_parts_cost_what_they_say) {
  const Json result = run("smooth_parts", {"demo", "--design", smooth()});
  for (const char* block : {"resources", "timing", "power"}) {
    const std::string text = result[block].dump();
    BOOST_TEST(contains(text, "pl.median"), block);
    BOOST_TEST(contains(text, "pl.frame_counter"), block);
  }
  const std::string config = output({"config", "--design", smooth()});
  BOOST_TEST(contains(config, "median"), config);
}

BOOST_AUTO_TEST_CASE(reports_traces_and_sweeps_take_it) {
  run("smooth_traced",
      {"demo", "--design", smooth(), "--trace", "smooth.vcd", "--trace-window", "3ms:4ms"});
  const std::string stats = output({"trace", "stats", "smooth.vcd", "--design", smooth()});
  BOOST_TEST(contains(stats, "pl.feature_packaging.corner_count"), stats);
  BOOST_TEST(contains(output({"trace", "list", "smooth.vcd"}), "pl.median.pixel_out"));
  run("smooth_again", {"demo", "--design", smooth()});
  run("thesis_again", {"demo"});
  BOOST_TEST(contains(output({"compare", "thesis_again", "smooth_again"}), "fps"));
  output({"report", "thesis_again", "smooth_again", "--output", "filter.html"});
  BOOST_TEST(contains(kit::read_file(installed.beside("filter.html")), "pl.median"));
  output({"trace", "gtkw", "smooth.vcd", "--design", smooth()});
  BOOST_TEST(
      contains(kit::read_file(installed.beside("smooth.vcd.gtkwave/system.gtkw")), "-Features"));
  kit::write_file(installed.beside("sweep.yaml"),
                  "inputs: demo\nset:\n  design: " + smooth() +
                      "\nparameters:\n  ps.fclk_clk1.frequency: [40 MHz, 50 MHz]\n");
  output({"sweep", "sweep.yaml", "--output", "swept", "--no-report"});
  const std::string csv = kit::read_file(installed.beside("swept/sweep.csv"));
  BOOST_TEST(contains(csv, "power.modules.pl.median.w"));
  BOOST_TEST(std::count(csv.begin(), csv.end(), '\n') == 3);
  BOOST_TEST(!contains(csv, ",failed,"));
}

// Not a marker detector: what it says of its frames is what result, console, page, comparison,
// sweep and trace show.
BOOST_AUTO_TEST_CASE(a_design_of_another_kind) {
  const Words design{"--design", installed.beside("designs/brightness.so")};
  const auto with = [&](Words arguments) {
    arguments.insert(arguments.end(), design.begin(), design.end());
    return output(arguments);
  };
  constexpr int width = 64, height = 48, most = 1000;
  kit::write_file(installed.beside("white.pgm"),
                  "P5 64 48 255\n" + std::string(width * height, '\xff'));
  const std::string out = with({"run", "white.pgm", "--output", "bright"});
  BOOST_TEST(contains(out, "counts     1000 bright pixels\n"), out);
  BOOST_TEST(contains(out, "measure"), out);
  BOOST_TEST(contains(out, "design brightness"), out);
  const Json result = Json::parse(kit::read_file(installed.beside("bright/result.json")));
  BOOST_TEST(result["stages"][0].dump() ==
             R"({"name":"measure","part_of":"frame","why":"a row after the other"})");
  BOOST_TEST(result["frames"][0]["counts"]["bright_pixels"] == most);
  BOOST_TEST(result["frames"][0]["counts"]["uncounted"] == width * height - most);
  BOOST_TEST(result["verdict"]["job"]["why"] == "1 of 1 frame with losses");
  with({"run", "white.pgm", "--output", "bright_clocked", "--trace", "bright.vcd"});
  BOOST_TEST(contains(output({"compare", "bright", "bright_clocked"}), "fidelity"));
  for (const Words& report : {Words{"report", "bright"},
                              {"report", "bright", "bright_clocked", "--output", "both.html"}}) {
    output(report);
  }
  BOOST_TEST(contains(kit::read_file(installed.beside("bright/report.html")), "bright_pixels"));
  BOOST_TEST(contains(kit::read_file(installed.beside("both.html")), "bright_pixels"));
  BOOST_TEST(result["frames"][0]["time_us"]["frame"] == 5.616);
  const std::string statistics = with({"trace", "stats", "bright.vcd"});
  BOOST_TEST(contains(statistics, "0     0.000     0.000   5.616       5.616"), statistics);
  with({"trace", "gtkw", "bright.vcd"});
  BOOST_TEST(
      contains(kit::read_file(installed.beside("bright.vcd.gtkwave/system.gtkw")), "-Images"));
  kit::write_file(installed.beside("bright.yaml"),
                  "inputs: white.pgm\nset:\n  design: " + design[1] +
                      "\nparameters:\n  ps.cpu_clk.frequency: [500 MHz, 600 MHz]\n"
                      "metrics: [frames.counts.bright_pixels.mean, frames.time_us.measure.mean]\n");
  output({"sweep", "bright.yaml", "--output", "bright_swept"});
  const std::string csv = kit::read_file(installed.beside("bright_swept/sweep.csv"));
  BOOST_TEST(contains(csv, "frames.counts.bright_pixels.mean"), csv);
  BOOST_TEST(!contains(csv, ",failed,"), csv);
  BOOST_TEST(std::filesystem::exists(installed.beside("bright_swept/report.html")));
}

BOOST_AUTO_TEST_CASE(mistakes_are_refused_before_the_simulation) {
  check_refused(mistake("address_twice"), {"pl.axi_interconnect", "second", "axi_gpio_0"});
  check_refused(mistake("combinational_ring"),
                {"pl.inverter.in", "pl.inverter.out", "combinational ring", "put a register"});
  check_refused(mistake("interrupt_twice"),
                {"pl.line_id is 62", "pl.axi_dma_1.s2mm_introut", "give one of them another"});
  check_refused(mistake("missing_program"), {"design 'mistaken' lacks its PS program 'absent'",
                                             "build absent.so in", "--program"});
  check_refused(mistake("no_program"), {"no_program.so", "has no PS program", "programs"});
  check_refused(mistake("nothing_made"), {"nothing_made.so", "is incomplete"});
  check_refused(mistake("other_version"), {"other_version.so", "0.0.9", "rebuild it"});
  check_refused(mistake("unbound_port"), {"pl.part.enable", "connected to nothing", "bind it"});
  check_refused(mistake("part_outside"), {"'memory'", "outside of 'pl'", "sc_module_name"});
  check_refused(mistake("no_descriptor"), {"no_descriptor.so", "MARKERVP_DESIGN"});
  check_refused(mistake("missing"), {"missing.so", "cannot load design"});
  BOOST_TEST(!std::filesystem::exists(installed.beside("never")));
}

BOOST_AUTO_TEST_SUITE_END()
