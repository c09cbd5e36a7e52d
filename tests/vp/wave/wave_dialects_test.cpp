// VCDs as other tools write them: what is odd but clear is read, with a warning.
#include <boost/test/unit_test.hpp>

#include "wave_kit.h"

namespace {

using Lines = std::vector<std::string>;

/// A file, its lines and what the reader says of it.
struct Read {
  explicit Read(const std::string& bytes, const vp::WaveOptions& options = {}) {
    const kit::TemporaryFolder folder;
    kit::write_file(folder / "t.vcd", bytes);
    const WaveText text(folder / "t.vcd", options);
    lines = text.lines;
    declared = text.declared;
    warnings = text.warnings;
    end_ps = text.end_ps;
  }
  bool warns(const std::string& of) const {
    for (const std::string& warning : warnings) {
      if (warning.find(of) != std::string::npos) return true;
    }
    return false;
  }
  Lines lines, warnings;
  std::string declared;
  std::uint64_t end_ps = 0;
};

std::string with(const std::string& variables, const std::string& changes,
                 const std::string& timescale = "1ps") {
  return "$timescale " + timescale + " $end\n$scope module top $end\n" + variables +
         "$upscope $end\n$enddefinitions $end\n" + changes;
}

std::string refusal(const std::string& bytes, const vp::WaveOptions& options) {
  try {
    const Read read(bytes, options);
    return "";
  } catch (const vp::InputError& error) {
    return error.what();
  }
}

vp::WaveOptions lenient() {
  vp::WaveOptions options;
  options.lenient = true;
  return options;
}

vp::WaveOptions strict() {
  vp::WaveOptions options;
  options.strict = true;
  return options;
}

const std::string bit = "$var wire 1 ! a $end\n", vector = "$var wire 4 \" v [3:0] $end\n";

}  // namespace

BOOST_AUTO_TEST_SUITE(wave_dialects)

BOOST_AUTO_TEST_CASE(bits_declared_one_by_one_are_a_vector) {
  const Read read(
      with("$var wire 1 ! q [2] $end\n$var wire 1 \" q [1] $end\n"
           "$var wire 1 # q [0] $end\n",
           "#0\n1!\n#5\n0\"\n1#\n#9\nX!\n"));
  BOOST_TEST(read.declared == "top.q ");
  BOOST_TEST((read.lines == Lines{"0 top.q 1xx", "5 top.q 101", "9 top.q x01"}));
  BOOST_TEST(read.warnings.empty());
}

BOOST_AUTO_TEST_CASE(slices_and_rising_bits_join_what_does_not_adjoin_stays_apart) {
  BOOST_TEST(
      Read(with("$var wire 2 ! q [3:2] $end\n$var wire 2 \" q [1:0] $end\n", "#0\nb1 !\nb10 \"\n"))
          .lines.back() == "0 top.q 0110");
  BOOST_TEST(Read(with("$var wire 1 ! q [0] $end\n$var wire 1 \" q [1] $end\n", "#0\n1!\n0\"\n"))
                 .lines.back() == "0 top.q 10");
  BOOST_TEST(Read(with("$var wire 1 ! q [0] $end\n$var wire 1 \" q [2] $end\n", "#0\n")).declared ==
             "top.q[0] top.q[2] ");
  BOOST_TEST(Read(with("$var wire 1 ! q [3] $end\n", "#0\n")).declared == "top.q[3] ");
  BOOST_TEST(Read(with("$var wire 1 ! q [0:0] $end\n", "#0\n")).declared == "top.q ");
  // Elements of an array are no bits of a vector.
  BOOST_TEST(Read(with("$var reg 1 ! m[0] $end\n$var reg 1 \" m[1] $end\n"
                       "$var reg 8 # w[0] [7:0] $end\n$var reg 8 $ w[1] [7:0] $end\n",
                       "#0\n"))
                 .declared == "top.m[0] top.m[1] top.w[0] top.w[1] ");
}

