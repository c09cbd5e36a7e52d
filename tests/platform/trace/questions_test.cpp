// Questions about moments: find and values.
#include <boost/test/unit_test.hpp>

#include <trace/questions.h>

#include "waves.h"

using namespace platform::trace;

namespace {

const std::string signals = "top.clk 1, top.req 1, top.ack 1, top.data 8";
/// A clock of 10 ns that rises at 5, 15, …; a request at 12 to 42 that is answered at 32.
const std::string changes =
    "#0 0! 0\" 0# b0 $\n#5 1!\n#10 0!\n#12 1\" b101 $\n#15 1!\n#20 0!\n#25 1!\n#30 0!\n"
    "#32 1#\n#35 1!\n#40 0!\n#42 0\" 0# bx $\n#45 1!\n#50 0!\n#55 1!\n#60 0!\n";

std::string found(const std::string& condition, const std::string& every = "",
                  const std::string& all = changes) {
  const Waves waves(signals, all);
  TraceFile file(waves.file);
  FindOptions options;
  options.condition = condition;
  if (!every.empty()) options.every = parse_clock_edge(every);
  std::string text;
  find(file, options, [&](const Occurrence& one) {
    text += std::to_string(one.from_ps / 1000) + "-" + std::to_string(one.until_ps / 1000);
    if (one.clocks != 0) text += "(" + std::to_string(one.clocks) + ")";
    text += one.open ? "... " : " ";
    return true;
  });
  return text;
}

std::string asked(const ValuesOptions& options) {
  const Waves waves(signals, changes);
  TraceFile file(waves.file);
  std::string text;
  values(file, options, [&](const ValueRow& row) {
    text += std::to_string(row.ps / 1000);
    for (const std::string& value : row.values) text += "," + value;
    text += " ";
    return true;
  });
  return text;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(questions)

BOOST_AUTO_TEST_CASE(every_time_with_its_duration) {
  BOOST_TEST(found("req and not ack") == "12-32 ");
  BOOST_TEST(found("clk rises") == "5-5 15-15 25-25 35-35 45-45 55-55 ");
  BOOST_TEST(found("data == 5") == "12-42 ");
  BOOST_TEST(found("not req") == "0-12 42-60... ");
  BOOST_TEST(found("data == 7") == "");
}

BOOST_AUTO_TEST_CASE(on_the_edges_of_a_clock_with_the_values_before_them) {
  BOOST_TEST(found("req", "clk") == "15-45(3) ");
  BOOST_TEST(found("req and not ack", "clk") == "15-35(2) ");
  BOOST_TEST(found("req", "clk falling") == "20-50(3) ");
  BOOST_TEST(found("rose(req)", "clk") == "15-25(1) ");
  BOOST_TEST(found("fell(req)", "clk") == "45-55(1) ");
  BOOST_TEST(found("past(req, 2) and not req", "clk") == "45-60(2)... ");
  BOOST_TEST(found("within(ack, 1)", "clk") == "35-55(2) ");
  BOOST_TEST(found("count(req, 3) == 3", "clk") == "35-45(1) ");
  BOOST_TEST(found("stable(data) and data == 5", "clk") == "25-45(2) ");
}

// Their lowest 64 bits are equal.
BOOST_AUTO_TEST_CASE(vectors_above_64_bits_are_compared_as_they_are) {
  const std::string high = "b1" + std::string(80, '0');
  const std::string wide_changes = "#0 b0 ! b0 \" b101 #\n#10 " + high + " !\n#20 " + high +
                                   " \"\n#30 b11" + std::string(80, '0') + " !\n#40 bH" +
                                   std::string(99, '0') + " !\n#50 bx !\n#60\n";
  const auto wide = [&](const std::string& condition) {
    const Waves waves("w 100, v 100, n 8", wide_changes);
    TraceFile file(waves.file);
    FindOptions options;
    options.condition = condition;
    std::string text;
    find(file, options, [&](const Occurrence& one) {
      text += std::to_string(one.from_ps / 1000) + "-" + std::to_string(one.until_ps / 1000) + " ";
      return true;
    });
    return text;
  };
  BOOST_TEST(wide("w == 0") == "0-10 ");
  BOOST_TEST(wide("w > 18446744073709551615") == "10-50 ");
  BOOST_TEST(wide("w == v") == "0-10 20-30 ");
  BOOST_TEST(wide("w > v") == "10-20 30-50 ");
  BOOST_TEST(wide("w changes") == "10-10 30-30 40-40 ");
  BOOST_TEST(wide("not stable(w)") == "10-50 ");
  BOOST_TEST(wide("w[81:80] == 3") == "30-40 ");
  BOOST_TEST(wide("w[99]") == "40-50 ");
  BOOST_TEST(wide("w + 1 > 0 or w < 0") == "0-10 ", "beyond 64 bits arithmetic is unknown");
  BOOST_TEST(complaint([&] { wide("n[64]"); }).find("bit 64 of a signal of 64 bits at most") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_window_and_an_end) {
  const Waves waves(signals, changes);
  TraceFile file(waves.file);
  FindOptions options;
  options.condition = "req";
  options.from_ps = 20'000;
  options.to_ps = 30'000;
  std::vector<Occurrence> all;
  const FindSummary summary = find(file, options, [&](const Occurrence& one) {
    all.push_back(one);
    return true;
  });
  BOOST_REQUIRE(all.size() == 1u);
  BOOST_TEST(all[0].from_ps == 20'000u);
  BOOST_TEST(all[0].until_ps == 30'000u);
  BOOST_TEST(summary.held_ps == 10'000u);
  TraceFile again(waves.file);
  options = {};
  options.condition = "clk rises";
  unsigned count = 0;
  find(again, options, [&](const Occurrence&) { return ++count < 2; });
  BOOST_TEST(count == 2u);
}

BOOST_AUTO_TEST_CASE(values_at_times_on_edges_and_on_conditions) {
  ValuesOptions options;
  options.signals = {"req", "data"};
  options.at_ps = {42'000, 11'999, 12'000};
  BOOST_TEST(asked(options) == "11,0,0x0 12,1,0x5 42,0,0xx ");
  options.at_ps.clear();
  options.when = "ack rises";
  BOOST_TEST(asked(options) == "32,1,0x5 ");
  options.every = parse_clock_edge("clk");
  options.when = "";
  BOOST_TEST(asked(options) == "5,0,0x0 15,1,0x5 25,1,0x5 35,1,0x5 45,0,0xx 55,0,0xx ");
  options.when = "req and ack";
  BOOST_TEST(asked(options) == "35,1,0x5 ");
}

BOOST_AUTO_TEST_CASE(what_cannot_be_asked_is_said) {
  const auto says = [](const auto& action, const std::string& expected) {
    const std::string message = complaint(action);
    BOOST_TEST(message.find(expected) != std::string::npos, message);
  };
  says([] { found("past(req, 2)"); }, "looks 2 clocks back: that needs a clock");
  says([] { found("past(req, 0)", "clk"); }, "a number of clocks is 1 to 1000");
  says([] { found("within(req)", "clk"); }, "a number of clocks is missing");
  says([] { found("soon(req)", "clk"); }, "'soon' is no function");
  says([] { found("count(count(count(req, 999), 999), 999)", "clk"); }, "write it flatter");
  says([] { found("nothing"); }, "'nothing'");
  says([] { found("req", "clk sideways"); }, "'rising' or 'falling'");
  says([] { found("data == 'run'"); }, "whose values are numbers");
  ValuesOptions options;
  options.signals = {"req"};
  says([&] { asked(options); }, "say when");
  options.at_ps = {100'000};
  says([&] { asked(options); }, "ends at 60 ns, before --at 100 ns");
}

BOOST_AUTO_TEST_SUITE_END()
