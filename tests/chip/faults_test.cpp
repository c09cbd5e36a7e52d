// What the chip refuses is said on the console and ends the program.
#include <boost/test/unit_test.hpp>

#include "qemu.h"

namespace {

/// Boots faulty_FAULT, which ends with `exit_code` after a message that begins with `message`.
void check_fault(const std::string& fault, int exit_code, const std::string& message) {
  BOOST_TEST_CONTEXT(fault) {
    const ChipRun run = boot("faulty_" + fault);
    BOOST_CHECK_EQUAL(run.exit_code, exit_code);
    BOOST_REQUIRE_EQUAL(run.messages.size(), 3);
    BOOST_CHECK_EQUAL(run.messages[1].substr(0, message.size()), message);
    BOOST_CHECK_EQUAL(run.messages[2], "chip: ended with " + std::to_string(exit_code));
    for (const std::string& line : run.lines) BOOST_CHECK_NE(line, "after");
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(chip_faults)

BOOST_AUTO_TEST_CASE(data_aborts) {
  check_fault("null_pointer", 3,
              "chip: data abort: write to 0x00000000: nothing is mapped there, status 0x00000805, "
              "pc 0x001");
  check_fault("unmapped", 3,
              "chip: data abort: read of 0xd0000000: nothing is mapped there, status 0x00000005, "
              "pc 0x001");
  check_fault("overflow", 3, "chip: data abort: write to 0x0f7f");
}

BOOST_AUTO_TEST_CASE(a_stack_overflow_is_called_so) {
  const ChipRun run = boot("faulty_overflow");
  BOOST_REQUIRE_GE(run.messages.size(), 2);
  BOOST_CHECK_NE(run.messages[1].find("stack overflow"), std::string::npos);
}

BOOST_AUTO_TEST_CASE(undefined_instruction) {
  check_fault("undefined", 3, "chip: undefined instruction, pc 0x001");
}

// DMA memory holds data: nothing there is executed.
BOOST_AUTO_TEST_CASE(jump_into_data) {
  check_fault("jump", 3,
              "chip: prefetch abort: not permitted, status 0x0000000d, pc 0x10000000, lr 0x001");
}

BOOST_AUTO_TEST_CASE(options) {
  check_fault("no_such_option", 3, "chip: hal_option(): no such option");
  check_fault("refused_option", 2,
              "chip: option faulty_refused_option.nothing: the program has no such option");
  check_fault("option_out_of_range", 2,
              "chip: option faulty_option_out_of_range.level: the value of MARKERVP_CHIP_OPTIONS "
              "is out of range");
}

BOOST_AUTO_TEST_SUITE_END()
