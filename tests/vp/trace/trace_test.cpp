// What is in a trace, with which names, values and times.
#include <boost/test/unit_test.hpp>

#include "counter_platform.h"

namespace {

std::string names(const std::string& text) {
  const VcdCheck vcd(text);
  std::string list;
  for (const auto& [path, variable] : vcd.variables()) list += path + " ";
  return list;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(trace, TraceFixture)

BOOST_AUTO_TEST_CASE(the_file_is_exactly_this) {
  BOOST_TEST(run(52'000) ==
             "$version markervp $end\n"
             "$timescale 1ps $end\n"
             "$scope module top $end\n"
             "$scope module fast $end\n"
             "$var wire 4 ! count [3:0] $end\n"
             "$var wire 1 \" odd $end\n"
             "$upscope $end\n"
             "$scope module slow $end\n"
             "$var wire 4 # count [3:0] $end\n"
             "$var wire 1 $ odd $end\n"
             "$upscope $end\n"
             "$upscope $end\n"
             "$enddefinitions $end\n"
             "#0\n"
             "$dumpvars\n"
             "b0 !\n"
             "0\"\n"
             "b0 #\n"
             "0$\n"
             "$end\n"
             "#10000\n"
             "b1 !\n"
             "1\"\n"
             "#20000\n"
             "b10 !\n"
             "0\"\n"
             "#25000\n"
             "b1 #\n"
             "1$\n"
             "#30000\n"
             "b11 !\n"
             "1\"\n"
             "#40000\n"
             "b100 !\n"
             "0\"\n"
             "#50000\n"
             "b101 !\n"
             "1\"\n"
             "b10 #\n"
             "0$\n"
             "#52000\n");
}

BOOST_AUTO_TEST_CASE(the_level_of_registers_shows_probes_too) {
  options.level = vp::TraceLevel::registers;
  options.filter = vp::TraceFilter({"top.fast"});
  const VcdCheck vcd(run(52'000, 4));
  BOOST_TEST(vcd.variables().size() == 6u);
  BOOST_TEST(vcd.variable("top.fast.state").type == "reg");
  BOOST_TEST(vcd.variable("top.fast.state").width == 2u);
  BOOST_TEST(vcd.variable("top.fast.half").type == "real");
  BOOST_TEST(vcd.value("top.fast.square_1", 29'999) == "1");
  BOOST_TEST(vcd.value("top.fast.square_1", 30'000) == "1001");
  BOOST_TEST(vcd.value("top.fast.square_0", 40'000) == "10000");
  BOOST_TEST(vcd.value("top.fast.half", 30'000) == "1.5");
  BOOST_TEST(vcd.value("top.fast.state", 49'999) == "1");
  BOOST_TEST(vcd.value("top.fast.state", 50'000) == "10");
}

BOOST_AUTO_TEST_CASE(the_filter_selects) {
  options.filter = vp::TraceFilter({"**.odd", "-top.slow"});
  BOOST_TEST(names(run(20'000)) == "top.fast.odd ");
}

BOOST_AUTO_TEST_CASE(two_runs_give_the_same_bytes) {
  options.level = vp::TraceLevel::registers;
  options.clocks = true;
  const std::string first = run(1'000'000, 30);
  kit::Simulation again;
  BOOST_TEST(run(1'000'000, 30) == first);
}

BOOST_AUTO_TEST_CASE(one_activation_for_many_edges_changes_nothing) {
  options.level = vp::TraceLevel::registers;
  options.clocks = true;
  const std::string one_by_one = run(1'000'000, 30);
  const auto traced = [](const std::string& text) { return text.substr(0, text.rfind('#')); };
  kit::Simulation again;
  Platform platform(options, 30);
  platform.scheduler.set_batch(true);
  sc_core::sc_start(sc_core::sc_time(1, sc_core::SC_US));
  platform.tracer.close();
  const std::string batch = text();
  const VcdCheck a(one_by_one), b(batch);
  for (const auto& [path, variable] : a.variables()) {
    if (path.find("clock") != std::string::npos) continue;
    BOOST_TEST((variable.changes == b.variable(path).changes), path);
  }
  BOOST_TEST(batch.compare(0, traced(one_by_one).size(), traced(one_by_one)) == 0);
}

BOOST_AUTO_TEST_CASE(a_signal_that_changes_often_in_an_instant_shows_its_last_value) {
  const VcdCheck vcd(run(40'000, 1000, [](Platform& platform) {
    // At 20 ns, after the edge: odd is 0.
    platform.fast.odd = true;
    platform.fast.odd = false;
    platform.slow.odd = true;
    platform.slow.odd = false;
    platform.slow.odd = true;
  }));
  BOOST_TEST(vcd.value("top.fast.odd", 20'000) == "0");
  BOOST_TEST(vcd.value("top.slow.odd", 19'999) == "0");
  BOOST_TEST(vcd.value("top.slow.odd", 20'000) == "1");
}

BOOST_AUTO_TEST_CASE(what_a_process_writes_between_the_edges_stands_at_its_time) {
  const VcdCheck vcd(run(46'000, 1000, [](Platform& platform) {
    platform.slow.count = 9;  // at 23 ns
  }));
  BOOST_TEST(vcd.value("top.slow.count", 22'999) == "0");
  BOOST_TEST(vcd.value("top.slow.count", 23'000) == "1001");
  BOOST_TEST(vcd.value("top.slow.count", 25'000) == "1");
}

BOOST_AUTO_TEST_CASE(a_trace_does_not_change_the_run) {
  std::uint8_t traced = 0;
  options.clocks = true;
  options.level = vp::TraceLevel::registers;
  options.from_ps = 100'000;
  options.to_ps = 200'000;
  run(446'000, 1000, [&](Platform& platform) { traced = platform.fast.count; });
  BOOST_TEST(traced == 22u);
}

BOOST_AUTO_TEST_CASE(standard_signals_of_foreign_modules_are_traced_like_ours) {
  struct Foreign : sc_core::sc_module {
    explicit Foreign(sc_core::sc_module_name name) : sc_module(name) {
      SC_HAS_PROCESS(Foreign);
      SC_METHOD(run);
    }
    void run() {
      if (step == 0) next_trigger(7, sc_core::SC_NS);
      if (step == 1) {
        valid = true;
        word = 0xabcd;
        next_trigger(8, sc_core::SC_NS);
      }
      if (step == 2) {
        valid = false;
        level = -1;
      }
      ++step;
    }
    int step = 0;
    sc_core::sc_signal<bool> valid{"valid"};
    sc_core::sc_signal<std::uint32_t> word{"word"};
    sc_core::sc_signal<std::int32_t> level{"level"};
    sc_core::sc_signal<double> not_shown{"not_shown"};
  };
  Foreign foreign("foreign");
  options.filter = vp::TraceFilter({"foreign", "top.fast.count"});
  const VcdCheck vcd(run(20'000));
  BOOST_TEST(vcd.variables().size() == 4u);
  BOOST_TEST(vcd.value("foreign.valid", 6'999) == "0");
  BOOST_TEST(vcd.value("foreign.valid", 7'000) == "1");
  BOOST_TEST(vcd.value("foreign.valid", 15'000) == "0");
  BOOST_TEST(vcd.value("foreign.word", 7'000) == "1010101111001101");
  BOOST_TEST(vcd.value("foreign.level", 15'000) == std::string(32, '1'));
}

BOOST_AUTO_TEST_SUITE_END()
