// Other platforms from the same models, built outside of the tree.
#include <boost/test/unit_test.hpp>

#include "installation.h"

using namespace install_test;

BOOST_AUTO_TEST_SUITE(platforms)

BOOST_AUTO_TEST_CASE(a_processing_system_with_logic_of_ones_own) {
  const Installation& installed = Installation::get();
  installed.build(installed / "share/markervp/examples/10_own_platform", "platform");
  const kit::Outcome outcome = installed.run(installed.beside("platform/loopback"), {});
  BOOST_TEST(outcome.exit_code == 0);
  BOOST_TEST(contains(outcome.out, "three packets of 1024 bytes out and back in "), outcome.out);
  BOOST_TEST(contains(outcome.out, "256 words came to the sink\n"), outcome.out);
  BOOST_TEST(contains(outcome.out, "passed\n"), outcome.out);
  BOOST_TEST(!contains(outcome.err, "failed"), outcome.err);
}

/// All libraries link, and the models of the PS run a program of the platform's own. Built for a
/// fixed address, the executable itself is where the DDR wants to be.
BOOST_AUTO_TEST_CASE(a_processor_needs_a_position_independent_executable) {
  const Installation& installed = Installation::get();
  installed.build(project("platforms"), "platforms");
  const kit::Outcome good = installed.run(installed.beside("platforms/processor"), {});
  BOOST_TEST(good.exit_code == 0, good.err);
  BOOST_TEST(contains(good.out, "hello from the program\nended with 5\n"), good.out);
  const std::string fixed = installed.beside("platforms/processor_fixed");
  const kit::Outcome bad = installed.run(fixed, {});
  BOOST_TEST(bad.exit_code == 2);
  BOOST_TEST(contains(bad.err, "occupied by " + fixed + " at 0x00400000"), bad.err);
  BOOST_TEST(contains(bad.err, "-pie"), bad.err);
}

BOOST_AUTO_TEST_SUITE_END()