BOOST_AUTO_TEST_CASE(one_bit_may_be_of_two_vectors_and_a_signal_of_its_own) {
  const kit::TemporaryFolder folder;
  kit::write_file(
      folder / "t.vcd",
      with("$var wire 1 ! q [1] $end\n$var wire 1 \" q [0] $end\n$var wire 1 ! one $end\n"
           "$scope module sub $end\n$var wire 1 ! p [1] $end\n$var wire 1 \" p [0] $end\n"
           "$upscope $end\n",
           "#0\n1!\n0\"\n"));
  const vp::WaveReader reader(folder / "t.vcd");
  BOOST_REQUIRE(reader.find("top.q") && reader.find("top.sub.p") && reader.find("top.one"));
  BOOST_TEST(reader.find("top.q")->net == reader.find("top.sub.p")->net);
  BOOST_TEST(reader.find("top.q")->width == 2u);
  BOOST_TEST(reader.find("top.one")->width == 1u);
}

BOOST_AUTO_TEST_CASE(a_scope_opened_again_is_the_same_scope) {
  const std::string again = "$scope module top $end\n$var wire 1 ! a $end\n$upscope $end\n";
  const std::string head = "$timescale 1ps $end\n";
  const Read same(head + again + again + "$enddefinitions $end\n#0\n1!\n");
  BOOST_TEST(same.declared == "top.a ");
  BOOST_TEST(same.warnings.empty());
  const Read other(head + again +
                   "$scope module top $end\n$var wire 1 \" a $end\n$upscope $end\n"
                   "$enddefinitions $end\n#0\n1!\n0\"\n");
  BOOST_TEST(other.declared == "top.a top.a#2 ");
  BOOST_TEST(other.warns("declared again with other values"));
  BOOST_TEST(other.warns("line 6"));
}

BOOST_AUTO_TEST_CASE(values_before_the_first_time_are_those_at_zero) {
  BOOST_TEST(
      (Read(with(bit, "$dumpvars\n1!\n$end\n#5\n0!\n")).lines == Lines{"0 top.a 1", "5 top.a 0"}));
  BOOST_TEST((Read(with(bit, "1!\n#0\n#5\n0!\n")).lines == Lines{"0 top.a 1", "5 top.a 0"}));
}

BOOST_AUTO_TEST_CASE(scopes_without_name_and_signals_without_scope) {
  BOOST_TEST(
      Read("$timescale 1ps $end $scope module $end $scope module t $end $var wire 1 ! a $end "
           "$upscope $end $upscope $end $var wire 1 \" b $end $enddefinitions $end #0 1!\n")
          .declared == "t.a b ");
}

BOOST_AUTO_TEST_CASE(what_a_header_lacks) {
  const Read none("$var wire 1 ! a $end $enddefinitions $end #3 1!\n");
  BOOST_TEST(none.lines.front() == "3000 a 1");
  BOOST_TEST(none.warns("no $timescale"));
  vp::WaveOptions options;
  options.timescale_fs = 10'000'000;
  const Read given("$var wire 1 ! a $end $enddefinitions $end #3 1!\n", options);
  BOOST_TEST(given.lines.front() == "30000 a 1");
  BOOST_TEST(given.warnings.empty());
  const Read open("$timescale 1ps $end $var wire 1 ! a $end #3 1!\n");
  BOOST_TEST(open.lines.front() == "3 a 1");
  BOOST_TEST(open.warns("no $enddefinitions"));
  BOOST_TEST(Read("$timescale 1ps $end $var wire 1 ! a $end 1! #3\n").lines.front() == "0 a 1");
}

BOOST_AUTO_TEST_CASE(instants_within_a_picosecond_stay_apart) {
  const Read read(with(bit, "#0\n0!\n#3\n1!\n#6\n0!\n#16\n1!\n", "100fs"));
  BOOST_TEST((read.lines == Lines{"0 top.a 0", "0 top.a 1", "0 top.a 0", "1 top.a 1"}));
  BOOST_TEST(read.end_ps == 1u);
}

