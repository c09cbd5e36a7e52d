// The same text means the same in a trigger, a check, a constraint and a metric.
#include <study/pareto.h>
#include <trace/tools.h>
#include <vp/frame_gate.h>

#include <map>
#include <vector>

#include "../trace/waves.h"
#include "sweep_kit.h"

using namespace platform;

namespace {

/// Whether a frame is kept in which n becomes 7; m stays 0.
bool triggers(const std::string& text) {
  const kit::TemporaryFolder folder;
  vp::FrameTrigger trigger;
  trigger.condition = vp::Expression(text, "--trace-trigger");
  vp::FrameGate gate(vp::open_wave_writer(folder / "t.vcd"), trigger);
  gate.add("ps.cpu.frame", vp::WaveWriter::Kind::wire, 32);
  const auto n = gate.add("pl.n", vp::WaveWriter::Kind::wire, 8);
  gate.add("pl.m", vp::WaveWriter::Kind::wire, 8);
  gate.begin(0, {1, 0, 0});
  gate.set_time(10);
  gate.change(n, 7);
  gate.set_time(20);
  gate.close(30);
  return gate.kept() != 0;
}

/// Whether `always` passes on a trace with these values.
bool passes(const std::string& text) {
  const Waves waves("pl.n 8, pl.m 8", "#0 b111 ! b0 \"\n#10 b111 !\n#20\n");
  kit::write_file(waves / "x.checks", "it: always " + text + "\n");
  const auto checks = trace::read_checks(waves / "x.checks");
  trace::TraceFile file(waves.file);
  const auto result = run_checks(file, checks, false).front();
  return result.exercised() && result.failures == 0;
}

study::Results one_point() {
  study::Results results;
  study::ResultRow row;
  row.metrics = {{"n", 7}, {"m", 0}};
  results.rows.push_back(row);
  return results;
}

bool feasible(const std::string& text) {
  const study::Results results = one_point();
  const vp::Expression constraint(text, "x");
  study::check_names(results, constraint);
  return study::figure_in(results.rows.front(), constraint).value_or(0) != 0;
}

bool is_true(const std::string& text) {
  const study::Results results = one_point();
  const study::Objective objective("max " + text, "x");
  study::check_names(results, objective.figure());
  return study::figure_in(results.rows.front(), objective.figure()).value_or(0) != 0;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(expressions)

BOOST_AUTO_TEST_CASE(the_same_text_means_the_same_everywhere) {
  const std::map<std::string, bool> expected = {
      {"n == 7", true},
      {"n == 3 + 2 * 2", true},
      {"n < 7 or m > 0", false},
      {"not n < 7 and m == 0", true},
      {"not (n == 7 or n == 8)", false},
      {"n / 2 == 3.5", true},
      {"-n + 7 == m", true},
      {"n - 1 - 1 == 5", true},
      {"n[2:1] == 3 and n[0]", true},
      {"n == 0x7", true},
      {"n * 50 MHz >= 0.35 GHz", true},
      {"n / m == 0 or n != 7", false},
      {"not not n", true},
      {"'a' == 'a' and n > 6.99", true},
      {"`n` >= 7 and true", true},
      {"n / m > 0", false},
      {"not n / m > 0", false},
  };
  for (const auto& [text, value] : expected) {
    BOOST_TEST(triggers(text) == value, "trigger " << text);
    BOOST_TEST(passes(text) == value, "check " << text);
    BOOST_TEST(feasible(text) == value, "constraint " << text);
    BOOST_TEST(is_true(text) == value, "metric " << text);
  }
}

BOOST_AUTO_TEST_CASE(the_same_mistake_is_told_the_same_everywhere) {
  for (const char* text : {"n ==", "n = 7", "(n > 1", "n > 3 parsec", "n + 1 ms > 2", "k == 7"}) {
    std::vector<std::string> said;
    for (bool (*place)(const std::string&) : {triggers, passes, feasible, is_true}) {
      const std::string message = sweep_test::complaint([&] { place(text); });
      const auto column = message.find(", column ");
      BOOST_REQUIRE_MESSAGE(column != std::string::npos, text << ": " << message);
      said.push_back(message.substr(column, 11));
    }
    for (const std::string& other : said) BOOST_TEST(other == said.front(), text);
  }
}

BOOST_AUTO_TEST_SUITE_END()
