// The waveforms of clocks, which have no wire in the platform.
#include <boost/test/unit_test.hpp>

#include "counter_platform.h"

namespace {

using Changes = std::vector<std::pair<std::uint64_t, std::string>>;

std::string as_text(const Changes& changes) {
  std::string text;
  for (const auto& [ps, value] : changes) text += value + "@" + std::to_string(ps) + " ";
  return text;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(trace_clock, TraceFixture)

BOOST_AUTO_TEST_CASE(rise_at_the_edges_and_fall_at_half_the_period) {
  options.clocks = true;
  const VcdCheck vcd(run(52'000));
  BOOST_TEST(as_text(vcd.variable("top.slow_clock").changes) == "0@0 1@25000 0@37500 1@50000 ");
  BOOST_TEST(as_text(vcd.variable("top.fast_clock").changes) ==
             "0@0 1@10000 0@15000 1@20000 0@25000 1@30000 0@35000 1@40000 0@45000 1@50000 ");
}

BOOST_AUTO_TEST_CASE(only_those_of_traced_modules) {
  options.clocks = true;
  options.filter = vp::TraceFilter({"top.slow"});
  const VcdCheck vcd(run(52'000));
  BOOST_TEST(vcd.has("top.slow_clock"));
  BOOST_TEST(!vcd.has("top.fast_clock"));
}

BOOST_AUTO_TEST_CASE(only_when_asked_for) {
  BOOST_TEST(!VcdCheck(run(52'000)).has("top.slow_clock"));
}

BOOST_AUTO_TEST_CASE(go_on_while_the_domain_sleeps) {
  options.clocks = true;
  const VcdCheck vcd(run(1'010'000, 2));
  BOOST_TEST(vcd.variable("top.slow_clock").changes.size() == 1u + 2 * 40 - 1);
  BOOST_TEST(vcd.value("top.slow_clock", 1'010'000) == "1");
}

BOOST_AUTO_TEST_CASE(follow_changes_of_the_frequency) {
  options.clocks = true;
  options.filter = vp::TraceFilter({"top.slow"});
  // At 30 ns, in the high phase; the domain sleeps by then or not.
  for (const unsigned limit : {0u, 1000u}) {
    kit::Simulation again;
    const VcdCheck vcd(run(
        60'000, limit, [](Platform& platform) { platform.slow_clock.set_frequency(50'000'000); }));
    BOOST_TEST(as_text(vcd.variable("top.slow_clock").changes) ==
               "0@0 1@25000 0@37500 1@50000 0@60000 ");
  }
  // Edges come before the old high phase is over, or just then.
  for (const unsigned period_ps : {5'000u, 7'500u}) {
    kit::Simulation again;
    const VcdCheck vcd(run(60'000, 1000, [&](Platform& platform) {
      platform.slow_clock.set_frequency(1'000'000'000'000 / period_ps);
    }));
    const std::uint64_t rise = 30'000 + period_ps;
    BOOST_TEST(vcd.value("top.slow_clock", rise - 2) == "1");
    BOOST_TEST(vcd.value("top.slow_clock", rise - 1) == "0");
    BOOST_TEST(vcd.value("top.slow_clock", rise) == "1");
  }
}

BOOST_AUTO_TEST_CASE(stand_still_when_stopped) {
  options.clocks = true;
  options.filter = vp::TraceFilter({"top.slow"});
  const VcdCheck vcd(
      run(60'000, 1000, [](Platform& platform) { platform.slow_clock.set_frequency(0); }));
  BOOST_TEST(as_text(vcd.variable("top.slow_clock").changes) == "0@0 1@25000 0@37500 ");
}

BOOST_AUTO_TEST_SUITE_END()
