// Every kind of check passes where it should and fails where it should.
#include <boost/test/unit_test.hpp>

#include <trace/tools.h>

#include "waves.h"

namespace {

platform::trace::CheckResult judge(const std::string& check, const std::string& changes) {
  const Waves waves("a 1, b 8, c 1", changes);
  kit::write_file(waves / "x.checks", check + "\n");
  const auto checks = platform::trace::read_checks(waves / "x.checks");
  platform::trace::TraceFile file(waves.file);
  auto result = run_checks(file, checks, false).front();
  result.check = nullptr;  // it goes with `checks`
  return result;
}

/// "" if it passes, else "30 ns: detail" of the first failure.
std::string verdict(const std::string& check, const std::string& changes) {
  const auto result = judge(check, changes);
  if (result.failures == 0) return "";
  return std::to_string(result.first_ps / 1000) + " ns: " + result.detail;
}

std::string refusal(const std::string& text) {
  return complaint([&] { verdict(text, "#0 0! b0 \" 0#\n"); });
}

}  // namespace

BOOST_AUTO_TEST_SUITE(checks)

BOOST_AUTO_TEST_CASE(always_and_never) {
  BOOST_TEST(verdict("n: always b <= 3", "#0 b0 \"\n#10 b11 \"\n#20\n") == "");
  BOOST_TEST(verdict("n: always b <= 3", "#0 b0 \"\n#10 b100 \"\n#20\n") ==
             "10 ns: it does not hold");
  BOOST_TEST(verdict("n: never a and b == 3", "#0 1! b0 \"\n#10 b11 \" 0!\n#20\n") == "",
             "what changes together is seen together");
  BOOST_TEST(verdict("n: never a and b == 3", "#0 1! b0 \"\n#10 b11 \"\n") == "10 ns: it holds");
  BOOST_TEST(verdict("n: never a", "#0 x!\n#10 0!\n") == "", "unknown is no failure");
}

BOOST_AUTO_TEST_CASE(functions_look_an_instant_back) {
  const std::string changes = "#0 0! b1 \"\n#10 1! b10 \"\n#20 0!\n";
  BOOST_TEST(verdict("n: never rose(a)", changes) == "10 ns: it holds");
  BOOST_TEST(verdict("n: never fell(a)", changes) == "20 ns: it holds");
  BOOST_TEST(verdict("n: always rose(a) or fell(a)", changes) == "");
  BOOST_TEST(verdict("n: at a rises holds past(b) == 1 and b == 2", changes) == "");
  BOOST_TEST(verdict("n: at a rises holds past(b) == 2", changes) == "10 ns: it does not hold");
  BOOST_TEST(verdict("n: at a falls holds stable(b)", changes) == "");
  BOOST_TEST(verdict("n: at a rises holds stable(b)", changes) == "10 ns: it does not hold");
  BOOST_TEST(refusal("n: never past(a, 2)").find("looks 2 clocks back") != std::string::npos);
  BOOST_TEST(refusal("n: never within(a, 5)").find("looks 5 clocks back") != std::string::npos);
  BOOST_TEST(refusal("n: never past(a").find("a ')' is missing") != std::string::npos);
  BOOST_TEST(refusal("n: never soon(a)").find("'soon' is no function") != std::string::npos);
}

