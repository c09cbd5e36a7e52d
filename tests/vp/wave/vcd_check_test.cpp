// The reader that the other tests trust: each of its rules fires.
#include "vcd_check.h"

#include <boost/test/unit_test.hpp>

namespace {

const std::string head =
    "$version markervp $end\n$timescale 1ps $end\n"
    "$scope module top $end\n$var wire 1 ! a $end\n$var wire 4 \" b [3:0] $end\n$upscope $end\n"
    "$enddefinitions $end\n";
const std::string dump = "#10\n$dumpvars\n0!\nb0 \"\n$end\n";

bool is_bad(const std::string& text, const std::string& why) {
  try {
    VcdCheck check(text);
  } catch (const std::runtime_error& error) {
    BOOST_TEST_INFO(error.what());
    return std::string(error.what()).find(why) != std::string::npos;
  }
  return false;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(vcd_check)

BOOST_AUTO_TEST_CASE(reads_names_values_and_times) {
  const VcdCheck vcd(head + dump + "#20\n1!\n#30\nb101 \"\n#40\n");
  BOOST_TEST(vcd.variables().size() == 2u);
  BOOST_TEST(vcd.variable("top.b").width == 4u);
  BOOST_TEST(vcd.value("top.a", 19) == "0");
  BOOST_TEST(vcd.value("top.a", 20) == "1");
  BOOST_TEST(vcd.value("top.b", 9) == "none");
  BOOST_TEST(vcd.value("top.b", 1000) == "101");
  BOOST_TEST(vcd.start_ps() == 10u);
  BOOST_TEST(vcd.end_ps() == 40u);
}

BOOST_AUTO_TEST_CASE(refuses_what_the_writer_must_not_write) {
  BOOST_TEST(is_bad(head + dump + "#20\n1!", "line end"));
  BOOST_TEST(is_bad(head + dump + "#10\n1!\n", "does not rise"));
  BOOST_TEST(is_bad(head + dump + "#9\n1!\n", "does not rise"));
  BOOST_TEST(is_bad(head + dump + "#20\n0!\n", "does not change"));
  BOOST_TEST(is_bad(head + dump + "#20\n1$\n", "unknown identifier"));
  BOOST_TEST(is_bad(head + dump + "#20\nb1 !\n", "form"));
  BOOST_TEST(is_bad(head + dump + "#20\nb10101 \"\n", "digits"));
  BOOST_TEST(is_bad(head + dump + "#20\nb010 \"\n", "digits"));
  BOOST_TEST(is_bad(head + dump + "#20\nx!\n", "digits"));
  BOOST_TEST(is_bad(head + "#10\n1!\n", "before $dumpvars"));
  BOOST_TEST(is_bad(head + "#10\n$dumpvars\n0!\n$end\n", "every value"));
  BOOST_TEST(is_bad(head + "#10\n$dumpvars\n0!\n", "every value"));
  BOOST_TEST(is_bad(head + "#10\n$dumpvars\n0!\n1!\n$end\n", "two initial"));
  BOOST_TEST(is_bad("$timescale 1ns $end\n", "$timescale"));
  BOOST_TEST(is_bad("$date today $end\n", "unknown declaration"));
  BOOST_TEST(is_bad("$scope module a $end\n$enddefinitions $end\n", "$enddefinitions"));
  BOOST_TEST(is_bad("$var wire 4 ! b $end\n", "range"));
  BOOST_TEST(is_bad("$var wire 1 ! a $end\n$var wire 1 ! b $end\n", "twice"));
  BOOST_TEST(is_bad("$var wire 1 ! a $end\n$var wire 1 \" a $end\n", "twice"));
}

BOOST_AUTO_TEST_SUITE_END()
