// A simulation made elsewhere against a trace of ours.
#include <sys/stat.h>
#include <boost/test/unit_test.hpp>
#include <functional>

#include <trace/tools.h>

#include "waves.h"

using namespace platform::trace;

namespace {

/// What a module that doubles its input shows: a register, one clock late.
struct Simulation {
  unsigned lead = 3;       ///< clocks before the stimulus
  unsigned period = 10;    ///< ns
  unsigned frames = 1;     ///< of 16 clocks each, with 4 clocks between
  unsigned delay = 1;      ///< clocks from input to output
  std::string reset = "";  ///< what the output is before the stimulus: "" for 0
  std::function<void(unsigned clock, unsigned& in, unsigned& out, bool& valid)> bug;
};

std::string binary(unsigned value) {
  std::string text;
  for (int bit = 7; bit >= 0; --bit) text += (value >> bit & 1) ? '1' : '0';
  return text;
}

/// `clk 1, in 8, out 8, valid 1`: what changes, changes with the rising edge.
std::string changes(const Simulation& simulation) {
  std::string text =
      "#0 0! b0 \" b" + (simulation.reset.empty() ? "0" : simulation.reset) + " # 0$\n";
  std::vector<unsigned> inputs;
  const unsigned clocks = simulation.lead + simulation.frames * 20;
  for (unsigned clock = 1; clock <= clocks; ++clock) {
    const unsigned step = clock - std::min(clock, simulation.lead);
    unsigned in = clock > simulation.lead && (step - 1) % 20 < 16 ? 7 * step % 101 + 1 : 0;
    inputs.push_back(in);
    unsigned source = 0;
    if (inputs.size() > simulation.delay) source = inputs[inputs.size() - 1 - simulation.delay];
    unsigned out = 2 * source % 256;
    bool valid = source != 0;
    if (simulation.bug) simulation.bug(step, in, out, valid);
    text += "#" + std::to_string(clock * simulation.period) + " 1! b" + binary(in) + " \"";
    if (step > 0 || simulation.reset.empty()) text += " b" + binary(out) + " #";
    text += valid ? " 1$\n" : " 0$\n";
    text += "#" + std::to_string(clock * simulation.period + simulation.period / 2) + " 0!\n";
  }
  return text;
}

const std::string map_text =
    "clock: {ours: clk, theirs: bench.clk}\n"
    "inputs:\n  in: bench.dut.in\n"
    "outputs:\n  out: {theirs: bench.dut.out, valid: valid}\n  valid: bench.dut.valid\n";

struct Case {
  std::string theirs_signals = "bench.clk 1, bench.dut.in 8, bench.dut.out 8, bench.dut.valid 1";
  std::string ours_signals = "pl.clk 1, pl.ip.in 8, pl.ip.out 8, pl.ip.valid 1";
  std::string map = map_text;

