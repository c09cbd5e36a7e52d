// A program on both cores, from start to result: what it prints, takes and hears.
#include <boost/test/unit_test.hpp>

#include "executable.h"

using namespace integration;

namespace {

struct TwoCores : Workplace {
  kit::Outcome run_it(Arguments more = {}) const {
    more.insert(more.begin(), {"--program", "two-cores", "--no-pictures"});
    return run(more);
  }
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(two_cores, TwoCores)

// 20 items of 20 us, of which the second core does one in 22 us.
BOOST_AUTO_TEST_CASE(both_work_at_one_list) {
  const kit::Outcome alone = run_it({"--set", "sw.cores=1"});
  BOOST_TEST(contains(alone.out, "sum 2470, items 20 and 0, 406 us\n"), alone.out);
  const kit::Outcome both = run_it();
  BOOST_TEST(both.exit_code == 0, both.err);
  BOOST_TEST(both.err == "");
  BOOST_TEST(contains(both.out, "sum 2470, items 11 and 9, 223 us\n"), both.out);
  BOOST_TEST(result()["configuration"]["ps.cores"] == "2");
}

BOOST_AUTO_TEST_CASE(the_second_core_is_there_for_who_starts_it) {
  BOOST_TEST(run({"--program", "blink", "--no-pictures"}).exit_code == 0);
  BOOST_TEST(result()["configuration"]["ps.cores"] == "1");
  const kit::Outcome refused = run_it({"--set", "ps.cores=1"});
  BOOST_TEST(refused.exit_code == 3);
  BOOST_TEST(
      contains(refused.err, "hal_cpu_start(1): the platform has one core: set ps.cores to 2"),
      refused.err);
  BOOST_TEST(run_it({"--set", "ps.cores=3"}).exit_code == 2);
}

BOOST_AUTO_TEST_CASE(nothing_depends_on_how_it_is_simulated) {
  run_it();
  const Json end = result()["program_end"];
  for (const Arguments& otherwise :
       {Arguments{"--set", "ps.cpu.quantum=0 s"}, Arguments{"--set", "ps.cpu.quantum=1 s"},
        Arguments{"--set", "ps.poll_elision=false"}, Arguments{"--fidelity", "clocked"},
        Arguments{"--log-bus", *this / "bus.log"}}) {
    BOOST_TEST(run_it(otherwise).exit_code == 0);
    BOOST_TEST(result()["program_end"] == end);
  }
  const std::string log = kit::read_file(*this / "bus.log");
  BOOST_TEST(run_it({"--log-bus", *this / "again.log"}).exit_code == 0);
  BOOST_TEST((kit::read_file(*this / "again.log") == log));
  BOOST_TEST(contains(log, "  cpu  write  0xFFFFFFF0  ocm"));
  BOOST_TEST(contains(log, "  cpu1  write  0xF8F01F00  gic_distributor.ICDSGIR  0x00010001  OK"));
}

BOOST_AUTO_TEST_CASE(the_profile_has_both) {
  BOOST_TEST(run_it({"--software-profile", *this / "p.json"}).exit_code == 0);
  const std::string profile = kit::read_file(*this / "p.json");
  BOOST_TEST(contains(profile, "\"cpu1\""));
}

BOOST_AUTO_TEST_SUITE_END()