BOOST_AUTO_TEST_CASE(times_with_a_point_and_times_that_fall) {
  BOOST_TEST(Read(with(bit, "#3.0\n1!\n")).lines.front() == "3 top.a 1");
  const std::string falling =
      with(bit + vector, "#0\n0!\n#9\n1!\n#5\n0!\nb1 \"\n#9\n0!\n#12\n1!\n");
  BOOST_TEST(refusal(falling, {}).find("line 11") != std::string::npos);
  BOOST_TEST(refusal(falling, {}).find("the time falls to 5 (--lenient") != std::string::npos);
  const Read read(falling, lenient());
  BOOST_TEST((read.lines == Lines{"0 top.a 0", "9 top.a 1", "9 top.a 0", "12 top.a 1"}));
  BOOST_TEST(read.warns("times fall; these steps are left out (line 11)"));
}

BOOST_AUTO_TEST_CASE(nine_states_in_any_case) {
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "t.vcd", with(bit + "$var wire 4 \" v [3:0] $end\n",
                                         "#0\nU!\n#1\n-!\n#2\nH!\n#3\nL!\n#4\nW!\nb10LH \"\n"));
  struct Handler : vp::WaveHandler {
    bool at(std::uint64_t) override { return true; }
    void change(std::uint32_t, const vp::WaveValue& value) override {
      text += std::string(value.text) + (value.known ? "=" + std::to_string(value.bits) : "") + " ";
    }
    std::string text;
  } handler;
  vp::WaveReader reader(folder / "t.vcd");
  reader.select_all();
  reader.read(handler);
  BOOST_TEST(handler.text == "u - h=1 l=0 w 10lh=9 ");
}

BOOST_AUTO_TEST_CASE(digits_that_are_left_out_or_too_many) {
  BOOST_TEST(vp::full_digits("1", 4) == "0001");
  BOOST_TEST(vp::full_digits("0x", 4) == "000x");
  BOOST_TEST(vp::full_digits("x1", 4) == "xxx1");
  BOOST_TEST(vp::full_digits("z0", 4) == "zzz0");
  BOOST_TEST(vp::full_digits("h", 4) == "hhhh");
  const Read read(with(vector, "#0\nbH \"\n#1\nb00000010 \"\n#2\nb0b11 \"\n#3\nbxxxxxx1 \"\n"));
  BOOST_TEST((read.lines == Lines{"0 top.v h", "1 top.v 0010", "2 top.v 11", "3 top.v xxx1"}));
  BOOST_TEST(read.warns("does not extend to the left: it is repeated (line 7)"));
  BOOST_TEST(
      read.warns("more digits than their signal: those on the left, which say nothing, are "
                 "left out (2 times, first in line 9)"));
}

BOOST_AUTO_TEST_CASE(a_blank_between_a_bit_and_its_identifier) {
  const Read read(with(bit, "#0\n1 !\n#1\n0!\n"));
  BOOST_TEST((read.lines == Lines{"0 top.a 1", "1 top.a 0"}));
  BOOST_TEST(read.warns("a blank is between a bit and its identifier (line 7)"));
}

BOOST_AUTO_TEST_CASE(words_in_bits_and_numbers_of_other_types) {
  const Read words(with("$var reg 1 ! s $end\n", "#0\nsIDLE !\n#1\n1!\n#2\nsRUN !\n"));
  BOOST_TEST((words.lines == Lines{"0 top.s IDLE", "1 top.s 1", "2 top.s RUN"}));
  BOOST_TEST(words.warns("(2 times, first in line 7)"));
  const Read real(with("$var real 1 ! r $end\n", "#0\nr+1.5 !\n#1\nb11 !\n"));
  BOOST_TEST((real.lines == Lines{"0 top.r 1.5", "1 top.r 3"}));
  BOOST_TEST(Read(with(vector, "#0\nr2.5 \"\n")).lines.front() == "0 top.v 2.5");
}

