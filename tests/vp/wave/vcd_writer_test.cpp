#include <vp/error.h>
#include <vp/wave_writer.h>

#include <boost/test/unit_test.hpp>
#include <cstring>
#include <limits>

#include "file_size_limit.h"
#include "input_error.h"
#include "temporary_files.h"
#include "vcd_check.h"

namespace {

using Kind = vp::VcdWriter::Kind;

std::uint64_t pattern(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

struct Fixture {
  kit::TemporaryFolder folder;
  std::filesystem::path file = folder / "out.vcd";
  std::string text() const { return VcdCheck::text_of(file.string()); }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(vcd_writer, Fixture)

BOOST_AUTO_TEST_CASE(writes_exactly_this) {
  vp::VcdWriter writer(file);
  const auto valid = writer.add("top.pl.valid", Kind::wire, 1);
  const auto count = writer.add("top.pl.count", Kind::reg, 9);
  const auto watts = writer.add("top.watts", Kind::real, 64);
  const auto state = writer.add("top.pl.sub.state", Kind::reg, 3);
  writer.begin(100, {1, 0, pattern(0.5), 5});
  writer.set_time(120);
  writer.change(count, 255);
  writer.change(valid, 1);  // no change
  writer.set_time(130);     // nothing happens here
  writer.change(count, 255);
  writer.set_time(140);
  writer.change(count, 256);
  writer.change(valid, 0);
  writer.change(state, ~std::uint64_t{0});  // only the lower three bits
  writer.change(watts, pattern(-1.25e-9));
  writer.close(200);
  BOOST_TEST(text() ==
             "$version markervp $end\n"
             "$timescale 1ps $end\n"
             "$scope module top $end\n"
             "$var real 64 # watts $end\n"
             "$scope module pl $end\n"
             "$var wire 1 ! valid $end\n"
             "$var reg 9 \" count [8:0] $end\n"
             "$scope module sub $end\n"
             "$var reg 3 $ state [2:0] $end\n"
             "$upscope $end\n"
             "$upscope $end\n"
             "$upscope $end\n"
             "$enddefinitions $end\n"
             "#100\n"
             "$dumpvars\n"
             "1!\n"
             "b0 \"\n"
             "r0.5 #\n"
             "b101 $\n"
             "$end\n"
             "#120\n"
             "b11111111 \"\n"
             "#140\n"
             "b100000000 \"\n"
             "0!\n"
             "b111 $\n"
             "r-1.25e-09 #\n"
             "#200\n");
}

BOOST_AUTO_TEST_CASE(every_width_and_value_comes_back) {
  vp::VcdWriter writer(file);
  for (unsigned width = 1; width <= 64; ++width) {
    writer.add("w" + std::to_string(width), Kind::wire, width);
  }
  writer.begin(0, std::vector<std::uint64_t>(64, 0));
  for (unsigned step = 1; step <= 64; ++step) {
    writer.set_time(step);
    for (unsigned id = 0; id < 64; ++id) writer.change(id, 0x9e3779b97f4a7c15u >> (64 - step));
  }
  writer.close(65);
  const VcdCheck vcd(text());
  for (unsigned width = 1; width <= 64; ++width) {
    for (unsigned step = 1; step <= 64; ++step) {
      const std::uint64_t mask = ~std::uint64_t{0} >> (64 - width);
      const std::uint64_t value = 0x9e3779b97f4a7c15u >> (64 - step) & mask;
      BOOST_REQUIRE_EQUAL(std::stoull(vcd.value("w" + std::to_string(width), step), nullptr, 2),
                          value);
    }
  }
}

BOOST_AUTO_TEST_CASE(real_numbers_come_back_exactly) {
  const double values[] = {
      0.1, 1e300, -5e-324, 1.0 / 3, 123456789.123456789, std::numeric_limits<double>::max()};
  vp::VcdWriter writer(file);
  const auto id = writer.add("x", Kind::real, 64);
  writer.begin(0, {0});
  for (unsigned i = 0; i < 6; ++i) {
    writer.set_time(i + 1);
    writer.change(id, pattern(values[i]));
  }
  writer.close(10);
  const VcdCheck vcd(text());
  for (unsigned i = 0; i < 6; ++i) {
    BOOST_TEST(std::strtod(vcd.value("x", i + 1).c_str(), nullptr) == values[i]);
  }
}

// GTKWave's vcd2fst drops values with capital letters.
BOOST_AUTO_TEST_CASE(letters_of_values_are_small) {
  vp::VcdWriter writer(file);
  writer.add("bit", Kind::wire, 1);
  writer.add("word", Kind::wire, 8);
  writer.begin(0, {0, 0});
  writer.set_time(1);
  writer.change_digits(0, "X");
  writer.change_digits(1, "01ZXUWLH");
  writer.set_time(2);
  writer.change_digits(0, "Z");
  writer.close(3);
  const std::string written = text();
  BOOST_TEST(written.substr(written.find("#1")) == "#1\nx!\nb01zxuwlh \"\n#2\nz!\n#3\n");
}

BOOST_AUTO_TEST_CASE(what_has_no_value_yet_gets_none) {
  vp::VcdWriter writer(file);
  writer.add("bit", Kind::wire, 1);
  writer.add("text", Kind::text, 1);
  writer.add("word", Kind::wire, 8);
  writer.add("late", Kind::wire, 8);
  writer.begin_written(5, {"1", "two words", "101", std::nullopt});
  writer.set_time(6);
  writer.change_digits(3, "0");
  writer.close(7);
  const std::string written = text();
  BOOST_TEST(written.substr(written.find("#5")) ==
             "#5\n$dumpvars\n1!\nstwo\\040words \"\nb101 #\n$end\n#6\nb0 $\n#7\n");
}

BOOST_AUTO_TEST_CASE(more_variables_than_short_identifiers_and_more_text_than_the_buffer) {
  constexpr unsigned count = 94 + 94 * 94 + 10;
  vp::VcdWriter writer(file);
  for (unsigned i = 0; i < count; ++i) {
    writer.add("m" + std::to_string(i % 100) + ".v" + std::to_string(i), Kind::wire, 16);
  }
  writer.begin(0, std::vector<std::uint64_t>(count, 0));
  for (std::uint64_t step = 1; step <= 20; ++step) {
    writer.set_time(step * 1000);
    for (unsigned id = 0; id < count; ++id) writer.change(id, id * step);
  }
  writer.close(21'000);
  const VcdCheck vcd(text());
  BOOST_TEST(vcd.variables().size() == count);
  const unsigned last = count - 1;
  BOOST_TEST(
      std::stoull(vcd.value("m" + std::to_string(last % 100) + ".v" + std::to_string(last), 20'000),
                  nullptr, 2) == (last * 20 & 0xffff));
}

BOOST_AUTO_TEST_CASE(the_file_has_its_name_only_when_it_is_complete) {
  {
    vp::VcdWriter writer(file);
    writer.add("a", Kind::wire, 1);
    writer.begin(0, {0});
    BOOST_TEST(!std::filesystem::exists(file));
    writer.close(5);
    BOOST_TEST(std::filesystem::exists(file));
    BOOST_TEST(folder.entries().size() == 1u);
    writer.close(6);
  }
  BOOST_TEST(VcdCheck(text()).end_ps() == 5u);
}

BOOST_AUTO_TEST_CASE(without_close_what_was_written_is_kept_and_marked) {
  {
    vp::VcdWriter writer(file);
    const auto a = writer.add("a", Kind::wire, 1);
    writer.begin(0, {0});
    writer.set_time(7);
    writer.change(a, 1);
  }
  const VcdCheck vcd(text());
  BOOST_TEST(vcd.value("a", 7) == "1");
  BOOST_TEST(vcd.comment().find("incomplete") == 0u);
}

BOOST_AUTO_TEST_CASE(without_a_value_there_is_no_file) {
  { vp::VcdWriter writer(file); }
  BOOST_TEST(folder.entries().size() == 0u);
  vp::VcdWriter writer(file);
  writer.add("a", Kind::wire, 1);
  writer.close(5);
  BOOST_TEST(folder.entries().size() == 0u);
}

BOOST_AUTO_TEST_CASE(a_file_that_cannot_be_written_is_refused_at_once) {
  const std::string advice = "name a file in a folder that exists and may be written";
  const auto open = [](const std::filesystem::path& path) {
    return input_error([&] { vp::VcdWriter writer(path); });
  };
  const auto missing = folder / "missing/out.vcd";
  BOOST_TEST(open(missing) ==
             "cannot write '" + missing + "': No such file or directory; " + advice);
  BOOST_TEST(open(folder.path()) ==
             "cannot write '" + folder.path() + "': Is a directory; " + advice);
  BOOST_TEST(open("") == "cannot write '': No such file or directory; " + advice);
  BOOST_TEST(open("/dev/null/out.vcd").find("Not a directory") != std::string::npos);
  BOOST_TEST(folder.entries().size() == 0u);
}

BOOST_AUTO_TEST_CASE(a_full_disk_is_noticed_and_nothing_half_written_stays) {
  std::string message;
  {
    const kit::FileSizeLimit limit(1'000'000);
    vp::VcdWriter writer(file);
    const auto a = writer.add("a", Kind::wire, 32);
    writer.begin(0, {0});
    for (unsigned i = 1; i < 100'000; ++i) {
      writer.set_time(i);
      writer.change(a, i);
    }
    BOOST_TEST(writer.failed());
    message = input_error([&] { writer.close(100'000); });
  }
  BOOST_TEST(message ==
             "cannot write '" + file.string() + "': File too large; make room, or write less");
  BOOST_TEST(folder.entries().size() == 0u);
}

BOOST_AUTO_TEST_CASE(a_device_is_written_directly) {
  const std::string message = input_error([] {
    vp::VcdWriter writer("/dev/full");
    writer.add("a", Kind::wire, 1);
    writer.begin(0, {0});
    writer.close(1);
  });
  BOOST_TEST(message.find("cannot write '/dev/full': No space left on device") == 0u);
  BOOST_TEST(std::filesystem::exists("/dev/full"));
}

BOOST_AUTO_TEST_CASE(names_and_widths_that_a_vcd_cannot_hold_are_refused) {
  vp::VcdWriter writer(file);
  for (const char* path :
       {"", "a .b", "a. b", " a", "a ", "a  b", "a\n", "a\x7f", "a $end", "$end.a"}) {
    BOOST_CHECK_THROW(writer.add(path, Kind::wire, 1), std::invalid_argument);
  }
  BOOST_CHECK_THROW(writer.add("a", Kind::wire, 0), std::invalid_argument);
  BOOST_CHECK_THROW(writer.add("a", Kind::wire, vp::WaveWriter::widest + 1), std::invalid_argument);
  writer.add("a", Kind::wire, 64);
  BOOST_CHECK_THROW(writer.begin(0, {}), std::logic_error);
  writer.begin(0, {0});
  BOOST_CHECK_THROW(writer.add("b", Kind::wire, 1), std::logic_error);
}

BOOST_AUTO_TEST_SUITE_END()