// How often each kind had something to judge; never: it is not exercised.
BOOST_AUTO_TEST_CASE(occasions) {
  const struct {
    const char *check, *changes;
    std::uint64_t occasions;
  } cases[] = {
      {"n: always b <= 3", "#0 bx \"\n#10 b1 \"\n#20 b10 \"\n#30\n", 2},
      {"n: always b <= 3", "#0 bx \"\n#10 0!\n#20\n", 0},
      {"n: never a", "#0 x!\n#10 x!\n#20\n", 0},
      {"n: at a rises holds b == 7", "#0 0! b111 \"\n#10 1!\n#20 0!\n#30 1!\n#40\n", 2},
      {"n: at a rises holds b == 7", "#0 1! b0 \"\n#10 0!\n#20\n", 0},
      {"n: at b changes holds a", "#0 1! b0 \"\n#10 b1 \"\n#20 b10 \"\n#30\n", 2},
      {"n: within 20 ns of a rises holds c", "#0 0! 0#\n#10 1!\n#20 1#\n#30\n", 1},
      {"n: within 20 ns of a rises holds c", "#0 0! 1#\n#10 0#\n#20\n", 0},
      {"n: within 20 ns of a rises holds c", "#0 0! 0#\n#10 1!\n#20 0!\n#30\n", 0},
      {"n: stable b while a", "#0 1! b1 \"\n#10 0!\n#20 b10 \"\n#30\n", 1},
      {"n: stable b while a", "#0 0! b1 \"\n#10 b10 \"\n#20\n", 0},
      {"n: stable b while a", "#0 1! b1 \"\n#10\n", 1},
      {"n: stable b while a", "#0 0! b1 \"\n#10 1!\n", 0},
      {"n: increases b when a", "#0 0! b0 \"\n#10 1!\n#20 b1 \"\n#30\n", 2},
      {"n: increases b when a", "#0 0! b0 \"\n#10 b1 \"\n#30\n", 0},
      {"n: bursts of 2 beats a last c", "#0 1! 0#\n#10 1#\n#20 0! 0#\n#40\n", 1},
      {"n: bursts of 2 beats a last c", "#0 0! 0#\n#10 1#\n#20 0#\n#40\n", 0},
      {"n: bursts of 2 beats a last c", "#0 1! 0#\n#10 0!\n#20 1#\n#40\n", 0},
  };
  for (const auto& c : cases) {
    BOOST_TEST_CONTEXT(c.check << " in " << c.changes) {
      const auto result = judge(c.check, c.changes);
      BOOST_TEST(result.failures == 0u);
      BOOST_TEST(result.occasions == c.occasions);
      BOOST_TEST(result.exercised() == (c.occasions != 0));
    }
  }
  BOOST_TEST(judge("n: never a", "#0 1!\n#10\n").exercised(), "what fails has looked");
}

BOOST_AUTO_TEST_CASE(failures_are_counted_each_once) {
  BOOST_TEST(judge("n: never a and b > 0", "#0 1! b1 \"\n#10 b10 \"\n#20 b11 \"\n").failures == 1u,
             "while it stays wrong");
  BOOST_TEST(judge("n: never a", "#0 1!\n#10 0!\n#20 1!\n#30\n").failures == 2u);
  BOOST_TEST(judge("n: within 20 ns of a rises holds c",
                   "#0 0! 0#\n#10 1!\n#12 0!\n#15 1!\n#40 0!\n#50 b1 \"\n#60\n")
                 .failures == 2u);
}

BOOST_AUTO_TEST_CASE(at) {
  BOOST_TEST(verdict("n: at a rises holds b == 7", "#0 0! b0 \"\n#10 1! b111 \"\n#20 b0 \"\n") ==
             "");
  BOOST_TEST(verdict("n: at a rises holds b == 7", "#0 0! b0 \"\n#10 1! b110 \"\n") ==
             "10 ns: it does not hold");
}

BOOST_AUTO_TEST_CASE(within) {
  const std::string check = "clock 100 MHz\nn: within 3 cycles of a rises holds c";
  BOOST_TEST(verdict(check, "#0 0! 0#\n#10 1!\n#40 1#\n#90\n") == "");
  BOOST_TEST(verdict(check, "#0 0! 0#\n#10 1!\n#41 1#\n#90\n") == "40 ns: not until then");
  BOOST_TEST(verdict(check, "#0 0! 0#\n#10 1!\n#90\n") == "40 ns: not until then");
  BOOST_TEST(verdict("n: within 5 ns of a rises holds c", "#0 0! 1#\n#10 1!\n#90\n") == "");
  BOOST_TEST(verdict(check, "#0 0! 0#\n#10 1!\n#20\n") == "", "the trace ends before");
}

// The condition is what stood before the edge, as the receiver sampled it.
BOOST_AUTO_TEST_CASE(stable) {
  const std::string check = "n: stable b while a and not c";
  BOOST_TEST(verdict(check, "#0 1! b1 \" 1#\n#10 b10 \" 0#\n#20 1#\n#30 b11 \"\n") == "");
  BOOST_TEST(verdict(check, "#0 1! b1 \" 0#\n#10 b10 \" 1#\n") == "10 ns: 2 after 1");
}