BOOST_AUTO_TEST_CASE(events_empty_vectors_and_aliases_of_other_sizes) {
  const kit::TemporaryFolder folder;
  kit::write_file(
      folder / "t.vcd",
      with("$var event 1 ! go $end\n$var wire 0 \" none $end\n$var reg 0 % t[-1:0] $end\n"
           "$var integer 32 # i $end\n$var reg 8 # low [7:0] $end\n",
           "#0\n1!\nb0 \"\nb \"\n#1\n1!\nb100000000 #\n"));
  const WaveText text(folder / "t.vcd");
  BOOST_TEST((text.lines == Lines{"0 top.go 1", "1 top.go 1", "1 top.i 100000000"}));
  const vp::WaveReader reader(folder / "t.vcd");
  BOOST_TEST(reader.find("top.go")->is_event);
  BOOST_TEST(reader.find("top.none")->width == 0u);
  BOOST_TEST(reader.find("top.t") != nullptr);
  BOOST_TEST(reader.find("top.low")->width == 32u);
  BOOST_TEST(reader.warnings().front().find("several types or sizes") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(ports_of_an_extended_vcd) {
  const Read read(with("$var port 1 <0 d $end\n$var port [3:0] <1 q $end\n",
                       "#0\n$dumpports\npD 6 0 <0\npLHNZ 0000 6666 <1\n$end\n#9\npU 0 6 <0\n"
                       "$vcdclose #20 $end\n"));
  BOOST_TEST((read.lines == Lines{"0 top.d 0", "0 top.q 01xz", "9 top.d 1"}));
  BOOST_TEST(read.end_ps == 20u);
}

BOOST_AUTO_TEST_CASE(nothing_is_known_while_the_dump_is_off) {
  const Read read(with(bit, "#0\n1!\n#5\n$dumpoff\nx!\n$end\n#9\n$dumpon\n0!\n$end\n"));
  BOOST_TEST(
      (read.lines == Lines{"0 top.a 1", "5 recorded 0", "5 top.a x", "9 recorded 1", "9 top.a 0"}));
  BOOST_TEST(Read(with(bit, "#0\n1!\n$dumpall\n1!\n$end\n$comment 0! #99 $end\n#3\n")).end_ps ==
             3u);
}

BOOST_AUTO_TEST_CASE(values_with_names) {
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "t.vcd",
                  "$attrbegin misc 07 state_t 2 idle run 00 01 1 $end\n" +
                      with("$attrbegin misc 07 \"\" 1 $end\n$var reg 2 ! s [1:0] $end\n"
                           "$attrbegin misc 02 STD_LOGIC 1030 $end\n$var logic 1 \" a $end\n"
                           "$attrbegin pack packed 3 $end\n$var enum 1 # b $end\n",
                           "#0\nb0 !\n"));
  const vp::WaveReader reader(folder / "t.vcd");
  BOOST_REQUIRE(reader.enumerations().size() == 1u);
  BOOST_TEST(reader.enumerations()[0].words[1].second == "run");
  BOOST_TEST(reader.find("top.s")->enumeration == 1u);
  BOOST_TEST(reader.find("top.a")->enumeration == 0u);
  BOOST_TEST(reader.find("top.b") != nullptr);
}

BOOST_AUTO_TEST_CASE(names_in_any_writing) {
  BOOST_TEST(Read("\xEF\xBB\xBF" + with("$var wire 1 ! caf\xC3\xA9 $end\n", "#0\n")).declared ==
             "top.caf\xC3\xA9 ");
  BOOST_TEST(Read(with("$var wire 1 ! caf\xE9 $end\n", "#0\n")).declared == "top.caf\xC3\xA9 ");
  BOOST_TEST(Read(with("$var wire 8 ! a b [7:0] $end\n$var wire 4 \" c [ 3 : 0 ] $end\n", "#0\n"))
                 .declared == "top.a b top.c ");
  BOOST_TEST(
      Read(with("$var wire 8 ! v[7:0] $end\n$var wire 1 \" w[7:0] $end\n", "#0\n")).declared ==
      "top.v top.w[7:0] ");
}

BOOST_AUTO_TEST_CASE(a_file_that_was_cut_gives_what_is_before) {
  const std::string start =
      with("$var wire 8 ! a $end\n$var wire 1 !! b $end\n", "#0\nb0 !\n#10\nb1 !\n#20\n");
  for (const char* rest : {"b101", "b101 ", "0!", "s", "#1", "$comment what", "$dumpva"}) {
    const Read read(start + rest);
    BOOST_TEST((read.lines == Lines{"0 top.a 0", "10 top.a 1"}), rest);
    BOOST_TEST(read.warns("was cut off in the middle of a"), rest);
    BOOST_TEST(read.end_ps == 20u, rest);
    BOOST_TEST(refusal(start + rest, strict()).find("was cut off") != std::string::npos, rest);
  }
  for (const char* rest : {"b1 !!", "0!!", "#30", "$end"}) {
    const Read read(start + rest);
    BOOST_TEST(read.warns("its last word is taken as whole"), rest);
    BOOST_TEST(refusal(start + rest, strict()).find("as whole") != std::string::npos, rest);
  }
  BOOST_TEST(Read(start + "0!!").lines.back() == "20 top.b 0");
  BOOST_TEST(Read(start + "#30").end_ps == 30u);
}

BOOST_AUTO_TEST_CASE(what_was_not_declared_can_be_left_out) {
  const std::string file = with(bit, "#0\n1!\n1?\nb1 ??\n#3\n0!\n");
  BOOST_TEST(refusal(file, {}).find("'?' was not declared (--lenient") != std::string::npos);
  const Read read(file, lenient());
  BOOST_TEST((read.lines == Lines{"0 top.a 1", "3 top.a 0"}));
  BOOST_TEST(read.warns("left out (2 times, first in line 8)"));
}

BOOST_AUTO_TEST_CASE(very_many_scopes_and_a_very_wide_vector) {
  constexpr unsigned scopes = 100'000, bits = 65'536;
  std::string header = "$timescale 1ps $end\n";
  for (unsigned i = 0; i < scopes; ++i)
    header += "$scope module s" + std::to_string(i) + " $end $upscope $end\n";
  const std::string digits = "1" + std::string(bits - 2, 'z') + "1";
  const Read read(header + "$var wire 65536 ! v $end\n$enddefinitions $end\n#0\nb" + digits +
                  " !\n");
  BOOST_TEST((read.lines.front() == "0 v " + digits));
}

BOOST_AUTO_TEST_CASE(words_that_are_no_utf8_are_latin1) {
  const std::string text = "$var string 1 ! s $end\n";
  BOOST_TEST((Read(with(text,
                        "#0\nsr\xF6"
                        "d !\n"))
                  .lines == Lines{"0 top.s r\xC3\xB6"
                                  "d"}));
  BOOST_TEST((Read(with(text, "#0\nsr\\366d !\n")).lines == Lines{"0 top.s r\xC3\xB6"
                                                                  "d"}));
  BOOST_TEST((Read(with(text,
                        "#0\nsr\xC3\xB6"
                        "d !\n"))
                  .lines == Lines{"0 top.s r\xC3\xB6"
                                  "d"}));
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "t.vcd", with("$attrbegin misc 07 kind 1 r\xF6"
                                         "d 1 1 $end\n" +
                                             bit,
                                         ""));
  const vp::WaveReader reader(folder / "t.vcd");
  BOOST_TEST_REQUIRE(reader.enumerations().size() == 1u);
  BOOST_TEST(reader.enumerations()[0].words[0].second ==
             "r\xC3\xB6"
             "d");
}

BOOST_AUTO_TEST_SUITE_END()
