// The RTL of models/pl passes Verilator's lint at any size, Yosys reads it as it is, and what was
// written to become memory does. That it computes what the models do: performance_rtl.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

#include "child_process.h"

namespace {

using Words = std::vector<std::string>;

Words sources() {
  Words found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(MARKERVP_MODELS)) {
    if (entry.path().extension() == ".sv") found.push_back(entry.path().string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

struct Rtl {
  kit::Outcome lint(const Words& files, const std::string& top, const Words& parameters) const {
    Words arguments{"--lint-only", "-Wall", "--top-module", top};
    for (const std::string& parameter : parameters) arguments.push_back("-G" + parameter);
    arguments.insert(arguments.end(), files.begin(), files.end());
    return kit::run_process(VERILATOR, arguments, folder.path());
  }

  /// `commands`: of Yosys, once it has read all files.
  kit::Outcome yosys(const Words& files, const std::string& commands) const {
    std::string script = "read_verilog -sv";
    for (const std::string& file : files) script += " " + file;
    return kit::run_process(YOSYS, {"-Q", "-T", "-p", script + "; " + commands}, folder.path());
  }
  kit::Outcome elaborate(const Words& files, const std::string& top,
                         const std::string& parameter = "") const {
    return yosys(files, "hierarchy -check -top " + top + parameter +
                            "; proc; check -assert; select -assert-none t:$dlatch");
  }

  /// Cells by type of the whole hierarchy, after synthesis for the 7 series.
  std::map<std::string, int> synthesise(const std::string& top, const std::string& parameter = "",
                                        const std::string& option = "") const {
    const kit::Outcome outcome =
        yosys(sources(), "hierarchy -top " + top + parameter + "; synth_xilinx -family xc7" +
                             option + " -top " + top + "; tee -o cells.txt stat");
    BOOST_TEST_REQUIRE(outcome.exit_code == 0, outcome.out + outcome.err);
    std::string text = kit::read_file(folder / "cells.txt");
    const std::size_t whole = text.find("=== design hierarchy ===");
    if (whole != std::string::npos) text.erase(0, whole);
    std::istringstream lines(text.substr(text.find("Number of cells:")));
    std::map<std::string, int> cells;
    std::string line;
    std::getline(lines, line);
    for (std::string type; lines >> type;) lines >> cells[type];
    return cells;
  }

  kit::TemporaryFolder folder;
};

/// All parameters at their ends.
const std::vector<Words> sizes = {
    {},
    {"LEAN=1"},
    {"WIDTH=64", "HEIGHT=32", "LABELS=4", "THRESHOLD=0", "MINIMUM_SIDE=1", "LEAN=1"},
    {"WIDTH=1024", "HEIGHT=512", "LABELS=1024", "THRESHOLD=255", "MINIMUM_SIDE=1023"},
    {"WIDTH=1280", "HEIGHT=720"},
    {"WIDTH=2048", "HEIGHT=2048", "LEAN=1"},
    {"BUFFER_DEPTH=2", "FIFO_DEPTH=1", "BURST_WORDS=1", "WIDTH=32", "HEIGHT=32"},
    {"BUFFER_DEPTH=65536", "FIFO_DEPTH=65536", "BURST_WORDS=256"}};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(rtl, Rtl)

BOOST_AUTO_TEST_CASE(lint_has_nothing_to_say_at_any_size) {
  for (const Words& parameters : sizes) {
    const kit::Outcome outcome = lint(sources(), "feature_extraction", parameters);
    BOOST_TEST(outcome.exit_code == 0);
    BOOST_TEST(outcome.out + outcome.err == "");
  }
}

// Those of the design `improved`.
const std::map<std::string, std::vector<Words>> improved = {
    {"blob_labelling",
     {{},
      {"WIDTH=32", "HEIGHT=16", "LABELS=4", "MINIMUM_SIDE=1"},
      {"WIDTH=1280", "HEIGHT=720"},
      {"WIDTH=2048", "HEIGHT=2048", "LABELS=2048", "MINIMUM_SIDE=2047"},
      {"PIXELS_PER_CLOCK=2"},
      {"PIXELS_PER_CLOCK=4"},
      {"PIXELS_PER_CLOCK=4", "WIDTH=32", "HEIGHT=16", "LABELS=4", "RUN_FIFO_DEPTH=4"},
      {"PIXELS_PER_CLOCK=2", "WIDTH=2048", "HEIGHT=2048", "LABELS=2048", "RUN_FIFO_DEPTH=4096"}}},
    {"otsu_threshold",
     {{},
      {"WIDTH=32", "HEIGHT=16"},
      {"WIDTH=2048", "HEIGHT=2048"},
      {"PIXELS_PER_CLOCK=2", "WIDTH=32", "HEIGHT=16"},
      {"PIXELS_PER_CLOCK=4"},
      {"PIXELS_PER_CLOCK=4", "WIDTH=2048", "HEIGHT=2048"}}},
    {"camera",
     {{},
      {"WIDTH=32", "HEIGHT=16", "PIXELS_PER_CLOCK=4"},
      {"WIDTH=2048", "HEIGHT=2048", "PIXELS_PER_CLOCK=2"}}},
    {"control_crossing", {{}}},
    {"stream_crossing", {{}, {"DEPTH=8"}, {"DEPTH=256"}}},
    {"global_threshold",
     {{"PIXELS_PER_CLOCK=2"},
      {"PIXELS_PER_CLOCK=2", "WIDTH=2048", "HEIGHT=2048"},
      {"PIXELS_PER_CLOCK=4"},
      {"PIXELS_PER_CLOCK=4", "WIDTH=32", "HEIGHT=16"}}},
    {"local_threshold",
     {{},
      {"WIDTH=32", "HEIGHT=16", "RADIUS=1", "OFFSET=1"},
      {"WIDTH=2048", "HEIGHT=2048", "RADIUS=31", "OFFSET=255"},
      {"PIXELS_PER_CLOCK=2", "WIDTH=32", "HEIGHT=16", "RADIUS=1", "OFFSET=1"},
      {"PIXELS_PER_CLOCK=4", "WIDTH=32", "HEIGHT=16", "RADIUS=1", "OFFSET=1"},
      {"PIXELS_PER_CLOCK=4"},
      {"PIXELS_PER_CLOCK=2", "WIDTH=2048", "HEIGHT=2048", "RADIUS=31", "OFFSET=255"},
      {"PIXELS_PER_CLOCK=4", "WIDTH=2048", "HEIGHT=2048", "RADIUS=31", "OFFSET=255"}}},
    {"pixel_stream",
     {{},
      {"WIDTH=32", "HEIGHT=16", "FIFO_DEPTH=2"},
      {"WIDTH=2048", "HEIGHT=2048", "FIFO_DEPTH=65536"},
      {"PIXELS_PER_CLOCK=2"},
      {"PIXELS_PER_CLOCK=4", "WIDTH=32", "HEIGHT=16", "FIFO_DEPTH=2"}}},
    {"blob_stream", {{}, {"FIFO_DEPTH=8"}, {"FIFO_DEPTH=65535"}}}};

BOOST_AUTO_TEST_CASE(lint_has_nothing_to_say_of_the_improved_design_at_any_size) {
  for (const auto& [top, parameter_sets] : improved) {
    for (const Words& parameters : parameter_sets) {
      const kit::Outcome outcome = lint(sources(), top, parameters);
      BOOST_TEST(outcome.exit_code == 0);
      BOOST_TEST(outcome.out + outcome.err == "");
    }
  }
}

BOOST_AUTO_TEST_CASE(yosys_reads_it_and_finds_no_latch_and_no_loop) {
  Words tops{"feature_extraction"};
  for (const auto& [top, parameter_sets] : improved) tops.push_back(top);
  for (const std::string& top : tops) {
    const kit::Outcome outcome = elaborate(sources(), top);
    BOOST_TEST(outcome.exit_code == 0, top << ": " << outcome.out << outcome.err);
  }
}

BOOST_AUTO_TEST_CASE(yosys_reads_it_with_several_pixels_a_clock) {
  for (const char* top : {"blob_labelling", "local_threshold", "otsu_threshold", "pixel_stream"}) {
    for (const char* pixels : {"2", "4"}) {
      const kit::Outcome outcome =
          elaborate(sources(), top, std::string(" -chparam PIXELS_PER_CLOCK ") + pixels);
      BOOST_TEST(outcome.exit_code == 0, top << ": " << outcome.out << outcome.err);
    }
  }
}

// The checks above can fail.
BOOST_AUTO_TEST_CASE(a_wrong_width_and_a_latch_are_noticed) {
  kit::write_file(folder / "wide.sv",
                  "module wide(input logic [9:0] x, output logic [7:0] y);\n  assign y = x;\n"
                  "endmodule\n");
  const kit::Outcome outcome = lint({folder / "wide.sv"}, "wide", {});
  BOOST_TEST(outcome.exit_code != 0);
  BOOST_TEST(outcome.err.find("wide.sv:2") != std::string::npos, outcome.err);
  kit::write_file(folder / "latch.sv",
                  "module latch(input logic e, d, output logic q);\n"
                  "  always @* if (e) q = d;\nendmodule\n");
  BOOST_TEST(elaborate({folder / "latch.sv"}, "latch").exit_code != 0);
}

// Line buffers are block RAM; boxes, free labels and the words that wait are distributed memory,
// not thousands of registers.
BOOST_AUTO_TEST_CASE(memories_become_memories) {
  auto corner = synthesise("corner_detection");
  BOOST_TEST(corner["RAMB18E1"] + 2 * corner["RAMB36E1"] == 8);
  BOOST_TEST(corner["FDRE"] < 3000);
  auto blob = synthesise("blob_detection");
  BOOST_TEST(blob["RAMB18E1"] == 1);
  BOOST_TEST(blob["RAM64M"] > 100);
  BOOST_TEST(blob["FDRE"] < 3200);
  auto labelling = synthesise("blob_labelling");
  BOOST_TEST(labelling["RAMB18E1"] + 2 * labelling["RAMB36E1"] >= 10);
  BOOST_TEST(labelling["FDRE"] < 2500);
  // As `rtl synth` does: its memory of first runs takes the register of its address from the module
  // beside it.
  auto groups = synthesise("blob_labelling", " -chparam PIXELS_PER_CLOCK 4", " -flatten");
  BOOST_TEST(groups["RAMB18E1"] + 2 * groups["RAMB36E1"] >= 11);
  BOOST_TEST(groups["RAM32M"] == 16);
  BOOST_TEST(groups["FDRE"] < 2500);
  auto local = synthesise("local_threshold");
  BOOST_TEST(local["RAMB18E1"] == 5);
  BOOST_TEST(local["FDRE"] < 400);
  auto packaging = synthesise("feature_packaging");
  BOOST_TEST(packaging["FDRE"] < 300);
  auto bridge = synthesise("axi_threshold_bridge");
  BOOST_TEST(bridge["FDRE"] < 200);
  auto threshold = synthesise("global_threshold");
  BOOST_TEST(threshold["FDRE"] < 500);
  auto several = synthesise("global_threshold", " -chparam PIXELS_PER_CLOCK 4");
  BOOST_TEST(several["RAMB18E1"] == 12);
  BOOST_TEST(several["FDRE"] < 1200);
}

BOOST_AUTO_TEST_SUITE_END()
