// Programs with hardware, as far as QEMU's Zynq has it: vectors, interrupt controller, timer,
// console.
#include <boost/test/unit_test.hpp>

#include <algorithm>

#include "native_console.h"
#include "qemu.h"

BOOST_AUTO_TEST_SUITE(chip_programs)

// Static objects, options, DMA memory, interrupts asleep and awake, floating point across
// interrupts.
BOOST_AUTO_TEST_CASE(bring_up_prints_the_same_on_both) {
  const auto native = native_console(MARKERVP_BRING_UP, {{"sw.factor", "-2.25"}});
  const ChipRun run = boot("bring_up");
  BOOST_CHECK_EQUAL_COLLECTIONS(run.lines.begin(), run.lines.end(), native.begin(), native.end());
  BOOST_CHECK_EQUAL(run.exit_code, 7);
  const std::vector<std::string> messages = {"chip: bring_up", "chip: result TEST, 12 bytes",
                                             "chip: ended with 7"};
  BOOST_CHECK_EQUAL_COLLECTIONS(run.messages.begin(), run.messages.end(), messages.begin(),
                                messages.end());
  const auto has = [&](const char* line) {
    return std::count(run.lines.begin(), run.lines.end(), line);
  };
  BOOST_CHECK_EQUAL(has("constructed 23"), 1);
  BOOST_CHECK_EQUAL(has("factor 0xc0020000 0x00000000"), 1);
  BOOST_CHECK_EQUAL(has("masked 11 0, unmasked 1"), 1);
  BOOST_CHECK_EQUAL(has("undisturbed 1"), 3);
  BOOST_CHECK_EQUAL(has("unhandled 0"), 1);
}

BOOST_AUTO_TEST_CASE(a_program_in_the_style_of_a_board_support_package_prints_the_same_on_both) {
  const auto native = native_console(MARKERVP_BLINK);
  const ChipRun run = boot("blink");
  BOOST_CHECK_EQUAL_COLLECTIONS(run.lines.begin(), run.lines.end(), native.begin(), native.end());
  BOOST_CHECK_EQUAL(run.exit_code, 0);
  BOOST_REQUIRE_EQUAL(run.lines.size(), 5);
  BOOST_CHECK_EQUAL(run.lines[4], "GPIO at 41200000, alarms 1, unhandled 0");
}

// QEMU has no programmable logic: the DMA engine's registers read 0, which is neither idle nor
// halted.
BOOST_AUTO_TEST_CASE(hybrid_starts_gets_its_images_and_says_what_is_missing) {
  const ChipRun run = boot("hybrid");
  const std::vector<std::string> lines = {
      "hybrid: frame 0: DMA error during the upload, 640 x 480 px, 0 words, 0 packets, DMASR "
      "0x00000000 0x00000000",
      "frame 0: DMA error during the upload, 0 corners, 0 blobs, 0 markers, 0.000 ms",
      "hybrid: frame 1: DMA error during the upload, 640 x 480 px, 0 words, 0 packets, DMASR "
      "0x00000000 0x00000000",
      "frame 1: DMA error during the upload, 0 corners, 0 blobs, 0 markers, 0.000 ms"};
  BOOST_CHECK_EQUAL_COLLECTIONS(run.lines.begin(), run.lines.end(), lines.begin(), lines.end());
  BOOST_CHECK_EQUAL(run.exit_code, 1);
}

BOOST_AUTO_TEST_SUITE_END()
