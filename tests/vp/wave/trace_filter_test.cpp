#include <vp/frame_gate.h>

#include <boost/test/unit_test.hpp>

#include "input_error.h"

namespace {

using vp::TraceFilter;

const std::vector<std::string> paths = {"zynq.pl.corner_detection.valid",
                                        "zynq.pl.corner_detection.x",
                                        "zynq.pl.blob_detection.valid",
                                        "zynq.pl.blob_detection.cache.hit",
                                        "zynq.ps.irq",
                                        "zynq.clock_ok"};

std::string selected(const std::vector<std::string>& patterns) {
  const TraceFilter filter(patterns);
  std::string result;
  for (const std::string& path : paths) result += filter.selects(path) ? '1' : '0';
  return result;
}

std::string refused(const std::vector<std::string>& patterns,
                    const std::vector<std::string>& hidden = {}) {
  return input_error([&] { TraceFilter(patterns).check(paths, hidden); });
}

}  // namespace

BOOST_AUTO_TEST_SUITE(trace_filter)

BOOST_AUTO_TEST_CASE(no_pattern_takes_everything) {
  BOOST_TEST(selected({}) == "111111");
  BOOST_TEST(selected({""}) == "111111");
  BOOST_TEST(TraceFilter().selects("x"));
}

BOOST_AUTO_TEST_CASE(a_name_takes_the_signal_or_all_below_the_module) {
  BOOST_TEST(selected({"zynq.ps.irq"}) == "000010");
  BOOST_TEST(selected({"zynq.pl.blob_detection"}) == "001100");
  BOOST_TEST(selected({"zynq.pl.blob"}) == "000000");
  BOOST_TEST(selected({"zynq"}) == "111111");
}

BOOST_AUTO_TEST_CASE(one_star_stays_within_a_level) {
  BOOST_TEST(selected({"zynq.*"}) == "000001");
  BOOST_TEST(selected({"zynq.*.irq"}) == "000010");
  BOOST_TEST(selected({"zynq.pl.*.valid"}) == "101000");
  BOOST_TEST(selected({"zynq.pl.*_detection.*"}) == "111000");
  BOOST_TEST(selected({"zynq.pl.c*n*n.?"}) == "010000");
  BOOST_TEST(selected({"*"}) == "000000");
}

BOOST_AUTO_TEST_CASE(two_stars_cross_levels_also_none) {
  BOOST_TEST(selected({"**"}) == "111111");
  BOOST_TEST(selected({"zynq.pl.**"}) == "111100");
  BOOST_TEST(selected({"**.valid"}) == "101000");
  BOOST_TEST(selected({"zynq.**.irq"}) == "000010");
  BOOST_TEST(selected({"zynq.ps.**.irq"}) == "000010");
  BOOST_TEST(selected({"**.cache.*"}) == "000100");
}

BOOST_AUTO_TEST_CASE(the_last_pattern_that_matches_decides) {
  BOOST_TEST(selected({"zynq.pl.**,-**.valid"}) == "010100");
  BOOST_TEST(selected({"-**.valid", "+zynq.pl.blob_detection.valid"}) == "011111");
  BOOST_TEST(selected({"zynq.pl", "-zynq.pl.blob_detection", "zynq.pl.blob_detection.cache"}) ==
             "110100");
  BOOST_TEST(selected({"+zynq.ps.irq  +zynq.clock_ok, -zynq.ps"}) == "000001");
}

BOOST_AUTO_TEST_CASE(a_pattern_without_a_match_is_an_error_that_tells_what_there_is) {
  BOOST_TEST(refused({"zynq.pl.**"}) == "nothing thrown");
  BOOST_TEST(refused({"zynq.pl.corner_detecton.**"}) ==
             "trace filter 'zynq.pl.corner_detecton.**' matches no signal; below 'zynq.pl' there "
             "are corner_detection, blob_detection");
  BOOST_TEST(refused({"zync.pl.**"}) ==
             "trace filter 'zync.pl.**' matches no signal; there is zynq");
  BOOST_TEST(refused({"**", "+**.valit"}) ==
             "trace filter '+**.valit' matches no signal; there are valid, hit, irq, x, clock_ok");
  BOOST_TEST(refused({"zynq.ps.irq.level"}) ==
             "trace filter 'zynq.ps.irq.level' matches no signal; 'zynq.ps.irq' is a signal, there "
             "is nothing below it");
  BOOST_TEST(refused({"zynq.p*"}) ==
             "trace filter 'zynq.p*' matches no signal; below 'zynq.p*' there are irq, "
             "blob_detection, corner_detection");
}

BOOST_AUTO_TEST_CASE(an_exclusion_may_match_nothing_but_something_must_remain) {
  BOOST_TEST(refused({"**,-**.debug"}) == "nothing thrown");
  BOOST_TEST(refused({"zynq.ps.irq", "-zynq"}) ==
             "the trace filter leaves out all 6 signals; remove a '-' pattern, for example "
             "'-zynq'");
}

BOOST_AUTO_TEST_CASE(registers_at_the_level_of_ports_are_named_as_such) {
  const std::vector<std::string> registers = {"zynq.pl.corner_detection.line"};
  BOOST_TEST(refused({"**.line"}, registers) ==
             "trace filter '**.line' matches registers only; choose the trace level that shows "
             "registers");
  BOOST_TEST(input_error([&] { TraceFilter().check({}, registers); }) ==
             "nothing to trace: there are registers only; choose the trace level that shows "
             "registers");
  BOOST_TEST(input_error([&] { TraceFilter().check({}, {}); }) ==
             "nothing to trace: this platform has no signals; trace a clocked model");
}

BOOST_AUTO_TEST_CASE(malformed_patterns_are_refused) {
  const auto made = [](const char* pattern) {
    return input_error([&] { TraceFilter filter({pattern}); });
  };
  BOOST_TEST(made("a..b") ==
             "trace filter 'a..b' has an empty level; write levels of the hierarchy with one '.' "
             "between");
  BOOST_TEST(made("-").find("trace filter '-' has an empty level") == 0u);
  BOOST_TEST(made("a.**b") ==
             "trace filter 'a.**b': '**' represents whole levels; write '*' inside a level");
  BOOST_TEST(made("***").find("'**' represents whole levels") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_signal_is_found_by_the_end_of_its_path) {
  const std::vector<std::string> paths = {"pl.one.count", "pl.two.count", "pl.two.full",
                                          "full_time"};
  BOOST_TEST(vp::find_path("full", paths, "") == 2u);
  BOOST_TEST(vp::find_path("two.count", paths, "") == 1u);
  BOOST_TEST(vp::find_path("pl.one.count", paths, "") == 0u);
  const auto fails = [&](const std::string& name, const std::string& expected) {
    BOOST_CHECK_EXCEPTION(vp::find_path(name, paths, "line 3: "), vp::InputError,
                          [&](const auto& error) { return error.what() == expected; });
  };
  fails("count", "line 3: 'count' may be pl.one.count or pl.two.count: write more of it");
  fails("ful", "line 3: there is no signal 'ful'; did you mean 'pl.two.full'?");
  fails("zzzzzzzz", "line 3: there is no signal 'zzzzzzzz'");
}

BOOST_AUTO_TEST_SUITE_END()