  PortComparison compare(const std::string& theirs_changes, const std::string& ours_changes) {
    const Waves theirs(theirs_signals, theirs_changes), ours(ours_signals, ours_changes);
    kit::write_file(ours / "ports.yaml", map);
    PortMap ports = read_port_map(ours / "ports.yaml");
    return compare_ports(theirs.file, ours.file, ports);
  }
  std::string refusal(const std::string& theirs_changes, const std::string& ours_changes) {
    return complaint([&] { compare(theirs_changes, ours_changes); });
  }
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Simulation with(unsigned lead, unsigned period = 10, unsigned frames = 1) {
  Simulation simulation;
  simulation.lead = lead;
  simulation.period = period;
  simulation.frames = frames;
  return simulation;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(port_comparison, Case)

BOOST_AUTO_TEST_CASE(clocks_are_aligned_by_the_stimulus_whatever_lead_and_period) {
  const PortComparison found = compare(changes(with(5, 8)), changes(with(40, 20)));
  BOOST_TEST(found.values.empty());
  BOOST_TEST(found.theirs_begin.clock == 5u);
  BOOST_TEST(found.ours_begin.clock == 40u);
  BOOST_TEST(found.theirs_begin.ps == 40'000u);
  BOOST_TEST(found.ours_begin.ps == 800'000u);
  BOOST_TEST(found.clocks == 20u);
  BOOST_TEST(found.never_compared.empty());
  BOOST_TEST(found.never_changed.empty());
}

BOOST_AUTO_TEST_CASE(the_first_clock_that_differs_is_named_in_both) {
  Simulation theirs = with(5);
  theirs.bug = [](unsigned clock, unsigned&, unsigned& out, bool&) {
    if (clock == 9) out += 4;
  };
  const PortComparison found = compare(changes(theirs), changes(with(40, 20)));
  BOOST_REQUIRE(found.values.size() == 1u);
  BOOST_TEST(found.values[0].port == "out");
  BOOST_TEST(found.values[0].ours == "0x72");
  BOOST_TEST(found.values[0].theirs == "0x76");
  BOOST_TEST(!found.values[0].input);
  BOOST_TEST(found.theirs.clock == 14u);
  BOOST_TEST(found.theirs.ps == 140'000u);
  BOOST_TEST(found.ours.clock == 49u);
  BOOST_TEST(found.ours.ps == 980'000u);
}

// A constant delay would be aligned away, were outputs aligned, too.
BOOST_AUTO_TEST_CASE(an_output_one_clock_late_is_a_difference) {
  Simulation theirs = with(5);
  theirs.delay = 2;
  const PortComparison found = compare(changes(theirs), changes(with(40)));
  BOOST_REQUIRE(found.values.size() == 2u);
  BOOST_TEST(found.values[0].port == "out");
  BOOST_TEST(found.values[1].port == "valid");
  BOOST_TEST(found.values[1].ours == "1");
  BOOST_TEST(found.values[1].theirs == "0");
}

BOOST_AUTO_TEST_CASE(another_stimulus_is_told_as_such) {
  Simulation theirs = with(5);
  theirs.bug = [](unsigned clock, unsigned& in, unsigned&, bool&) {
    if (clock == 9) in ^= 1;
  };
  const PortComparison found = compare(changes(theirs), changes(with(40)));
  BOOST_REQUIRE(found.values.size() == 1u);
  BOOST_TEST(found.values[0].port == "in");
  BOOST_TEST(found.values[0].input);
  BOOST_TEST(found.theirs.clock == 14u);
}

// Frames 2 and 3 of ours.
BOOST_AUTO_TEST_CASE(a_part_of_the_stimulus_is_found_where_it_is) {
  const std::string all = changes(with(40, 20, 3));
  const std::size_t second = all.find("#" + std::to_string((40 + 18) * 20) + " ");
  const std::string part = "#0 0! b0 \" b0 # 0$\n" + all.substr(second);
  const PortComparison found = compare(part, all);
  BOOST_TEST(found.values.empty());
  BOOST_TEST(found.theirs_begin.clock + 57 == found.ours_begin.clock);
  BOOST_TEST(found.clocks == 40u);
}

BOOST_AUTO_TEST_CASE(what_is_unknown_until_a_reset_is_no_difference_behind_it_it_is) {
  Simulation theirs = with(5);
  theirs.reset = "x";
  map =
      "clock: {ours: clk, theirs: bench.clk}\ninputs:\n  in: bench.dut.in\n"
      "outputs:\n  out: bench.dut.out\n  valid: bench.dut.valid\n";
  BOOST_TEST(compare(changes(theirs), changes(with(5))).values.empty());
  std::string lost = changes(with(5));
  const std::string right = " b" + binary(2 * (7 * 8 % 101 + 1)) + " #";
  lost.replace(lost.find(right), right.size(), " bx #");
  const PortComparison found = compare(lost, changes(with(5)));
  BOOST_REQUIRE(found.values.size() == 1u);
  BOOST_TEST(found.values[0].theirs == "0xx");
}

BOOST_AUTO_TEST_CASE(a_difference_while_nothing_is_valid_is_none) {
  Simulation theirs = with(5);
  theirs.bug = [](unsigned, unsigned&, unsigned& out, bool& valid) {
    if (!valid) out = 99;
  };
  BOOST_TEST(compare(changes(theirs), changes(with(5))).values.empty());
}

BOOST_AUTO_TEST_CASE(ports_that_nothing_was_seen_of_are_named) {
  Simulation silent = with(5);
  silent.bug = [](unsigned, unsigned&, unsigned& out, bool& valid) {
    out = 0;
    valid = false;
  };
  const PortComparison found = compare(changes(silent), changes(silent));
  BOOST_TEST(found.values.empty());
  BOOST_TEST(found.never_compared == std::vector<std::string>{"out"});
  BOOST_TEST(found.never_changed == std::vector<std::string>{"valid"});
}

BOOST_AUTO_TEST_CASE(a_page_shows_both_in_the_time_of_ours) {
  Simulation theirs = with(5);
  theirs.bug = [](unsigned clock, unsigned&, unsigned& out, bool&) {
    if (clock == 9) out += 4;
  };
  const Waves a(theirs_signals, changes(theirs)), b(ours_signals, changes(with(40, 20)));
  kit::write_file(b / "ports.yaml", map);
  PortMap ports = read_port_map(b / "ports.yaml");
  const PortComparison found = compare_ports(a.file, b.file, ports);
  write_comparison(found, ports, b / "page");
  TraceFile page(b / "page.vcd");
  struct Seen : Replay::Listener {
    explicit Seen(TraceFile& file) : replay(file) {
      for (const char* path : {"clk", "differs", "theirs.clock_count", "theirs.out", "ours.out"})
        slots.push_back(*replay.follow(path));
      replay.run(*this);
    }
    bool instant(std::uint64_t ps) override {
      if (ps == 980'000) {
        for (const Replay::Slot slot : slots) values.push_back(replay.bits(slot));
      }
      return true;
    }
    Replay replay;
    std::vector<Replay::Slot> slots;
    std::vector<std::uint64_t> values;
  } seen(page);
  BOOST_TEST((seen.values == std::vector<std::uint64_t>{1, 1, 14, 0x76, 0x72}));
  BOOST_TEST(seen.replay.last_ps() == 1'160'000u);  // eight clocks and a period behind it
  const std::string save = kit::read_file(b / "page.gtkw");
  for (const char* line : {"theirs.out[7:0]", "ours.out[7:0]", "differs"})
    BOOST_TEST(contains(save, line), line);
}

BOOST_AUTO_TEST_CASE(a_check_that_would_look_at_nothing_is_refused) {
  Simulation other = with(5);
  other.bug = [](unsigned clock, unsigned& in, unsigned&, bool&) { in = 128 + clock; };
  BOOST_TEST(contains(refusal(changes(other), changes(with(5))), "no change in common"));
  const std::string still = "#0 0! b0 \" b0 # 0$\n#10 1!\n#20 0!\n#30 1!\n";
  BOOST_TEST(contains(refusal(still, changes(with(5))), "(0 changes on 2 clocks)"));
  const std::string no_clock = "#0 0! b0 \" b0 # 0$\n#10 b1 \"\n";
  BOOST_TEST(contains(refusal(no_clock, changes(with(5))), "clock 'bench.clk' never rises"));
  BOOST_TEST(contains(refusal(changes(with(5)), no_clock), "--trace-clocks"));
}

BOOST_AUTO_TEST_CASE(signals_that_do_not_fit_are_refused_by_name) {
  const std::string good = changes(with(5));
  map = map_text;
  map.replace(map.find("bench.dut.in"), 12, "bench.dut.inn");
  std::string message = refusal(good, good);
  BOOST_TEST(contains(message, "ports.yaml:3: in '"), message);
  BOOST_TEST(contains(message, "no signal 'bench.dut.inn'; did you mean 'bench.dut.in'?"), message);
  map = map_text;
  map.replace(map.find("valid: valid"), 12, "valid: walid");
  BOOST_TEST(contains(refusal(good, good), "did you mean 'pl.ip.valid'?"));
  map = map_text;
  ours_signals = "pl.clk 1, pl.ip.in 9, pl.ip.out 8, pl.ip.valid 1";
  message = refusal(good, good);
  BOOST_TEST(contains(message, "'in' has 9 bits, 'bench.dut.in' has 8"), message);
  ours_signals = "pl.clk 1, pl.ip.in string, pl.ip.out 8, pl.ip.valid 1";
  BOOST_TEST(contains(refusal(good, "#0 0!\n"), "no vector of bits"));
}

BOOST_AUTO_TEST_CASE(a_map_that_is_none_is_refused_with_its_line) {
  const auto refused = [this](const std::string& text) {
    map = text;
    return refusal(changes(with(5)), changes(with(5)));
  };
  BOOST_TEST(contains(refused("inputs: {a: b}\noutputs: {c: d}\n"), "'clock' is missing"));
  BOOST_TEST(contains(refused("clock: {ours: clk}\ninputs: {a: b}\noutputs: {c: d}\n"),
                      "ports.yaml:1: 'clock' is '{ours"));
  BOOST_TEST(contains(refused("clock: clk\n"), "'clock' is 'key: value' lines"));
  BOOST_TEST(contains(refused("clock: {ours: clk, theirs: clk}\ninputs: {a: b}\noutputs: {a: d}\n"),
                      "ports.yaml:3: 'a' is listed twice"));
  BOOST_TEST(contains(refused("clock: {ours: clk, theirs: clk}\noutputs: {c: d}\n"),
                      "'inputs' is missing"));
  BOOST_TEST(contains(refused("clock: {ours: clk, theirs: clk}\ninputs: {}\n"), "'inputs' is"));
  BOOST_TEST(contains(refused("clocks: {ours: clk, theirs: clk}\n"), "did you mean 'clock'?"));
  BOOST_TEST(contains(refused("clock: {ours: clk, theirs: clk}\ninputs: {a: b}\noutputs: {a: c}\n"),
                      "twice"));
  BOOST_TEST(contains(
      refused("clock: {ours: clk, theirs: clk}\ninputs: {a: {valid: b}}\noutputs: {c: d}\n"),
      "'a' has no name of theirs"));
  BOOST_TEST(contains(refused("- a\n- b\n"), "a map of ports is 'key: value' lines"));
}

BOOST_AUTO_TEST_CASE(files_that_are_none_are_refused) {
  const Waves ours(ours_signals, changes(with(5)));
  kit::write_file(ours / "ports.yaml", map);
  PortMap ports = read_port_map(ours / "ports.yaml");
  const auto against = [&](const std::string& theirs) {
    return complaint([&] { compare_ports(theirs, ours.file, ports); });
  };
  BOOST_TEST(contains(against(ours / "none.vcd"), "cannot read trace"));
  BOOST_TEST(contains(against("/dev/zero"), "cannot read trace"));
  BOOST_REQUIRE(::mkfifo((ours / "pipe").c_str(), 0600) == 0);
  BOOST_TEST(contains(against(ours / "pipe"), "is a pipe, and is read twice"));
  BOOST_TEST(contains(complaint([&] { read_port_map(ours / "none.yaml"); }), "cannot read"));
}

BOOST_AUTO_TEST_SUITE_END()
