// xil_printf, print, outbyte.
#include <boost/test/unit_test.hpp>

#include <xil_printf.h>

#include <climits>
#include <string>

#include "fake_hal.h"

namespace {

struct Fixture {
  Fixture() { fake_hal::reset(); }
};

std::string printed() {
  return std::exchange(fake_hal::state().console, {});
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(xil_printf_, Fixture)

BOOST_AUTO_TEST_CASE(conversions) {
  xil_printf("%d %i %u %x %X %c %s %%\r\n", -12, 34, 56u, 0xabcu, 0xABCu, 'z', "text");
  BOOST_CHECK_EQUAL(printed(), "-12 34 56 ABC ABC z text %\r\n");
}

BOOST_AUTO_TEST_CASE(extremes) {
  xil_printf("%d %d %u %x %d", INT_MIN, INT_MAX, UINT_MAX, UINT_MAX, 0);
  BOOST_CHECK_EQUAL(printed(), "-2147483648 2147483647 4294967295 FFFFFFFF 0");
  xil_printf("%ld %lu %lx", LONG_MIN, ULONG_MAX, ULONG_MAX);
  BOOST_CHECK_EQUAL(printed(), "-9223372036854775808 18446744073709551615 FFFFFFFFFFFFFFFF");
  xil_printf("%p", reinterpret_cast<void*>(0x4120'0000));
  BOOST_CHECK_EQUAL(printed(), "41200000");
}

BOOST_AUTO_TEST_CASE(widths) {
  xil_printf("[%5d][%-5d][%05d][%2d][%08x][%-6s][%6s]", -42, -42, -42, 12345, 0xBEEFu, "ab", "cd");
  BOOST_CHECK_EQUAL(printed(), "[  -42][-42  ][00-42][12345][0000BEEF][ab    ][    cd]");
}

// Format strings of the vendor's own dialect.
BOOST_AUTO_TEST_CASE(precision_cuts_texts) {
  void (*const unchecked)(const char8*, ...) = &xil_printf;
  unchecked("[%.2s][%5.2s][%.*s]", "abcd", "abc", 3u, "abcd");
  BOOST_CHECK_EQUAL(printed(), "[ab][  ab][abc]");
  unchecked("%llx %lld", 0xABCD'0123'4567ull, -5ll);
  BOOST_CHECK_EQUAL(printed(), "ABCD01234567 -5");
  const char* volatile none = nullptr;
  unchecked("[%s]", none);
  BOOST_CHECK_EQUAL(printed(), "[]");
}

BOOST_AUTO_TEST_CASE(long_texts_arrive_completely) {
  const std::string text(1000, 'x');
  xil_printf("<%s>", text.c_str());
  BOOST_CHECK_EQUAL(printed(), "<" + text + ">");
}

BOOST_AUTO_TEST_CASE(plain_text) {
  print("100 %d\n");
  outbyte('!');
  BOOST_CHECK_EQUAL(printed(), "100 %d\n!");
}

// On purpose not what the compiler accepts as a format.
BOOST_AUTO_TEST_CASE(what_is_no_conversion) {
  void (*const unchecked)(const char8*, ...) = &xil_printf;
  unchecked("%f|%.2f|");
  unchecked("50 %");
  BOOST_CHECK_EQUAL(printed(), "||50 ");
}

BOOST_AUTO_TEST_SUITE_END()
