// Time windows: from <= time < to, and nothing outside.
#include <vp/report.h>
#include <boost/test/unit_test.hpp>
#include <sstream>

#include "counter_platform.h"

namespace {

/// Every variable has the same value at every time from `from_ps` to `to_ps` - 1.
void check_is_cut_of(const VcdCheck& full, const VcdCheck& cut, std::uint64_t from_ps,
                     std::uint64_t to_ps) {
  BOOST_TEST(full.variables().size() == cut.variables().size());
  for (const auto& [path, variable] : cut.variables()) {
    BOOST_TEST(variable.changes.front().first == from_ps);
    BOOST_TEST(variable.changes.back().first < to_ps);
    for (std::uint64_t ps = from_ps; ps < to_ps; ps += 500) {
      BOOST_REQUIRE_MESSAGE(full.value(path, ps) == cut.value(path, ps),
                            path << " at " << ps << " ps");
    }
    BOOST_REQUIRE_EQUAL(full.value(path, to_ps - 1), cut.value(path, to_ps - 1));
  }
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(trace_window, TraceFixture)

BOOST_AUTO_TEST_CASE(shows_the_values_at_its_start_and_nothing_at_its_end) {
  options.from_ps = 20'000;
  options.to_ps = 40'000;
  options.filter = vp::TraceFilter({"top.fast.count"});
  const std::string trace = run(100'000);
  BOOST_TEST(trace.substr(trace.find('#')) ==
             "#20000\n$dumpvars\nb10 !\n$end\n#30000\nb11 !\n#40000\n");
}

BOOST_AUTO_TEST_CASE(any_window_is_a_cut_of_the_whole) {
  options.level = vp::TraceLevel::registers;
  options.clocks = true;
  const VcdCheck full(run(300'000));
  const std::pair<std::uint64_t, std::uint64_t> windows[] = {
      {0, 25'000},      {1, 10'000},      {9'999, 10'000},   {10'000, 10'001},  {12'500, 50'000},
      {33'000, 77'500}, {50'000, 75'000}, {62'500, 300'000}, {100'000, 100'500}};
  for (const auto& [from_ps, to_ps] : windows) {
    BOOST_TEST_CONTEXT(from_ps << " ps to " << to_ps << " ps") {
      kit::Simulation again;
      options.from_ps = from_ps;
      options.to_ps = to_ps;
      const VcdCheck cut(run(300'000));
      BOOST_TEST(cut.start_ps() == from_ps);
      BOOST_TEST(cut.end_ps() == to_ps);
      check_is_cut_of(full, cut, from_ps, to_ps);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_window_that_is_longer_than_the_run_ends_with_it) {
  options.from_ps = 20'000;
  options.to_ps = 1'000'000;
  BOOST_TEST(VcdCheck(run(33'000)).end_ps() == 33'000u);
}

BOOST_AUTO_TEST_CASE(after_the_window_nobody_listens_any_more) {
  options.to_ps = 20'000;
  options.clocks = true;
  Platform platform(options, 3);  // the fast counter sleeps from 40 ns on
  sc_core::sc_start(sc_core::sc_time(60, sc_core::SC_NS));
  const std::uint64_t edges = platform.fast_clock.edges_run();
  sc_core::sc_start(sc_core::sc_time(1, sc_core::SC_US));
  BOOST_TEST(platform.fast_clock.edges_run() == edges);
  BOOST_TEST(platform.tracer.close());
  BOOST_TEST(VcdCheck(text()).end_ps() == 20'000u);
  BOOST_TEST(!platform.tracer.close(), "a second time there is nothing to write");
}

BOOST_AUTO_TEST_CASE(a_run_that_ends_before_the_window_leaves_no_file_and_says_so) {
  options.from_ps = 50'000;
  Platform platform(options);
  std::ostringstream console;
  vp::ReportRouter router;
  router.redirect(console);
  sc_core::sc_start(sc_core::sc_time(40, sc_core::SC_NS));
  BOOST_TEST(!platform.tracer.close());
  BOOST_TEST(router.count("/markervp/trace/window") == 1u);
  BOOST_TEST(folder.entries().size() == 0u);
}

BOOST_AUTO_TEST_SUITE_END()
