// Decoding, evaluation, rectification, identification and POSIT on the golden frames: the Cortex-A9
// computes what the host computes, to the last bit.
#include <boost/test/unit_test.hpp>

#include <algorithm>

#include "native_console.h"
#include "qemu.h"

namespace {

const std::vector<std::string>& native() {
  static const std::vector<std::string> lines = native_console(MARKERVP_ALGORITHMS);
  return lines;
}

long count(const std::string& beginning) {
  return std::count_if(native().begin(), native().end(),
                       [&](const std::string& line) { return line.rfind(beginning, 0) == 0; });
}

void check_equal(const std::vector<std::string>& chip) {
  BOOST_CHECK_EQUAL_COLLECTIONS(chip.begin(), chip.end(), native().begin(), native().end());
}

}  // namespace

BOOST_AUTO_TEST_SUITE(chip_algorithms)

// Otherwise two empty outputs would be equal, too.
BOOST_AUTO_TEST_CASE(the_golden_frames_have_something_to_compute) {
  BOOST_CHECK_EQUAL(count("algorithms: "), 3);
  BOOST_CHECK_EQUAL(count(" marker 1"), 3);
  BOOST_CHECK_GT(count(" candidate "), 20);
  BOOST_CHECK_EQUAL(count("  pose 1"), count(" candidate ") + count(" marker 1"));
  BOOST_CHECK_GT(count("  pose 1 iterations "), 20);
}

BOOST_AUTO_TEST_CASE(user_mode_gives_the_same_bits) {
  const ChipRun run = run_hosted("algorithms_hosted");
  BOOST_CHECK_EQUAL(run.exit_code, 0);
  check_equal(run.lines);
}

BOOST_AUTO_TEST_CASE(the_booted_chip_gives_the_same_bits) {
  const ChipRun run = boot("algorithms");
  BOOST_CHECK_EQUAL(run.exit_code, 0);
  check_equal(run.lines);
  BOOST_REQUIRE_EQUAL(run.messages.size(), 2);
  BOOST_CHECK_EQUAL(run.messages[0], "chip: algorithms");
  BOOST_CHECK_EQUAL(run.messages[1], "chip: ended with 0");
}

BOOST_AUTO_TEST_SUITE_END()
