// What the tools say of traces that other programs wrote.
#include <boost/test/unit_test.hpp>

#include <trace/listing.h>
#include <trace/questions.h>
#include <trace/tools.h>

#include "wave_kit.h"
#include "waves.h"

using namespace platform::trace;

namespace {

std::vector<CheckResult> judged(const std::string& file, const std::string& checks) {
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "x.checks", checks);
  const auto read = read_checks(folder / "x.checks");
  TraceFile trace(file);
  auto results = run_checks(trace, read, false);
  for (CheckResult& result : results) result.check = nullptr;  // it goes with `read`
  return results;
}

std::vector<std::string> converted(const std::string& from, const std::string& to) {
  TraceFile file(from);
  cut(file, to);
  return WaveText(to).lines;
}

/// A trace as a whole text.
struct Text {
  explicit Text(const std::string& bytes) : file(folder / "t.vcd") { kit::write_file(file, bytes); }
  kit::TemporaryFolder folder;
  std::string file;
};

const std::string one = "$timescale 1ns $end $var wire 1 ! a $end $enddefinitions $end\n";

}  // namespace

BOOST_AUTO_TEST_SUITE(foreign)

BOOST_AUTO_TEST_CASE(values_before_the_first_time_are_seen_by_checks) {
  const std::string checks = "high: at a falls holds a == 0\nlow: never a == 1\n";
  const Text before(one + "$dumpvars 1! $end #5 0! #10 1!\n");
  const Text after(one + "#0 $dumpvars 1! $end #5 0! #10 1!\n");
  for (const Text* text : {&before, &after}) {
    const auto results = judged(text->file, checks);
    BOOST_TEST(results[0].occasions == 1u);
    BOOST_TEST(results[0].failures == 0u);
    BOOST_TEST(results[1].failures == 2u);
    BOOST_TEST(results[1].first_ps == 0u);
  }
}

BOOST_AUTO_TEST_CASE(edges_within_a_picosecond_are_seen) {
  const Text text(
      "$timescale 100fs $end $var wire 1 ! a $end $enddefinitions $end\n"
      "#0 0! #3 1! #6 0! #9 1! #12 0!\n");
  const auto results = judged(text.file, "saw: never a rises\n");
  BOOST_TEST(results[0].failures == 2u);
  for (const char* name : {"o.vcd", "o.fst"}) {
    TraceFile file(text.file);
    cut(file, text.folder / name);
    TraceFile a(text.file), b(text.folder / name);
    BOOST_TEST(b.reader().timescale_fs() == 1u, name);
    BOOST_TEST(!difference(a, b).differ, name);
  }
  const Text other(
      "$timescale 100fs $end $var wire 1 ! a $end $enddefinitions $end\n"
      "#0 0! #3 1! #7 0! #9 1! #12 0!\n");
  TraceFile a(text.file), b(other.file);
  BOOST_TEST(difference(a, b).differ);
}

BOOST_AUTO_TEST_CASE(what_the_dump_leaves_out_is_not_judged) {
  const std::string check = "n: within 20 ns of a rises holds not a\n";
  const Text off(one + "#0 0! #10 1! #15 $dumpoff x! $end #50 $dumpon 1! $end #60\n");
  const auto unseen = judged(off.file, check);
  BOOST_TEST(unseen[0].failures == 0u);
  BOOST_TEST(unseen[0].occasions == 0u);
  const Text late(one + "#0 0! #10 1! #35 $dumpoff x! $end #50 $dumpon 1! $end #60\n");
  BOOST_TEST(judged(late.file, check)[0].failures == 1u);
}

BOOST_AUTO_TEST_CASE(every_event_occurs) {
  const Text text(
      "$timescale 1ns $end $var event 1 ! go $end $enddefinitions $end\n"
      "#10 1! #20 1! #30 1!\n");
  BOOST_TEST(judged(text.file, "n: never go rises\n")[0].failures == 3u);
  BOOST_TEST((converted(text.file, text.folder / "o.vcd") ==
              std::vector<std::string>{"10000 go 1", "20000 go 1", "30000 go 1"}));
  TraceFile back(text.folder / "o.vcd");
  BOOST_TEST(back.variable(0).is_event);
}

/// What `values --at` says of the first signal.
std::string values_at(const std::string& file, std::vector<std::uint64_t> times,
                      const vp::WaveOptions& reading = {}) {
  TraceFile trace(file, {}, reading);
  ValuesOptions options;
  options.signals = {trace.paths()[0]};
  options.at_ps = std::move(times);
  std::string text;
  values(trace, options, [&](const ValueRow& row) {
    text += row.values.front() + " ";
    return true;
  });
  return text;
}