// Words, and vectors whose lowest 64 bits are equal.
BOOST_AUTO_TEST_CASE(all_of_a_value_is_stable) {
  const auto detail = [](const std::string& check, const std::string& signal,
                         const std::string& changes) {
    const Waves waves("a 1, " + signal, changes);
    kit::write_file(waves / "x.checks", check + "\n");
    const auto checks = platform::trace::read_checks(waves / "x.checks");
    platform::trace::TraceFile file(waves.file);
    return run_checks(file, checks, false).front().detail;
  };
  const std::string zeros(64, '0'), check = "n: stable v while a", order = "n: increases v when a";
  BOOST_TEST(detail(check, "v 100", "#0 1! b1 \"\n#10 b1" + zeros + "1 \"\n") ==
             "0x20000000000000001 after 1");
  BOOST_TEST(detail(check, "v 100", "#0 1! b1" + zeros + " \"\n#10 b01" + zeros + " \"\n") == "");
  BOOST_TEST(detail(order, "v 100", "#0 1! b11" + zeros + " \"\n#10 b10" + zeros + " \"\n") ==
             "0x20000000000000000 after 0x30000000000000000");
  BOOST_TEST(detail(check, "v 8", "#0 1! sidle \"\n#10 srun \"\n") == "'run' after 'idle'");
}

BOOST_AUTO_TEST_CASE(increases) {
  const std::string check = "n: increases b when a restart c rises";
  BOOST_TEST(verdict(check, "#0 0! b0 \" 0#\n#10 1! b1 \"\n#20 b10 \"\n#30 0!\n#40 1! b11 \"\n") ==
             "");
  BOOST_TEST(verdict(check, "#0 0! b0 \" 0#\n#10 1! b10 \"\n#20 0!\n#30 1!\n") ==
             "30 ns: 2 after 2");
  BOOST_TEST(verdict(check, "#0 0! b0 \" 0#\n#10 1! b10 \"\n#20 b1 \"\n") == "20 ns: 1 after 2");
  BOOST_TEST(verdict(check, "#0 0! b0 \" 0#\n#10 1! b10 \"\n#15 0!\n#20 1#\n#30 1! b1 \"\n") == "");
}

BOOST_AUTO_TEST_CASE(bursts) {
  const std::string check = "n: bursts of 2 beats a last c";
  BOOST_TEST(verdict(check, "#0 1! 0#\n#10 1#\n#20 0#\n#30 1#\n#40 0! 0#\n#90\n") == "");
  BOOST_TEST(verdict(check, "#0 1! 1#\n#10 0!\n#90\n") == "10 ns: 1 beats");
  BOOST_TEST(verdict(check, "#0 1! 0#\n#30 0!\n#90\n") == "30 ns: not the last of 2 beats");
}

BOOST_AUTO_TEST_CASE(mistakes_in_the_file_are_shown_with_their_line) {
  BOOST_TEST(
      refusal("# nothing\n\nn: sometimes a").find("x.checks', line 3: 'sometimes' is no kind") !=
      std::string::npos);
  BOOST_TEST(refusal("always a").find("line 1: write 'name: always") != std::string::npos);
  BOOST_TEST(refusal("n: always a +").find("column 4") != std::string::npos);
  BOOST_TEST(refusal("n: at a").find("'holds' is missing") != std::string::npos);
  BOOST_TEST(refusal("n: within 3 of a holds b").find("line 1: the time '3'") != std::string::npos);
  BOOST_TEST(refusal("clock 5 m\nn: always a").find("line 1: the clock '5 m'") !=
             std::string::npos);
  BOOST_TEST(refusal("n: bursts of 0 beats a last c").find("above 0") != std::string::npos);
  BOOST_TEST(refusal("n: always a\nn: never a").find("a check 'n' in line 1") != std::string::npos);
  BOOST_TEST(refusal("# none").find("there is none in it") != std::string::npos);
  BOOST_TEST(refusal("n: always d").find("line 1: 'd', column 1: there is no signal 'd'") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(checks_without_their_signals_can_be_left_out) {
  const Waves waves("a 1", "#0 0!\n#1 1!\n");
  kit::write_file(waves / "x.checks", "one: always z\ntwo: never a\n");
  const auto checks = platform::trace::read_checks(waves / "x.checks");
  platform::trace::TraceFile file(waves.file);
  const auto results = run_checks(file, checks, true);
  BOOST_TEST(results[0].skipped);
  BOOST_TEST(results[1].failures == 1u);
  kit::write_file(waves / "y.checks", "one: always z\n");
  const auto none = platform::trace::read_checks(waves / "y.checks");
  platform::trace::TraceFile again(waves.file);
  BOOST_TEST(complaint([&] { run_checks(again, none, true); }) != "");
}

BOOST_AUTO_TEST_SUITE_END()
