// Processes measured from outside.
#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include "programs.h"
#include "temporary_files.h"

BOOST_AUTO_TEST_SUITE(process)

BOOST_AUTO_TEST_CASE(it_runs_in_the_folder_and_leaves_its_output_there) {
  const kit::TemporaryFolder folder;
  const auto result =
      bench::run_process({"/bin/sh", "-c", "echo out; echo said >&2; touch here"}, folder.path());
  BOOST_TEST(result.succeeded);
  BOOST_TEST(kit::read_file(folder / "stdout") == "out\n");
  BOOST_TEST(kit::read_file(folder / "stderr") == "said\n");
  BOOST_TEST(kit::read_file(folder / "here") == "");
  BOOST_TEST(result.usage.memory_mb > 0.0);
}

BOOST_AUTO_TEST_CASE(waiting_costs_no_processor_time_and_work_does) {
  const kit::TemporaryFolder folder;
  const auto idle = bench::run_process({"/bin/sh", "-c", "sleep 0.2"}, folder.path());
  const auto busy = bench::run_process(
      {"/bin/sh", "-c", "i=0; while [ $i -lt 200000 ]; do i=$((i + 1)); done"}, folder.path());
  BOOST_TEST(idle.usage.cpu_ms < busy.usage.cpu_ms);
}

BOOST_AUTO_TEST_CASE(a_failure_brings_the_last_line_said) {
  const kit::TemporaryFolder folder;
  const auto result = bench::run_process(
      {"/bin/sh", "-c", "echo first >&2; echo last >&2; echo >&2; exit 3"}, folder.path());
  BOOST_TEST(!result.succeeded);
  BOOST_TEST(result.message == "last");
  const auto killed = bench::run_process({"/bin/sh", "-c", "kill -9 $$"}, folder.path());
  BOOST_TEST(!killed.succeeded);
  BOOST_TEST(killed.message == "ended by signal 9");
}

BOOST_AUTO_TEST_CASE(a_program_that_is_not_there_is_refused) {
  const kit::TemporaryFolder folder;
  BOOST_CHECK_THROW(bench::run_process({"/no/such/program"}, folder.path()), std::runtime_error);
}

BOOST_AUTO_TEST_SUITE_END()
