// The RTL of models/pl passes Verilator's lint at any size, Yosys reads it as it is, and what was
// written to become memory does. That it computes what the models do: performance_rtl.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

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
  /// `tops`: modules, with -chparam behind them. One process, as reading takes longer than the
  /// rest.
  kit::Outcome elaborate(const Words& files, const Words& tops) const {
    std::string commands = "design -save read";
    for (const std::string& top : tops) {
      commands += "; design -load read; hierarchy -check -top " + top +
                  "; proc; check -assert; select -assert-none t:$dlatch";
    }
    return yosys(files, commands);
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
  for (const std::string top :
       {"blob_labelling", "local_threshold", "otsu_threshold", "pixel_stream"}) {
    for (const char* pixels : {"2", "4"})
      tops.push_back(top + " -chparam PIXELS_PER_CLOCK " + pixels);
  }
  const kit::Outcome outcome = elaborate(sources(), tops);
  BOOST_TEST(outcome.exit_code == 0, outcome.out << outcome.err);
  std::size_t checked = 0, at = 0;
  while ((at = outcome.out.find("Found and reported 0 problems.", at) + 1) != 0) ++checked;
  BOOST_TEST(checked >= tops.size());
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
  BOOST_TEST(elaborate({folder / "latch.sv"}, {"latch"}).exit_code != 0);
}

/// The committed figures of an IP, which the tests of `rtl synth` hold to what Yosys gives.
nlohmann::json figures(const std::string& ip, const nlohmann::json& parameters) {
  const auto file = nlohmann::json::parse(kit::read_file(MARKERVP_FIGURES));
  for (const nlohmann::json& entry : file["entries"]) {
    if (entry["ip"] != ip) continue;
    bool is_it = true;
    for (const auto& [name, value] : parameters.items())
      is_it = is_it && entry["parameters"].value(name, 0) == value;
    if (is_it) return entry;
  }
  throw std::runtime_error("no figures of " + ip + " with " + parameters.dump());
}

int block_rams(const nlohmann::json& entry) {
  return int(entry["ramb18"]) + 2 * int(entry["ramb36"]);
}

// Line buffers are block RAM; boxes, free labels and the words that wait are distributed memory,
// not thousands of registers.
BOOST_AUTO_TEST_CASE(memories_become_memories) {
  const auto corner = figures("corner_detection", {{"LEAN", 0}});
  BOOST_TEST(block_rams(corner) == 8);
  BOOST_TEST(int(corner["ff"]) < 3000);
  const auto blob = figures("blob_detection", {{"LABELS", 128}});
  BOOST_TEST(block_rams(blob) == 1);
  BOOST_TEST(int(blob["lut_memory"]) > 400);
  BOOST_TEST(int(blob["ff"]) < 3200);
  const auto labelling =
      figures("blob_labelling", {{"LABELS", 128}, {"PIXELS_PER_CLOCK", 1}, {"WIDTH", 640}});
  BOOST_TEST(block_rams(labelling) >= 10);
  BOOST_TEST(int(labelling["ff"]) < 2500);
  // Its memory of first runs takes the register of its address from the module beside it.
  const auto groups =
      figures("blob_labelling", {{"LABELS", 512}, {"PIXELS_PER_CLOCK", 4}, {"WIDTH", 640}});
  BOOST_TEST(block_rams(groups) >= 11);
  BOOST_TEST(int(groups["lut_memory"]) > 400);
  BOOST_TEST(int(groups["ff"]) < 2500);
  const auto local = figures("local_threshold", {{"PIXELS_PER_CLOCK", 1}, {"RADIUS", 5}});
  BOOST_TEST(block_rams(local) == 5);
  BOOST_TEST(int(local["ff"]) < 400);
  BOOST_TEST(int(figures("feature_packaging", {{"BUFFER_DEPTH", 16}})["ff"]) < 300);
  BOOST_TEST(int(figures("axi_threshold_bridge", {{"FIFO_DEPTH", 64}})["ff"]) < 200);
  BOOST_TEST(int(figures("global_threshold", {{"PIXELS_PER_CLOCK", 1}})["ff"]) < 500);
  const auto several = figures("global_threshold", {{"PIXELS_PER_CLOCK", 4}});
  BOOST_TEST(block_rams(several) == 12);
  BOOST_TEST(int(several["ff"]) < 1200);
  BOOST_CHECK_THROW(figures("camera", {{"PIXELS_PER_CLOCK", 3}}), std::runtime_error);
}

BOOST_AUTO_TEST_SUITE_END()