BOOST_AUTO_TEST_CASE(an_event_has_a_value_at_its_instant_only) {
  const std::string head =
      "$timescale 1ns $end $var event 1 ! go $end $var wire 1 # a $end $enddefinitions $end\n";
  const Text text(head + "#0 0#\n#10 1!\n#20 1#\n#30 1! 0#\n#40 1#\n#50\n");
  converted(text.file, text.folder / "o.fst");
  vp::WaveOptions indexed;
  indexed.index_from = 1;
  const std::vector<std::uint64_t> times = {5'000, 10'000, 10'001, 20'000, 30'000, 50'000};
  BOOST_TEST(values_at(text.file, times) == "0 1 0 0 1 0 ");
  BOOST_TEST(values_at(text.file, times, indexed) == "0 1 0 0 1 0 ");
  BOOST_TEST(values_at(text.folder / "o.fst", times) == "0 1 0 0 1 0 ");
  // So it is for conditions, parts and differences.
  std::string found;
  TraceFile searched(text.file);
  FindOptions condition;
  condition.condition = "go";
  find(searched, condition, [&](const Occurrence& one) {
    found += std::to_string(one.from_ps) + "-" + std::to_string(one.until_ps) + " ";
    return true;
  });
  BOOST_TEST(found == "10000-10000 30000-30000 ");
  const auto failures = [&](const std::string& check) {
    return judged(text.file, "n: " + check + "\n")[0].failures;
  };
  BOOST_TEST(failures("never go") == 2u);
  BOOST_TEST(failures("at a falls holds go") == 0u);
  BOOST_TEST(failures("at a rises holds not go") == 0u);
  TraceFile file(text.file);
  CutOptions part;
  part.from_ps = 15'000;
  cut(file, text.folder / "p.vcd", part);
  BOOST_TEST(WaveText(text.folder / "p.vcd").lines.front() == "15000 a 0");
  const Text other(head + "#0 0#\n#10 1!\n#20 1#\n#30 0#\n#40 1#\n#50\n");
  TraceFile a(text.file), b(other.file);
  const Difference between = difference(a, b);
  BOOST_TEST(between.differ);
  BOOST_TEST(between.a_ps == 30'000u);
}

BOOST_AUTO_TEST_CASE(states_are_compared_with_words) {
  const Text words(
      "$timescale 1ns $end $var reg 1 ! s $end $enddefinitions $end\n"
      "#0 sIDLE ! #10 sRUN ! #20 sIDLE !\n");
  BOOST_TEST(judged(words.file, "n: never s == 'RUN'\n")[0].first_ps == 10'000u);
  const Text names(
      "$timescale 1ns $end $attrbegin misc 07 t 2 idle run 00 01 1 $end\n"
      "$attrbegin misc 07 \"\" 1 $end $var reg 2 ! s $end $enddefinitions $end\n"
      "#0 b0 ! #10 b1 !\n");
  BOOST_TEST(judged(names.file, "n: never s == 'run'\n")[0].first_ps == 10'000u);
  BOOST_TEST(judged(names.file, "n: always s != 'stop'\n")[0].failures == 0u);
  const Text text(
      "$timescale 1ns $end $var string 1 ! s $end $enddefinitions $end\n"
      "#0 sa ! #10 sb !\n");
  BOOST_TEST(judged(text.file, "n: never s == 'b'\n")[0].first_ps == 10'000u);
  BOOST_TEST(judged(text.file, "n: never s changes\n")[0].first_ps == 10'000u);
  // A mistake is no check that passes.
  const Text numbers(one + "#0 0! #10 1!\n");
  BOOST_TEST(complaint([&] {
               judged(numbers.file, "n: never a == 'run'\n");
             }).find("compares a text with 'a', whose values are numbers") != std::string::npos);
  BOOST_TEST(complaint([&] {
               judged(text.file, "n: never s + 1 == 2\n");
             }).find("calculates with a text") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(converting_invents_nothing) {
  const Text text(
      "$timescale 1ns $end $var wire 1 ! a $end $var wire 4 \" b $end\n"
      "$var wire 0 # none $end $var real 1 $ r $end $enddefinitions $end\n"
      "#5 bU \" #7 1! b1L \" r+0.5 $ #9\n");
  const std::vector<std::string> expected = {"5000 b u", "7000 a 1", "7000 b 1l", "7000 r 0.5"};
  BOOST_TEST((converted(text.file, text.folder / "o.vcd") == expected));
  const WaveText fst((converted(text.file, text.folder / "o.fst"), text.folder / "o.fst"));
  BOOST_TEST(fst.value("a", 6000) == "none");
  BOOST_TEST(fst.value("b", 6000) == "uuuu");
  BOOST_TEST(fst.value("b", 8000) == "001l");
  BOOST_TEST(fst.end_ps == 9000u);
}

// What a signal is has to be written before its values are.
BOOST_AUTO_TEST_CASE(words_in_a_vector_are_converted_as_texts) {
  const Text words(
      "$timescale 1ns $end $var reg 1 ! s $end $var reg 4 \" v $end $var real 1 # r $end\n"
      "$var reg 1 $ b $end $enddefinitions $end\n"
      "#0 0! b1 \" r1.5 # 0$ #1 sIDLE ! 1$ #2 1! r2.5 \" #3 shalf #\n");
  std::vector<std::uint32_t> mixed;
  TraceFile first(words.file);
  BOOST_CHECK_EXCEPTION(
      cut(first, words.folder / "o.vcd"), MixedTypes, [&](const MixedTypes& found) {
        mixed = found.nets;
        return std::string(found.what())
                   .find("at 1 ns: a signal has the value 'IDLE', which is not") !=
               std::string::npos;
      });
  BOOST_TEST((mixed == std::vector<std::uint32_t>{0, 1, 2}));
  for (const char* name : {"o.vcd", "o.fst"}) {
    TraceFile file(words.file);
    CutOptions options;
    options.as_texts = mixed;
    cut(file, words.folder / name, options);
    const WaveText read(words.folder / name);
    BOOST_TEST(read.value("s", 0) == "0", name);
    BOOST_TEST(read.value("s", 1500) == "IDLE", name);
    BOOST_TEST(read.value("s", 2500) == "1", name);
    BOOST_TEST(read.value("v", 1500) == "1", name);
    BOOST_TEST(read.value("v", 2500) == "2.5", name);
    BOOST_TEST(read.value("r", 3500) == "half", name);
    BOOST_TEST(read.value("b", 1500) == "1", name);
  }
}

BOOST_AUTO_TEST_CASE(bits_come_back_from_both_formats_as_a_vector) {
  const Text text(
      "$timescale 1ns $end $var wire 1 ! q [1] $end $var wire 1 \" q [0] $end\n"
      "$enddefinitions $end #0 0! 1\" #4 1!\n");
  for (const char* name : {"o.vcd", "o.fst"}) {
    converted(text.file, text.folder / name);
    const WaveText read(text.folder / name);
    BOOST_TEST(read.declared == "q ", name);
    BOOST_TEST(read.value("q", 4000) == "11", name);
  }
}

BOOST_AUTO_TEST_CASE(a_list_says_what_is_in_a_trace) {
  const Text text(
      "$timescale 10ns $end $scope module t $end $var wire 1 ! clk $end\n"
      "$scope module u $end $var wire 1 ! clk $end $upscope $end\n"
      "$attrbegin misc 07 e 2 idle run 00 01 1 $end $attrbegin misc 07 \"\" 1 $end\n"
      "$var reg 2 \" s [1:0] $end $var event 1 # go $end $var string 1 $ w $end\n"
      "$upscope $end $enddefinitions $end\n#1 0! b0 \" #2 1! 1! b00 \" 1# #3 0! 1# #5\n");
  TraceFile file(text.file);
  const std::string expected = text.file +
                               ": steps of 10 ns, 10 ns to 50 ns, 5 signals, 6 values\n"
                               "t.clk  1 bit  3 values\nt.u.clk  1 bit  = t.clk\n"
                               "t.s  2 bits  1 value  idle run\nt.go  event  2 values\n"
                               "t.w  text  0 values\n";
  BOOST_TEST(Listing(file, vp::TraceFilter(std::vector<std::string>{})).text() == expected);
  const Text empty(one);
  TraceFile none(empty.file);
  BOOST_TEST(Listing(none, vp::TraceFilter(std::vector<std::string>{})).text() ==
             empty.file + ": steps of 1 ns, no values, 1 signal, 0 values\na  1 bit  0 values\n");
  BOOST_TEST(exact_time(1000, 0) == "1 ns");
  BOOST_TEST(exact_time(0, 300) == "300 fs");
  BOOST_TEST(exact_time(2000, 5) == "2 ns 5 fs");
}

BOOST_AUTO_TEST_CASE(a_value_is_counted_if_it_is_another_one) {
  const Text text(
      "$timescale 1ns $end $var wire 1 ! a $end $var wire 4 \" v $end $var real 64 # r $end\n"
      "$enddefinitions $end #0 1! bx \" r2.50 # #1 H! bxxxx \" r2.5 # #2 h! b00x \" r-2.5 #\n"
      "#3 L! b0x \" #4 0! b01 \" #5 b1 \"\n");
  TraceFile file(text.file);
  const std::string listed = Listing(file, vp::TraceFilter(std::vector<std::string>{})).text();
  BOOST_TEST(listed.find("a  1 bit  4 values\n") != std::string::npos, listed);
  BOOST_TEST(listed.find("v  4 bits  3 values\n") != std::string::npos, listed);
  BOOST_TEST(listed.find("r  real  2 values\n") != std::string::npos, listed);
}

BOOST_AUTO_TEST_CASE(a_cut_file_is_read_to_the_cut_by_every_tool) {
  const Text text(
      "$timescale 1ns $end $var wire 8 ! a $end $enddefinitions $end\n"
      "#0 b0 ! #10 b1 ! #20 b101");
  const auto warns = [](const TraceFile& file) {
    const auto warnings = warnings_of(file);
    return warnings.size() == 1 &&
           warnings[0].find("was cut off in the middle") != std::string::npos;
  };
  TraceFile listed(text.file);
  BOOST_TEST(Listing(listed, vp::TraceFilter(std::vector<std::string>{})).last() == "20 ns");
  BOOST_TEST(warns(listed));
  TraceFile copied(text.file);
  cut(copied, text.folder / "o.vcd");
  BOOST_TEST(warns(copied));
  BOOST_TEST(WaveText(text.folder / "o.vcd").value("a", 20'000) == "1");
  TraceFile drawn(text.file);
  PlotOptions plot;
  plot.signals = {"a"};
  plot.to_ps = 20'000;
  BOOST_TEST(plot_as_svg(drawn, plot).find("</svg>") != std::string::npos);
  BOOST_TEST(warns(drawn));
  TraceFile a(text.file), b(text.folder / "o.vcd");
  BOOST_TEST(!difference(a, b).differ);
  BOOST_TEST(warns(a));
  BOOST_TEST(judged(text.file, "n: never a == 1\n")[0].failures == 1u);
}

BOOST_AUTO_TEST_CASE(ports_of_a_bitwise_trace_and_of_nine_states_compare) {
  const Text ours(
      "$timescale 1ns $end $var wire 1 ! clk $end $var wire 1 \" in $end\n"
      "$var wire 2 # q [1:0] $end $enddefinitions $end\n"
      "#0 0! 0\" b0x # #5 1! #10 0! 1\" b10 # #15 1! #20 0! 0\" #25 1! #30 0!\n");
  const Text theirs(
      "$timescale 1ns $end $var wire 1 ! clk $end $var wire 1 \" in $end\n"
      "$var wire 1 # q [1] $end $var wire 1 $ q [0] $end $enddefinitions $end\n"
      "#0 L! 0\" 0# U$ #5 H! #10 L! 1\" H# L$ #15 H! #20 L! 0\" #25 H! #30 L!\n");
  kit::write_file(ours.folder / "map.yaml",
                  "clock: {ours: clk, theirs: clk}\ninputs:\n  in: in\noutputs:\n  q: q\n");
  PortMap map = read_port_map(ours.folder / "map.yaml");
  BOOST_TEST(compare_ports(theirs.file, ours.file, map).values.empty());
  const Text wrong(
      "$timescale 1ns $end $var wire 1 ! clk $end $var wire 1 \" in $end\n"
      "$var wire 1 # q [1] $end $var wire 1 $ q [0] $end $enddefinitions $end\n"
      "#0 L! 0\" 0# U$ #5 H! #10 L! 1\" H# H$ #15 H! #20 L! 0\" #25 H! #30 L!\n");
  const PortComparison found = compare_ports(wrong.file, ours.file, map);
  BOOST_REQUIRE(found.values.size() == 1u);
  BOOST_TEST(found.values[0].theirs == "0x3");
}

BOOST_AUTO_TEST_SUITE_END()
