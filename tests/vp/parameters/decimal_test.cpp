#include <vp/unit.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

using vp::Decimal;

namespace {

std::string reread(const char* text) {
  const auto value = Decimal::parse(text);
  return value ? value->text() : "nothing";
}

bool is_whole(const Decimal& value, Decimal::Whole expected) {
  return value.whole() && *value.whole() == expected;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(decimal)

BOOST_AUTO_TEST_CASE(reads_numbers) {
  BOOST_TEST(reread("12") == "12");
  BOOST_TEST(reread("0") == "0");
  BOOST_TEST(reread("-0") == "0");
  BOOST_TEST(reread("+7") == "7");
  BOOST_TEST(reread("007") == "7");
  BOOST_TEST(reread("-0.50") == "-0.5");
  BOOST_TEST(reread(".5") == "0.5");
  BOOST_TEST(reread("5.") == "5");
  BOOST_TEST(reread("148.5e6") == "148500000");
  BOOST_TEST(reread("1E-3") == "0.001");
  BOOST_TEST(reread("0x41200000") == "1092616192");
  BOOST_TEST(reread("18446744073709551615") == "18446744073709551615");
}

BOOST_AUTO_TEST_CASE(refuses_what_is_no_number) {
  for (const char* text :
       {"", ".", "-", "e5", "1e", "1e+", "1.2.3", "1,5", "12a", " 1", "0x", "0xg", "-0x10", "nan",
        "inf", "0x10000000000000000", "1e401", "1234567890123456789012345", "1e99999999999"}) {
    BOOST_TEST(reread(text) == "nothing", text << " was read as " << reread(text));
  }
}

BOOST_AUTO_TEST_CASE(keeps_whole_numbers_exact) {
  BOOST_TEST(is_whole(*Decimal::parse("33.333333e6"), 33'333'333));
  BOOST_TEST(is_whole(*Decimal::parse("-3"), -3));
  BOOST_TEST(is_whole(Decimal::parse("1.5")->scaled(1024, 0), 1536));
  BOOST_TEST(!Decimal::parse("0.5")->whole().has_value());
  BOOST_TEST(!Decimal::parse("33.3333333e6")->whole().has_value());
}

BOOST_AUTO_TEST_CASE(whole_numbers_beyond_all_types_saturate) {
  BOOST_TEST(is_whole(*Decimal::parse("1e300"), Decimal::Whole{1} << 100));
  BOOST_TEST(is_whole(*Decimal::parse("-1e300"), -(Decimal::Whole{1} << 100)));
}

BOOST_AUTO_TEST_CASE(doubles_come_back_bit_for_bit) {
  for (const double value :
       {0.0, 0.1, 0.3, 1.0 / 3.0, -2.5e-9, 1e22, 666.67e6, 5e-324, 1.7976931348623157e308}) {
    const auto again = Decimal::parse(Decimal(value).text());
    BOOST_REQUIRE(again.has_value());
    BOOST_TEST(again->to_double() == value);
  }
  BOOST_TEST(Decimal::parse("300")->scaled(1, -3).to_double() == 0.3);
}

BOOST_AUTO_TEST_CASE(doubles_out_of_range_are_infinite_or_zero) {
  BOOST_TEST(std::isinf(Decimal::parse("1e400")->to_double()));
  BOOST_TEST(Decimal::parse("-1e400")->to_double() < 0);
  BOOST_TEST(Decimal::parse("1e-400")->to_double() == 0.0);
}

BOOST_AUTO_TEST_CASE(not_a_number_has_no_decimal) {
  BOOST_CHECK_THROW(Decimal(std::nan("")), std::logic_error);
  BOOST_CHECK_THROW(Decimal(std::numeric_limits<double>::infinity()), std::logic_error);
}

BOOST_AUTO_TEST_CASE(very_large_and_small_are_written_with_an_exponent) {
  BOOST_TEST(reread("0.0000001") == "0.0000001");
  BOOST_TEST(reread("0.00000001") == "1e-8");
  BOOST_TEST(reread("1.25e-12") == "1.25e-12");
  BOOST_TEST(reread("1e19") == "10000000000000000000");
  BOOST_TEST(reread("-1.5e20") == "-1.5e20");
}

BOOST_AUTO_TEST_CASE(magnitude_is_the_power_of_the_leading_digit) {
  BOOST_TEST(Decimal::parse("148.5")->magnitude() == 2);
  BOOST_TEST(Decimal::parse("0.06")->magnitude() == -2);
  BOOST_TEST(Decimal::parse("-1000")->magnitude() == 3);
  BOOST_TEST(Decimal().magnitude() == 0);
}

BOOST_AUTO_TEST_SUITE_END()
