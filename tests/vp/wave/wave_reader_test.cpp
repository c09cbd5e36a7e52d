// What the reader makes of VCDs, good and bad.
#include <boost/test/unit_test.hpp>

#include "wave_kit.h"

namespace {

const std::string head =
    "$date today $end\n$version any $end\n$timescale 1ps $end\n"
    "$scope module top $end\n$var wire 1 ! a $end\n$var wire 8 \" b [7:0] $end\n"
    "$var real 64 # c $end\n$var string 1 $ d $end\n$upscope $end\n$enddefinitions $end\n";

std::vector<std::string> lines_of(const std::string& bytes) {
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "t.vcd", bytes);
  return WaveText(folder / "t.vcd").lines;
}

std::string with_timescale(const std::string& text) {
  return "$timescale " + text + " $end $var wire 1 ! a $end $enddefinitions $end #3 1! #4\n";
}

}  // namespace

BOOST_AUTO_TEST_SUITE(wave_reader)

BOOST_AUTO_TEST_CASE(values_come_with_time_and_name) {
  const auto lines = lines_of(head +
                              "#0\n$dumpvars\n0!\nb101 \"\nr2.5 #\nshello\\040there $\n$end\n"
                              "$comment 1! #99 $end\n#7\n1!\nbx1 \"\n#7\nX! s $\n#9\n");
  const std::vector<std::string> expected = {"0 top.a 0",           "0 top.b 101", "0 top.c 2.5",
                                             "0 top.d hello there", "7 top.a 1",   "7 top.b x1"};
  BOOST_TEST(lines.size() >= expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) BOOST_TEST(lines[i] == expected[i]);
}

BOOST_AUTO_TEST_CASE(words_may_stand_anywhere_between_white_space) {
  const auto lines = lines_of(head + "#0 0!\tb1\n\" #5\r\n1!\n");
  BOOST_TEST(lines.size() == 3u);
  BOOST_TEST(lines.back() == "5 top.a 1");
}

BOOST_AUTO_TEST_CASE(times_are_in_picoseconds_whatever_the_timescale) {
  BOOST_TEST(lines_of(with_timescale("244 ns")).front() == "732000 a 1");
  BOOST_TEST(lines_of(with_timescale("0.5 us")).front() == "1500000 a 1");
  BOOST_TEST(lines_of(with_timescale("10 ns")).front() == "30000 a 1");
  BOOST_TEST(lines_of(with_timescale("1us")).front() == "3000000 a 1");
  BOOST_TEST(lines_of(with_timescale("100fs")).front() == "0 a 1");
}

BOOST_AUTO_TEST_CASE(names_of_other_programs) {
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "t.vcd",
                  "$timescale 1ps $end $scope module i $end $var reg 4 ab1! bus[3:0] $end\n"
                  "$var wire 4 ab1! alias [3:0] $end $var wire 1 ~~~~ m[2] $end $upscope $end "
                  "$enddefinitions $end #0 b11 ab1! 1~~~~\n");
  const vp::WaveReader reader(folder / "t.vcd");
  BOOST_TEST(reader.nets() == 2u);
  BOOST_REQUIRE(reader.find("i.bus") != nullptr);
  BOOST_TEST(reader.find("i.bus")->net == reader.find("i.alias")->net);
  BOOST_TEST(reader.find("i.m[2]") != nullptr);
  BOOST_TEST(reader.find("i.none") == nullptr);
}

