// FST says the same as VCD.
#include <vp/wave_writer.h>
#include <boost/test/unit_test.hpp>

#include <cstring>
#include <filesystem>

#include "wave_kit.h"

namespace {

using Kind = vp::WaveWriter::Kind;

std::uint64_t pattern(double real) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &real, sizeof bits);
  return bits;
}

void write(const std::string& file) {
  const auto writer = vp::open_wave_writer(file);
  writer->add("top.flag", Kind::wire, 1);
  writer->add("top.word", Kind::reg, 12);
  writer->add("top.watts", Kind::real, 64);
  writer->add("top.state", Kind::text, 1);
  writer->begin(5, {0, 0x123, pattern(1.25), 0});
  writer->set_time(20);
  writer->change(0, 1);
  writer->change(1, 0xFFF);
  writer->change(2, pattern(-0.5));
  writer->change_text(3, "two words \\ more");
  writer->set_time(30);
  writer->pause();
  writer->set_time(40);
  writer->resume({0, 7, pattern(3), 0});
  writer->set_time(50);
  writer->change_digits(1, "x1");
  writer->close(99);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(fst, *boost::unit_test::precondition([](boost::unit_test::test_unit_id) {
                        return vp::has_fst();
                      }))

BOOST_AUTO_TEST_CASE(both_formats_say_the_same) {
  const kit::TemporaryFolder folder;
  for (const char* name : {"t.vcd", "t.fst"}) {
    write(folder / name);
    const WaveText text(folder / name);
    BOOST_TEST(text.declared == "top.flag top.word top.watts top.state ");
    BOOST_TEST(text.end_ps == 99u);
    BOOST_TEST(std::stoul(text.value("top.word", 19), nullptr, 2) == 0x123u);
    BOOST_TEST(std::stod(text.value("top.watts", 19)) == 1.25);
    BOOST_TEST(text.value("top.flag", 20) == "1");
    BOOST_TEST(std::stod(text.value("top.watts", 20)) == -0.5);
    BOOST_TEST(text.value("top.state", 20) == "two words \\ more");
    BOOST_TEST(text.value("top.flag", 30) == "x");
    BOOST_TEST(text.value("top.word", 30).front() == 'x');
    BOOST_TEST(text.value("top.watts", 30) == "nan");
    BOOST_TEST(text.value("top.state", 30) == "");
    BOOST_TEST(std::stoul(text.value("top.word", 40), nullptr, 2) == 7u);
    BOOST_TEST(text.value("top.word", 50).find("x1") != std::string::npos);
  }
  BOOST_TEST(folder.entries().size() == 2u);
}

BOOST_AUTO_TEST_CASE(two_writes_give_the_same_bytes) {
  const kit::TemporaryFolder folder;
  write(folder / "a.fst");
  write(folder / "b.fst");
  BOOST_TEST((kit::read_file(folder / "a.fst") == kit::read_file(folder / "b.fst")));
}

BOOST_AUTO_TEST_CASE(a_truncated_file_is_refused_with_the_byte) {
  const kit::TemporaryFolder folder;
  write(folder / "t.fst");
  const std::size_t size = kit::read_file(folder / "t.fst").size();
  for (const std::size_t bytes : {std::size_t{1}, std::size_t{8}, std::size_t{200}, size - 1}) {
    kit::write_part(folder / "t.fst", folder / "cut.fst", bytes);
    BOOST_CHECK_EXCEPTION(WaveText(folder / "cut.fst"), vp::InputError, [](const auto& error) {
      return std::string(error.what()).find(" at byte ") != std::string::npos;
    });
  }
}

BOOST_AUTO_TEST_CASE(a_file_that_was_not_closed_leaves_nothing_behind_if_nothing_is_in_it) {
  const kit::TemporaryFolder folder;
  vp::open_wave_writer(folder / "t.fst")->add("a", Kind::wire, 1);
  BOOST_TEST(folder.entries().empty());
  BOOST_CHECK_THROW(vp::open_wave_writer("/nowhere/t.fst"), vp::InputError);
  BOOST_CHECK_THROW(vp::open_wave_writer(folder / "t.txt"), vp::InputError);
}

BOOST_AUTO_TEST_SUITE_END()
