// `markervp rtl check`: RTL in lock-step with its model in the running system. `markervp rtl
// compare`: a trace against a trace.
#include <boost/test/unit_test.hpp>

#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "executable.h"

using namespace integration;

namespace {

/// The objects of tests/models/pl/rtl are for frames of 64 x 32 pixels.
struct Check : Workplace {
  Check() {
    std::string noise = "P5\n64 32\n255\n";
    std::uint32_t state = 1;
    for (int i = 0; i < 64 * 32; ++i) {
      state = state * 1'103'515'245u + 12'345u;
      noise += static_cast<char>(state >> 24);
    }
    kit::write_file(*this / "noise.pgm", noise);
  }

  kit::Outcome check(const std::string& ip, const std::string& rtl,
                     const Arguments& more = {}) const {
    Arguments all{"rtl",   "check",          ip,      "--rtl",          rtl, "noise.pgm",
                  "--set", "pl.width=64 px", "--set", "pl.height=32 px"};
    all.insert(all.end(), more.begin(), more.end());
    return kit::run_process(MARKERVP_EXECUTABLE, all, path());
  }
  /// Only that picture.
  kit::Outcome check_noise(const std::string& ip, const std::string& rtl) const {
    return check(ip, rtl, {"--no-stimuli"});
  }

  bool has(const std::string& file) const { return std::filesystem::exists(*this / file); }
};

std::string object(const std::string& name) {
  return MARKERVP_LOCKSTEP_OBJECTS "/" + name + ".so";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(rtl_check, Check)

BOOST_AUTO_TEST_CASE(a_signal_that_ends_a_play_is_named) {
  const kit::Outcome outcome = check("corner_detection", object("killed"));
  BOOST_TEST(outcome.exit_code == 3, outcome.err);
  BOOST_TEST(contains(outcome.err, "ended by the signal 'Killed'"), outcome.err);
}

BOOST_AUTO_TEST_CASE(equal_rtl_leaves_a_result_and_no_trace) {
  const kit::Outcome outcome = check("corner_detection", object("equal"));
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(!contains(outcome.err, "trace"), outcome.err);
  BOOST_TEST(contains(outcome.out, "equal: corner_detection"), outcome.out);
  BOOST_TEST(has("out/result.json"));
  BOOST_TEST(!has("out/lockstep.vcd"));
}

BOOST_AUTO_TEST_CASE(a_check_says_what_was_exercised) {
  const kit::Outcome outcome = check("corner_detection", object("equal"));
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  for (const char* part :
       {"played noise.pgm, 'pins', 'exercise' (20 pictures), 'slow_bus' (4 pictures)", "corner_out",
        "23 of 32", "not counted"})
    BOOST_TEST(contains(outcome.out, part), outcome.out);
  const auto report = nlohmann::json::parse(kit::read_file(*this / "out/check.json"));
  const auto port = [&report](const std::string& name) {
    for (const auto& port : report["ports"]) {
      if (port["name"] == name) return port;
    }
    return nlohmann::json();
  };
  BOOST_TEST(port("ena")["rises"] > 40, "frames");
  BOOST_TEST(port("rst")["rises"] > 20, "resets");
  BOOST_TEST(port("corner_data")["clocks"] > 1000, "corners");
  BOOST_TEST(report["not_exercised"].empty());
  BOOST_TEST(has("out/stimuli/noise.pgm"));
}

// RTL that gives 0 for ever equals its model on a black picture.
BOOST_AUTO_TEST_CASE(what_never_moved_is_not_equal) {
  kit::write_file(*this / "noise.pgm", "P5\n64 32\n255\n" + std::string(64 * 32, '\0'));
  for (const char* rtl : {"equal", "silent"}) {
    const kit::Outcome outcome = check_noise("corner_detection", object(rtl));
    BOOST_TEST(outcome.exit_code == 1);
    BOOST_TEST(contains(outcome.out, "NOT EXERCISED: corner_out, corner_data"), outcome.out);
    BOOST_TEST(!contains(outcome.out, "equal: "), outcome.out);
    BOOST_TEST(contains(outcome.err, "corner_out, corner_data never changed"), outcome.err);
  }
  const kit::Outcome outcome = check("corner_detection", object("silent"));
  BOOST_TEST(outcome.exit_code == 1);
  BOOST_TEST(contains(outcome.err, "corner_out is 1, and 0 in the RTL"), outcome.err);
  BOOST_TEST(has("out/pins/lockstep.vcd"));
}

// No program resets for less than five clocks, in which a corner leaves the pipeline.
BOOST_AUTO_TEST_CASE(a_short_reset_shows_what_it_forgets) {
  const kit::Outcome outcome = check("corner_detection", object("no_reset"));
  BOOST_TEST(outcome.exit_code == 1);
  BOOST_TEST(contains(outcome.err, "corner_out is 0, and 1 in the RTL"), outcome.err);
  BOOST_TEST(contains(outcome.out, "gtkwave out/pins/lockstep.vcd"), outcome.out);
  BOOST_TEST(has("out/pins/lockstep.gtkw"));
}

// Noise behind a reset, on each of the pins.
std::string noise_on_pins() {
  std::string text = "ena pixel rst x y\n0 0 1 0 0\n0 0 0 0 0\n";
  std::uint32_t state = 7;
  for (int i = 0; i < 64 * 20; ++i) {
    state = state * 1'103'515'245u + 12'345u;
    std::array<char, 64> row{};
    std::snprintf(row.data(), row.size(), "1 %x 0 %x %x\n", state >> 24, i % 64u, i / 64u);
    text += row.data();
  }
  return text;
}

BOOST_AUTO_TEST_CASE(a_stimulus_is_played_at_the_pins_and_nothing_else_is) {
  kit::write_file(*this / "stimulus.txt", noise_on_pins());
  const auto play = [this](const std::string& rtl) {
    return kit::run_process(MARKERVP_EXECUTABLE,
                            {"rtl", "check", "corner_detection", "--rtl", rtl, "--stimulus",
                             "stimulus.txt", "--set", "pl.width=64 px", "--set", "pl.height=32 px"},
                            path());
  };
  const kit::Outcome equal = play(object("equal"));
  BOOST_TEST(equal.exit_code == 0, equal.err);
  BOOST_TEST(contains(equal.out, "played 'stimulus'"), equal.out);
  const kit::Outcome late = play(object("late"));
  BOOST_TEST(late.exit_code == 1);
  BOOST_TEST(contains(late.err, "in the play 'stimulus'"), late.err);
  BOOST_TEST(contains(late.err, "corner_out is 1, and 0 in the RTL"), late.err);
  BOOST_TEST(has("out/stimulus/lockstep.vcd"));
}

BOOST_AUTO_TEST_CASE(a_stimulus_that_cannot_be_played_is_refused) {
  const auto refusal = [this](const std::string& text, const Arguments& more = {}) {
    kit::write_file(*this / "stimulus.txt", text);
    Arguments all{"rtl",           "check",      "corner_detection", "--rtl",
                  object("equal"), "--stimulus", "stimulus.txt"};
    all.insert(all.end(), more.begin(), more.end());
    const kit::Outcome outcome = kit::run_process(MARKERVP_EXECUTABLE, all, path());
    BOOST_TEST(outcome.exit_code == 2, outcome.err);
    return outcome.err;
  };
  BOOST_TEST(contains(refusal("ena rst\n1 0\n1 g\n"), "line 3: give 2 hexadecimal numbers"));
  BOOST_TEST(contains(refusal("ena rst\n"), "no clock follows the names"));
  BOOST_TEST(contains(refusal("\n"), "line 1: give the names"));
  BOOST_TEST(contains(refusal("enable\n1\n"), "'enable' of corner_detection is no input"));
  BOOST_TEST(contains(refusal("ena rst\n1 -1\n"), "line 2: numbers have no sign"));
  BOOST_TEST(contains(refusal("ena ena\n1 1\n"), "line 1: each input has a name of its own"));
  BOOST_TEST(contains(refusal("pixel\nff\n100\n"), "line 3: 'pixel' has 8 bits"));
  BOOST_TEST(contains(refusal("ena\n1\n", {"noise.pgm"}), "leave them out"));
}

BOOST_AUTO_TEST_CASE(a_check_that_plays_nothing_is_refused) {
  const kit::Outcome outcome = kit::run_process(
      MARKERVP_EXECUTABLE,
      {"rtl", "check", "corner_detection", "--rtl", object("equal"), "--no-stimuli"}, path());
  BOOST_TEST(outcome.exit_code == 2);
  BOOST_TEST(contains(outcome.err, "leaves nothing to play"), outcome.err);
}

// Nothing is known of what it takes; no number of the model's represents it.
BOOST_AUTO_TEST_CASE(a_run_with_rtl_that_was_not_synthesised_has_no_figures_of_it) {
  const auto run = [this](const Arguments& more) {
    Arguments all{
        "run",   "noise.pgm",       "--set", "pl.width=64 px",
        "--set", "pl.height=32 px", "--set", "pl.fidelity.corner_detection=" + object("equal")};
    all.insert(all.end(), more.begin(), more.end());
    return kit::run_process(MARKERVP_EXECUTABLE, all, path());
  };
  kit::Outcome outcome = run({});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(contains(outcome.out, "fits     unknown"), outcome.out);
  BOOST_TEST(contains(outcome.out, "timing   unknown: no Fmax of pl.corner_detection"),
             outcome.out);
  BOOST_TEST(contains(outcome.out, "--set pl.corner_detection.figures=FILE"), outcome.out);
  auto result = nlohmann::json::parse(kit::read_file(*this / "out/result.json"));
  BOOST_TEST(result["verdict"]["feasible"] == "unknown");
  for (const char* part : {"fits", "timing"})
    BOOST_TEST(result["verdict"][part]["holds"] == "unknown", part);
  BOOST_TEST(!result.contains("power"));
  BOOST_TEST(!result["summary"].contains("energy_per_frame_mj"));
  BOOST_TEST(!result["resources"].contains("total"));
  BOOST_TEST(result["resources"]["unknown"] == nlohmann::json{"pl.corner_detection"});
  outcome = run({"--set", "timing.corner_detection.fmax=97 MHz"});
  result = nlohmann::json::parse(kit::read_file(*this / "out/result.json"));
  BOOST_TEST(result["verdict"]["timing"]["holds"] == "yes");
  outcome = run({"--set", "pl.corner_detection.figures=none.json"});
  BOOST_TEST(outcome.exit_code == 2);
  BOOST_TEST(contains(outcome.err, "none.json"), outcome.err);
}

BOOST_AUTO_TEST_CASE(a_difference_is_told_and_shown) {
  const kit::Outcome outcome = check_noise("corner_detection", object("late"));
  BOOST_TEST(outcome.exit_code == 1);
  BOOST_TEST(contains(outcome.err, "pl.corner_detection.rtl: RTL"), outcome.err);
  BOOST_TEST(contains(outcome.err, "corner_out is 1, and 0 in the RTL"), outcome.err);
  BOOST_TEST(contains(outcome.out, "gtkwave out/lockstep.vcd out/lockstep.gtkw"), outcome.out);
  const std::string page = kit::read_file(*this / "out/lockstep.gtkw");
  for (const char* signal : {"pl.corner_detection.corner_out", "pl.corner_detection.rtl.corner_out",
                             "pl.corner_detection.rtl.corner_data", "-model", "-RTL"})
    BOOST_TEST(contains(page, signal), signal);
  // The window and a little more ends before the trace: GTKWave would show its begin else.
  const std::string start = "[timestart] ";
  const std::uint64_t opens = std::stoull(page.substr(page.find(start) + start.size()));
  const std::string trace = kit::read_file(*this / "out/lockstep.vcd");
  const std::uint64_t ends = std::stoull(trace.substr(trace.rfind("\n#") + 2));
  BOOST_TEST(opens + 1'250'000 * 104 / 100 < ends);
  BOOST_TEST(opens + 1'250'000 > 112'220'000u, "where it was noticed");
  BOOST_TEST(opens < 112'220'000u - 500'000u);
}

// A trace of an earlier difference does not outlive a check that finds none.
BOOST_AUTO_TEST_CASE(a_folder_shows_the_last_check) {
  check_noise("corner_detection", object("late"));
  BOOST_TEST(check_noise("corner_detection", object("equal")).exit_code == 0);
  BOOST_TEST(!has("out/lockstep.vcd"));
  BOOST_TEST(!has("out/lockstep.gtkw"));
}

BOOST_AUTO_TEST_CASE(what_cannot_be_checked_is_refused) {
  const auto refused = [this](const kit::Outcome& outcome, const std::vector<std::string>& parts) {
    BOOST_TEST(outcome.exit_code == 2);
    for (const std::string& part : parts) BOOST_TEST(contains(outcome.err, part), outcome.err);
    BOOST_TEST(!has("out/result.json"));
  };
  refused(check("corner_detection", "nothing.so"), {"nothing.so", "cannot load RTL"});
  refused(check("corner_detection", "."), {"no corner_detection.so", "markervp_add_rtl"});
  refused(check("blob_detection", object("equal")), {"built as corner_detection"});
  refused(check("corner_detecton", object("equal")),
          {"pl.fidelity.corner_detecton", "corner_detection"});
  refused(check("control_block", object("equal")), {"pl.fidelity.control_block"});
}

BOOST_AUTO_TEST_SUITE_END()

namespace {

/// Traces of an inverter behind a register, and the map of its ports.
struct Compare : Workplace {
  Compare() {
    trace("ours.vcd", 7, 20, 99);
    trace("same.vcd", 2, 10, 99);
    trace("other.vcd", 2, 10, 12);
    kit::write_file(*this / "ports.yaml",
                    "clock: {ours: clk, theirs: clk}\ninputs: {in: in}\noutputs: {out: out}\n");
  }

  /// A stimulus that begins behind `lead` clocks; the output of clock `wrong` of it is.
  void trace(const std::string& name, unsigned lead, unsigned period, unsigned wrong) const {
    std::string text =
        "$timescale 1ns $end\n$var wire 1 ! clk $end\n$var wire 1 i in $end\n"
        "$var wire 1 o out $end\n$enddefinitions $end\n#0 0! 0i 1o\n";
    unsigned in = 0;
    for (unsigned clock = 1; clock < lead + 40; ++clock) {
      const unsigned out = 1 - in;
      in = clock < lead ? 0 : 0x39AF2u >> (clock - lead) % 20 & 1;
      text += "#" + std::to_string(clock * period) + " 1! " + std::to_string(in) + "i " +
              std::to_string(clock == lead + wrong ? 1 - out : out) + "o\n#" +
              std::to_string(clock * period + period / 2) + " 0!\n";
    }
    kit::write_file(*this / name, text);
  }

  kit::Outcome compare(const std::string& theirs) const {
    return kit::run_process(MARKERVP_EXECUTABLE,
                            {"rtl", "compare", theirs, "ours.vcd", "--map", "ports.yaml"}, path());
  }
  bool has(const std::string& file) const { return std::filesystem::exists(*this / file); }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(rtl_compare, Compare)

BOOST_AUTO_TEST_CASE(equal_traces_leave_nothing) {
  const kit::Outcome outcome = compare("same.vcd");
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(contains(outcome.out, "clock 2 of theirs (20 ns)"), outcome.out);
  BOOST_TEST(contains(outcome.out, "clock 7 of ours (140 ns)"), outcome.out);
  BOOST_TEST(contains(outcome.out, "equal: 2 ports on 39 clocks"), outcome.out);
  BOOST_TEST(!has("out"));
}

BOOST_AUTO_TEST_CASE(a_difference_is_told_and_shown) {
  const kit::Outcome outcome = compare("other.vcd");
  BOOST_TEST(outcome.exit_code == 1);
  BOOST_TEST(contains(outcome.err,
                      "behind clock 14 of theirs (140 ns), clock 19 of ours (380 ns): out is"),
             outcome.err);
  BOOST_TEST(contains(outcome.out, "gtkwave out/compare.vcd out/compare.gtkw"), outcome.out);
  BOOST_TEST(has("out/compare.vcd"));
  BOOST_TEST(contains(kit::read_file(*this / "out/compare.gtkw"), "theirs.out"));
  BOOST_TEST(compare("same.vcd").exit_code == 0);
  BOOST_TEST(!has("out/compare.vcd"));  // a page of an earlier difference
}

BOOST_AUTO_TEST_CASE(what_cannot_be_compared_is_refused) {
  kit::Outcome outcome = compare("none.vcd");
  BOOST_TEST(outcome.exit_code == 2);
  BOOST_TEST(contains(outcome.err, "cannot read trace 'none.vcd'"), outcome.err);
  kit::write_file(*this / "ports.yaml",
                  "clock: {ours: clk, theirs: clk}\ninputs: {in: in}\noutputs: {out: otu}\n");
  outcome = compare("same.vcd");
  BOOST_TEST(outcome.exit_code == 2);
  BOOST_TEST(contains(outcome.err,
                      "ports.yaml:3: in 'same.vcd' there is no signal 'otu'; did you mean 'out'?"),
             outcome.err);
}

BOOST_AUTO_TEST_SUITE_END()

#ifdef IVERILOG

// The whole way: vectors of the platform, a simulation of theirs, and its trace against ours.
BOOST_FIXTURE_TEST_CASE(a_trace_of_icarus_is_that_of_the_platform, Check) {
  const auto markervp = [this](Arguments arguments) {
    arguments.insert(arguments.end(), {"--set", "pl.width=64 px", "--set", "pl.height=32 px"});
    return kit::run_process(MARKERVP_EXECUTABLE, arguments, path());
  };
  kit::Outcome outcome =
      markervp({"rtl", "vectors", "corner_detection", "noise.pgm", "-o", "vectors"});
  BOOST_TEST_REQUIRE(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(contains(outcome.out, "of 1 frame into vectors"), outcome.out);
  Arguments sources{"-g2012", "-s", "bench", "-o", "bench.vvp", "bench.sv"};
  for (const char* folder : {"corner_detection", "common"}) {
    const std::string rtl = std::string(MARKERVP_SOURCE "/models/pl/") + folder + "/rtl";
    for (const auto& file : std::filesystem::directory_iterator(rtl))
      sources.push_back(file.path());
  }
  outcome = kit::run_process(IVERILOG, sources, *this / "vectors");
  BOOST_TEST_REQUIRE(outcome.exit_code == 0, outcome.err);
  outcome = kit::run_process(VVP, {"-n", "bench.vvp", "+trace"}, *this / "vectors");
  BOOST_TEST(outcome.exit_code == 0, outcome.out);
  outcome = markervp({"run", "noise.pgm", "--trace", "ours.vcd", "--trace-clocks"});
  BOOST_TEST_REQUIRE(outcome.exit_code == 0, outcome.err);
  kit::write_file(*this / "ports.yaml",
                  "clock: {ours: ps.fclk_clk1.clk, theirs: bench.clk}\ninputs:\n"
                  "  sensor_input.frame_ena: bench.dut.ena\n  sensor_input.pixel: bench.dut.pixel\n"
                  "outputs:\n  corner_out: bench.dut.corner_out\n"
                  "  corner_data: {theirs: bench.dut.corner_data, valid: corner_out}\n");
  outcome = kit::run_process(
      MARKERVP_EXECUTABLE,
      {"rtl", "compare", "vectors/bench.vcd", "ours.vcd", "--map", "ports.yaml"}, path());
  BOOST_TEST(outcome.exit_code == 0, outcome.out + outcome.err);
  BOOST_TEST(contains(outcome.out, "equal: 4 ports on "), outcome.out);
}

#endif