BOOST_AUTO_TEST_CASE(words_over_the_edge_of_the_window_are_whole) {
  // More than four windows, words of all lengths.
  std::string text = head;
  std::vector<std::string> expected;
  for (unsigned i = 0; text.size() < 5u << 19; ++i) {
    const std::string digits(1 + i % 8, '1');
    text += "#" + std::to_string(i) + "\nb" + digits + " \"\n";
    expected.push_back(std::to_string(i) + " top.b " + digits);
  }
  BOOST_TEST((lines_of(text) == expected));
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_said_with_its_line_and_byte) {
  const auto says = [](const std::string& bytes, const std::string& expected) {
    const std::string message = complaint(bytes);
    BOOST_TEST(message.find(expected) != std::string::npos, expected << " not in: " << message);
  };
  says("", ", line 1 (byte 0): the file ends in the middle of the header: it is truncated");
  says("hello\nworld\n", ", line 1 (byte 5): begins with 'hello': this is no VCD");
  says("\x89PNG\r\n", "this is no VCD");
  says("$timescale 1ps $end $scope module a", "middle of $scope");
  says(head.substr(0, 60), "it is truncated");
  says(with_timescale("1 parsec"), "the timescale '1parsec' is not a whole number of fs");
  says(with_timescale("0.1fs"), "is not a whole number of fs");
  says(with_timescale("0ns"), "is not a whole number of fs");
  says("$timescale 1ps $end $enddefinitions $end\n", "declares no signal");
  says("$timescale 1ps $end $upscope $end\n", "$upscope without $scope");
  says("$timescale 1ps $end $var wire 99999999 ! a $end\n", "is not 0 to 1048576");
  says("$timescale 1ps $end $var wire -1 ! a $end\n", "is not 0 to 1048576");
  says("$timescale 1ps $end $var wire 1 ! $end\n", "$var needs");
  says("$timescale 1ps $end $var wire 1 \xe4 a $end\n", "characters that are not printable");
  says(head + "#0\n0!\n1?\n", ", line 13 (byte " + std::to_string(head.size() + 8) +
                                  "): the identifier '?' was not declared");
  says(head + "#0\n1!!!!!!\n", "was not declared");
  says(head + "#0\n1\n", "a value without an identifier");
  says(head + "#5\n#4\n", "the time falls to 4");
  says(head + "#x\n", "the time 'x' is no number");
  says(head + "#1.5\n", "the time '1.5' is not whole");
  says(head + "#\n", "the time '' is no number");
  says(head + "#99999999999999999999\n", "has more than 64 bits");
  says(head + "#18446744073709551615\n", "is too late: more than 106 days");
  says(head + "#0\nb102 \"\n", "'102' is no binary number");
  says(head + "#0\nb111111111 \"\n", "9 digits for a signal of 8 bits");
  says(head + "#0\nbx00000001 \"\n", "9 digits for a signal of 8 bits");
  says(head + "#0\nb \"\n", "0 digits");
  says(head + "#0\nrabc #\n", "'abc' is no number");
  says(head + "#0\nr++1 #\n", "'+1' is no number");
  says(head + "#0\npQ 0 6 !\n", "'Q' are no states of a port");
  says(head + "#0\nq!\n", "unexpected 'q!'");
  says(head + "#0\n$nonsense $end\n", "unknown keyword '$nonsense'");
  says(head + "#0\nb" + std::string(3 << 20, '0') + " \"\n", "longer than 256 KiB");
  says(std::string(3 << 20, 'x'), "longer than 256 KiB");
  says(std::string(3 << 20, '\1'), "longer than 256 KiB");
  says(head + "#0\n" + std::string(3 << 20, ' ') + "#1\n", "longer than 256 KiB");
}

BOOST_AUTO_TEST_CASE(a_file_that_cannot_be_read) {
  BOOST_CHECK_EXCEPTION(vp::WaveReader("/nowhere/a.vcd"), vp::InputError, [](const auto& error) {
    return std::string(error.what()).find("cannot read trace '/nowhere/a.vcd': No such file") == 0;
  });
  BOOST_CHECK_THROW(vp::WaveReader("/tmp"), vp::InputError);
}

BOOST_AUTO_TEST_CASE(only_what_is_selected_is_handed_over_and_reading_can_stop) {
  struct Handler : vp::WaveHandler {
    bool at(std::uint64_t ps) override { return ps < 2; }
    void change(std::uint32_t net, const vp::WaveValue&) override {
      BOOST_TEST(net == 1u);
      ++changes;
    }
    unsigned changes = 0;
  } handler;
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "t.vcd", head + "#0 0! b1 \" #1 1! b0 \" #2 b1 \" garbage\n");
  vp::WaveReader reader(folder / "t.vcd");
  reader.select(1);
  reader.read(handler);
  BOOST_TEST(handler.changes == 2u);
}

BOOST_AUTO_TEST_SUITE_END()
