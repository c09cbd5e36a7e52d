// What a user may get wrong, and runs that end badly.
#include <vp/error.h>

#include <vp/report.h>
#include <boost/test/unit_test.hpp>
#include <sstream>

#include "counter_platform.h"
#include "input_error.h"

BOOST_FIXTURE_TEST_SUITE(trace_error, TraceFixture)

BOOST_AUTO_TEST_CASE(a_file_that_cannot_be_written_is_refused_before_the_run) {
  options.file = folder / "missing/out.vcd";
  BOOST_TEST(input_error([&] { Platform platform(options); }).find("cannot write '") == 0u);
}

BOOST_AUTO_TEST_CASE(a_window_must_not_be_reversed_or_empty) {
  options.from_ps = 20'000;
  options.to_ps = 10'000;
  BOOST_TEST(input_error([&] { Platform platform(options); }) ==
             "the trace window from 20000 ps to 10000 ps is empty; its end must come later");
  kit::Simulation again;
  options.to_ps = 20'000;
  BOOST_TEST(input_error([&] { Platform platform(options); }).find("is empty") !=
             std::string::npos);
  BOOST_TEST(folder.entries().size() == 0u);
}

BOOST_AUTO_TEST_CASE(a_filter_without_a_match_stops_the_run_at_its_start) {
  options.filter = vp::TraceFilter({"top.fats.*"});
  BOOST_TEST(input_error([&] { run(1'000'000); }) ==
             "trace filter 'top.fats.*' matches no signal; below 'top' there are fast, slow");
  BOOST_TEST(sc_core::sc_time_stamp() == sc_core::SC_ZERO_TIME);
  BOOST_TEST(folder.entries().size() == 0u);
}

BOOST_AUTO_TEST_CASE(a_register_at_the_level_of_ports_is_named) {
  options.filter = vp::TraceFilter({"top.fast.state"});
  BOOST_TEST(input_error([&] { run(1'000'000); }) ==
             "trace filter 'top.fast.state' matches registers only; choose the trace level that "
             "shows registers");
}

BOOST_AUTO_TEST_CASE(a_trace_closed_after_an_error_is_complete) {
  struct Failing : sc_core::sc_module {
    explicit Failing(sc_core::sc_module_name name) : sc_module(name) {
      SC_HAS_PROCESS(Failing);
      SC_METHOD(run);
    }
    void run() {
      next_trigger(25, sc_core::SC_NS);
      if (sc_core::sc_time_stamp() > sc_core::SC_ZERO_TIME) {
        SC_REPORT_ERROR("/markervp/test", "on purpose");
      }
    }
  };
  Failing failing("failing");
  Platform platform(options);
  BOOST_CHECK_THROW(sc_core::sc_start(sc_core::sc_time(1, sc_core::SC_US)), sc_core::sc_report);
  platform.tracer.close();
  const VcdCheck vcd(text());
  BOOST_TEST(vcd.value("top.fast.count", 20'000) == "10");
  BOOST_TEST(vcd.end_ps() == 25'000u);
  BOOST_TEST(vcd.comment().empty());
}

BOOST_AUTO_TEST_CASE(a_trace_that_nobody_closed_is_kept_and_marked) {
  std::ostringstream console;
  vp::ReportRouter router;
  router.redirect(console);
  {
    Platform platform(options);
    sc_core::sc_start(sc_core::sc_time(25, sc_core::SC_NS));
  }
  BOOST_TEST(router.count("/markervp/trace/incomplete") == 1u);
  BOOST_TEST(VcdCheck(text()).comment().find("incomplete") == 0u);
}

BOOST_AUTO_TEST_CASE(a_run_that_never_started_leaves_no_file) {
  {
    Platform platform(options);
    platform.tracer.close();
  }
  BOOST_TEST(folder.entries().size() == 0u);
}

BOOST_AUTO_TEST_CASE(a_full_disk_ends_the_run_and_close_tells_why) {
  options.file = "/dev/full";
  options.clocks = true;
  Platform platform(options, 1'000'000'000);
  sc_core::sc_start(sc_core::sc_time(1, sc_core::SC_SEC));
  BOOST_TEST(sc_core::sc_get_status() == sc_core::SC_STOPPED);
  BOOST_TEST(input_error([&] { platform.tracer.close(); }) ==
             "cannot write '/dev/full': No space left on device; make room, or write less");
}

BOOST_AUTO_TEST_SUITE_END()
