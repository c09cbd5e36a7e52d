#include <vp/unit.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <clocale>
#include <iterator>

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

/// How much each spelling of a unit is in the base unit.
struct Spelling {
  Unit unit;
  const char *text, *value;
};
constexpr Spelling spellings[] = {
    {Unit::frequency, "7 Hz", "7"},
    {Unit::frequency, "7 kHz", "7000"},
    {Unit::frequency, "50 MHz", "50000000"},
    {Unit::frequency, "1.2 GHz", "1200000000"},
    {Unit::time, "3 ps", "3"},
    {Unit::time, "60 ns", "60000"},
    {Unit::time, "6144.6 us", "6144600000"},
    {Unit::time, "1 \u00b5s", "1000000"},
    {Unit::time, "1 \u03bcs", "1000000"},
    {Unit::time, "5 ms", "5000000000"},
    {Unit::time, "2 s", "2000000000000"},
    {Unit::bytes, "64 B", "64"},
    {Unit::bytes, "1.5 KiB", "1536"},
    {Unit::bytes, "8 MiB", "8388608"},
    {Unit::bytes, "1 GiB", "1073741824"},
    {Unit::pixels, "24 px", "24"},
    {Unit::length, "2.2 um", "0.0000022"},
    {Unit::length, "2.2 \u00b5m", "0.0000022"},
    {Unit::length, "2.2 \u03bcm", "0.0000022"},
    {Unit::length, "60 mm", "0.06"},
    {Unit::length, "0.3 m", "0.3"},
    {Unit::power, "7 uW", "0.000007"},
    {Unit::power, "7 \u00b5W", "0.000007"},
    {Unit::power, "7 \u03bcW", "0.000007"},
    {Unit::power, "300 mW", "0.3"},
    {Unit::power, "1.5 W", "1.5"},
    {Unit::energy, "20 pJ", "2e-11"},
    {Unit::energy, "20 nJ", "2e-8"},
    {Unit::energy, "20 uJ", "0.00002"},
    {Unit::energy, "20 \u00b5J", "0.00002"},
    {Unit::energy, "20 \u03bcJ", "0.00002"},
    {Unit::energy, "20 mJ", "0.02"},
    {Unit::energy, "2 J", "2"},
    {Unit::voltage, "900 mV", "0.9"},
    {Unit::voltage, "1 V", "1"},
    {Unit::cycles, "12 cycles", "12"},
    {Unit::cycles, "1 cycle", "1"},
    {Unit::percent, "50 %", "50"},
    {Unit::angle, "-30 deg", "-30"},
    {Unit::angle, "-30 \u00b0", "-30"},
    {Unit::temperature, "-40 C", "-40"},
    {Unit::temperature, "-40 \u00b0C", "-40"},
};

BOOST_AUTO_TEST_CASE(reads_every_unit) {
  for (const Spelling& s : spellings) BOOST_TEST(base(s.text, s.unit) == s.value, s.text);
  BOOST_TEST(base("-3", Unit::none) == "-3");
  BOOST_TEST(base("0x43c00000", Unit::address) == "1136656384");
}

BOOST_AUTO_TEST_CASE(every_unit_that_is_offered_is_tested) {
  for (const Unit unit :
       {Unit::frequency, Unit::time, Unit::bytes, Unit::pixels, Unit::length, Unit::power,
        Unit::energy, Unit::voltage, Unit::cycles, Unit::percent, Unit::angle, Unit::temperature}) {
    for (const std::string& name : vp::allowed_units(unit)) {
      BOOST_TEST(std::any_of(std::begin(spellings), std::end(spellings),
                             [&](const Spelling& s) {
                               const std::string text = s.text;
                               return s.unit == unit && text.substr(text.find(' ') + 1) == name;
                             }),
                 name);
    }
  }
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
  BOOST_TEST(printed("0.9 V", Unit::voltage) == "900 mV");
  BOOST_TEST(printed("1000 mV", Unit::voltage) == "1 V");
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
