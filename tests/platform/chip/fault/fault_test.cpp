// What `inject` may say.
#include <chip/fault/fault.h>

#include <boost/test/unit_test.hpp>
#include <string>

#include <vp/error.h>

using platform::Fault;
using platform::parse_faults;

namespace {

std::string refusal(const std::string& text) {
  try {
    parse_faults(text, "f.yaml");
    return "nothing thrown";
  } catch (const vp::InputError& error) {
    return error.what();
  }
}

bool refuses(const std::string& text, const std::string& part) {
  const std::string message = refusal(text);
  BOOST_TEST_MESSAGE(message);
  return message.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(faults)

BOOST_AUTO_TEST_CASE(each_key_is_read_in_its_unit) {
  const auto list = parse_faults(
      "[{what: slverr, where: axi_dma_0, access: 3, count: all, of: writes, address: 0x40400018},"
      " {what: late, where: pl.irq, by: 10 us, edge: 2, at: 1.5 ms},"
      " {what: clock, where: fclk_clk0, frequency: 25 MHz, at: 1 us},"
      " {what: torn, from: 100, bytes: 7, unit: 4}]",
      "f.yaml");
  BOOST_REQUIRE(list.size() == 4u);
  BOOST_TEST((list[0].what == Fault::What::slverr && list[0].of == Fault::Of::writes));
  BOOST_TEST(list[0].address == 0x40400018u);
  BOOST_TEST((list[0].nth == 3 && list[0].count == Fault::for_ever));
  BOOST_TEST((list[1].by_ps == 10'000'000u && list[1].nth == 2 && list[1].at_ps == 1'500'000'000u));
  BOOST_TEST((list[2].value == 25'000'000u && list[2].for_ps == Fault::for_ever));
  BOOST_TEST((list[3].address == 100u && list[3].bytes == 7u && list[3].nth == 4u));
  BOOST_TEST(list[3].text == "{what: torn, from: 100, bytes: 7, unit: 4}");
  BOOST_TEST(parse_faults("[" + list[3].text + "]", "again").front().bytes == 7u);
}

BOOST_AUTO_TEST_CASE(no_text_and_an_empty_list_are_no_faults) {
  BOOST_TEST(parse_faults("", "f.yaml").empty());
  BOOST_TEST(parse_faults("[]", "f.yaml").empty());
}

BOOST_AUTO_TEST_CASE(which_accesses_meet_it) {
  Fault fault;
  fault.nth = 2;
  fault.count = 3;
  BOOST_TEST((!fault.meets(1) && fault.meets(2) && fault.meets(4) && !fault.meets(5)));
  fault.count = Fault::for_ever;
  BOOST_TEST((!fault.meets(1) && fault.meets(1'000'000)));
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_refused_with_its_line) {
  BOOST_TEST(refuses("what: flip", "f.yaml:1: 'inject' is a list of faults"));
  BOOST_TEST(refuses("[\n{where: x}]", "f.yaml:2: a fault says 'what' goes wrong: slverr,"));
  BOOST_TEST(refuses("[{what: flop}]", "did you mean 'flip'?"));
  BOOST_TEST(refuses("[{what: slverr}]", "'slverr' needs 'where'"));
  BOOST_TEST(refuses("[{what: lost, where: a, bit: 3}]", "'lost' takes no 'bit': it takes where"));
  BOOST_TEST(refuses("[{what: flip, bit: 0, at: 1 us}]", "'flip' needs an 'address'"));
  BOOST_TEST(refuses("[{what: flip, bit: 0, at: 1, address: 0}]", "'1' for 'at' has no unit"));
  BOOST_TEST(refuses("[{what: flip, bit: -1, at: 1 us, address: 0}]", "'-1' for 'bit'"));
  BOOST_TEST(refuses("[{what: lost, where: a, edge: 0}]", "'edge' is at least 1"));
  BOOST_TEST(refuses("[{what: input, value: 256}]", "write 0 to 255"));
  BOOST_TEST(refuses("[{what: lost, where: a, wher: b}]", "unknown key 'wher' of a fault"));
  BOOST_TEST(refuses("[{what: lost, where: a, where: b}]", "'where' is listed twice"));
  BOOST_TEST(refuses("[{what: clock, where: a, frequency: 2 THz, at: 1 s}]", "'2 THz'"));
}

BOOST_AUTO_TEST_SUITE_END()
