#include <vp/unit.h>

#include <boost/test/unit_test.hpp>
#include <clocale>

#include "input_error.h"

using vp::Unit;

namespace {

/// The value in base units.
std::string base(const char* text, Unit unit) {
  return vp::parse_quantity(text, unit).text();
}

std::string refusal(const char* text, Unit unit) {
  return input_error([&] { vp::parse_quantity(text, unit); });
}

/// The value as it is printed.
std::string printed(const char* text, Unit unit) {
  return vp::format_quantity(vp::parse_quantity(text, unit), unit);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(unit)

BOOST_AUTO_TEST_CASE(reads_every_unit) {
  BOOST_TEST(base("7 Hz", Unit::frequency) == "7");
  BOOST_TEST(base("7 kHz", Unit::frequency) == "7000");
  BOOST_TEST(base("50 MHz", Unit::frequency) == "50000000");
  BOOST_TEST(base("1.2 GHz", Unit::frequency) == "1200000000");
  BOOST_TEST(base("3 ps", Unit::time) == "3");
  BOOST_TEST(base("60 ns", Unit::time) == "60000");
  BOOST_TEST(base("6144.6 us", Unit::time) == "6144600000");
  BOOST_TEST(base("1 \u00b5s", Unit::time) == "1000000");
  BOOST_TEST(base("1 \u03bcs", Unit::time) == "1000000");
  BOOST_TEST(base("5 ms", Unit::time) == "5000000000");
  BOOST_TEST(base("2 s", Unit::time) == "2000000000000");
  BOOST_TEST(base("64 B", Unit::bytes) == "64");
  BOOST_TEST(base("1.5 KiB", Unit::bytes) == "1536");
  BOOST_TEST(base("8 MiB", Unit::bytes) == "8388608");
  BOOST_TEST(base("1 GiB", Unit::bytes) == "1073741824");
  BOOST_TEST(base("24 px", Unit::pixels) == "24");
  BOOST_TEST(base("0.3 m", Unit::length) == "0.3");
  BOOST_TEST(base("60 mm", Unit::length) == "0.06");
  BOOST_TEST(base("2.2 um", Unit::length) == "0.0000022");
  BOOST_TEST(base("1.5 W", Unit::power) == "1.5");
  BOOST_TEST(base("300 mW", Unit::power) == "0.3");
  BOOST_TEST(base("20 pJ", Unit::energy) == "2e-11");
  BOOST_TEST(base("2 J", Unit::energy) == "2");
  BOOST_TEST(base("1 V", Unit::voltage) == "1");
  BOOST_TEST(base("12 cycles", Unit::cycles) == "12");
  BOOST_TEST(base("1 cycle", Unit::cycles) == "1");
  BOOST_TEST(base("50 %", Unit::percent) == "50");
  BOOST_TEST(base("-30 deg", Unit::angle) == "-30");
  BOOST_TEST(base("-40 C", Unit::temperature) == "-40");
  BOOST_TEST(base("-3", Unit::none) == "-3");
  BOOST_TEST(base("0x43c00000", Unit::address) == "1136656384");
}

BOOST_AUTO_TEST_CASE(white_space_is_free) {
  BOOST_TEST(base("50MHz", Unit::frequency) == "50000000");
  BOOST_TEST(base("  50   MHz ", Unit::frequency) == "50000000");
  BOOST_TEST(base("1e3px", Unit::pixels) == "1000");
}

BOOST_AUTO_TEST_CASE(fractions_are_exact) {
  BOOST_TEST(base("33.333333 MHz", Unit::frequency) == "33333333");
  BOOST_TEST(base("148.5 MHz", Unit::frequency) == "148500000");
  BOOST_TEST(base("666.666667 MHz", Unit::frequency) == "666666667");
}

BOOST_AUTO_TEST_CASE(an_exponent_is_not_a_unit) {
  BOOST_TEST(refusal("1 e3px", Unit::pixels) == "has the wrong unit 'e3px': write it in px");
}

BOOST_AUTO_TEST_CASE(a_missing_unit_names_the_units) {
  BOOST_TEST(refusal("50", Unit::frequency) == "has no unit: write it in Hz, kHz, MHz or GHz");
  BOOST_TEST(refusal("50", Unit::time) == "has no unit: write it in ps, ns, us, ms or s");
  BOOST_TEST(refusal("0", Unit::pixels) == "has no unit: write it in px");
}

BOOST_AUTO_TEST_CASE(a_wrong_unit_names_the_allowed_ones) {
  BOOST_TEST(refusal("50 px", Unit::frequency) ==
             "has the wrong unit 'px': write it in Hz, kHz, MHz or GHz");
  BOOST_TEST(refusal("50 mhz", Unit::frequency) ==
             "has the wrong unit 'mhz': write it in Hz, kHz, MHz or GHz");
  BOOST_TEST(refusal("5 KB", Unit::bytes) ==
             "has the wrong unit 'KB': write it in B, KiB, MiB or GiB");
  BOOST_TEST(refusal("50 px", Unit::none) == "has a unit 'px': write a plain number");
}

BOOST_AUTO_TEST_CASE(no_number_is_an_error) {
  BOOST_TEST(refusal("", Unit::none) == "is not a number");
  BOOST_TEST(refusal("MHz", Unit::frequency) ==
             "is not a number: write a number and Hz, kHz, MHz or GHz");
  BOOST_TEST(refusal("1.2.3 px", Unit::pixels) == "is not a number: write a number and px");
  BOOST_TEST(refusal("0x", Unit::address) == "is not a number");
}

BOOST_AUTO_TEST_CASE(prints_readable_values) {
  BOOST_TEST(printed("50 MHz", Unit::frequency) == "50 MHz");
  BOOST_TEST(printed("27000 kHz", Unit::frequency) == "27 MHz");
  BOOST_TEST(printed("148.5 MHz", Unit::frequency) == "148.5 MHz");
  BOOST_TEST(printed("33333333 Hz", Unit::frequency) == "33.333333 MHz");
  BOOST_TEST(printed("999 Hz", Unit::frequency) == "999 Hz");
  BOOST_TEST(printed("0 GHz", Unit::frequency) == "0 Hz");
  BOOST_TEST(printed("1500 ps", Unit::time) == "1.5 ns");
  BOOST_TEST(printed("0.06 m", Unit::length) == "60 mm");
  BOOST_TEST(printed("1536 B", Unit::bytes) == "1536 B");
  BOOST_TEST(printed("2048 B", Unit::bytes) == "2 KiB");
  BOOST_TEST(printed("0 B", Unit::bytes) == "0 B");
  BOOST_TEST(printed("0.5 pJ", Unit::energy) == "0.5 pJ");
  BOOST_TEST(printed("1 cycle", Unit::cycles) == "1 cycles");
  BOOST_TEST(printed("-12.5", Unit::none) == "-12.5");
  BOOST_TEST(printed("0", Unit::address) == "0x00000000");
  BOOST_TEST(printed("0x43C00000", Unit::address) == "0x43c00000");
  BOOST_TEST(printed("0x123456789", Unit::address) == "0x123456789");
  BOOST_TEST(vp::format_time(12'345'000) == "12.345 us");
  BOOST_TEST(vp::format_time(~std::uint64_t{0}) == "18446744.073709551615 s");
}

BOOST_AUTO_TEST_CASE(what_is_printed_reads_back) {
  for (const char* text : {"1 Hz", "999.999999 MHz", "123456789012.5 GHz", "-0.001 Hz"}) {
    const vp::Decimal value = vp::parse_quantity(text, Unit::frequency);
    BOOST_TEST(base(vp::format_quantity(value, Unit::frequency).c_str(), Unit::frequency) ==
               value.text());
  }
}

BOOST_AUTO_TEST_CASE(literals_are_in_base_units) {
  using namespace vp::literals;
  static_assert(50_MHz == 50'000'000);
  static_assert(60_ns == 60'000);
  static_assert(8_MiB == 8'388'608);
  static_assert(2_s == 2'000 * 1_ms);
}

BOOST_AUTO_TEST_CASE(every_dimension_has_a_base_unit_or_is_plain) {
  BOOST_TEST(vp::base_unit(Unit::frequency) == "Hz");
  BOOST_TEST(vp::base_unit(Unit::time) == "ps");
  BOOST_TEST(vp::base_unit(Unit::energy) == "J");
  BOOST_TEST(vp::base_unit(Unit::none) == "");
  BOOST_TEST(vp::allowed_units(Unit::address).empty());
}

BOOST_AUTO_TEST_SUITE_END()
