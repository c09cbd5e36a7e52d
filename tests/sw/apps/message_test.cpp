#include <apps/common/message.h>

#include <boost/test/unit_test.hpp>

#include "fake_hal.h"

BOOST_AUTO_TEST_SUITE(message)

BOOST_AUTO_TEST_CASE(text_and_numbers) {
  fake_hal::reset();
  apps::Message()
      .text("a ")
      .number(0)
      .text(" ")
      .number(4'294'967'295u)
      .text(" ")
      .hexadecimal(0x40ABu)
      .write();
  BOOST_TEST(fake_hal::state().console == "a 0 4294967295 0x000040ab\n");
}

BOOST_AUTO_TEST_CASE(long_lines_are_cut) {
  fake_hal::reset();
  apps::Message line;
  for (int i = 0; i < 30; ++i) line.text("0123456789");
  line.write();
  BOOST_TEST(fake_hal::state().console.size() == 129u);
  line.text("next").write();
  BOOST_TEST(fake_hal::state().console.substr(129) == "next\n");
}

BOOST_AUTO_TEST_SUITE_END()
