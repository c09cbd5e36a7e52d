// Linux applications of the package, on the installed executable.
#include <boost/test/unit_test.hpp>

#include "installation.h"

using namespace install_test;

BOOST_AUTO_TEST_SUITE(linux_applications)

BOOST_AUTO_TEST_CASE(both_examples) {
  const Installation& installed = Installation::get();
  installed.build(installed / "share/markervp/examples/05_linux_program", "linux");
  const auto run = [&](const std::string& application) {
    const kit::Outcome outcome = installed.markervp(
        {"run", "--linux", "linux/" + application, "--output", "out_" + application});
    BOOST_TEST(outcome.exit_code == 0, outcome.err);
    BOOST_TEST(outcome.err == "");
    return outcome.out;
  };
  BOOST_TEST(contains(run("gpio"), "4 blinks in 4.1 ms"));
  BOOST_TEST(contains(run("features"), "4 corners and 1 blobs"));
}

BOOST_AUTO_TEST_SUITE_END()
