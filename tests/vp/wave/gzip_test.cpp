// A VCD that gzip packed, whole and damaged.
#include <boost/test/unit_test.hpp>

#include <vp/wave_writer.h>

#include "child_process.h"
#include "wave_kit.h"

namespace {

/// A VCD of some size: a counter of 8 bits.
std::string counter() {
  std::string text =
      "$timescale 1ps $end\n$scope module top $end\n$var wire 8 ! n $end\n$upscope $end\n"
      "$enddefinitions $end\n";
  for (unsigned i = 0; i < 20'000; ++i) {
    text += "#" + std::to_string(i * 7) + "\nb";
    for (unsigned bit = 8; bit-- > 0;) text += (i * 37 >> bit & 1U) != 0 ? '1' : '0';
    text += " !\n";
  }
  return text;
}

struct Packed {
  explicit Packed(const std::string& text) {
    kit::write_file(folder / "t.vcd", text);
    const kit::Outcome outcome = kit::run_process("/bin/gzip", {"-k", folder / "t.vcd"}, "/tmp");
    BOOST_REQUIRE(outcome.exit_code == 0);
    bytes = kit::read_file(folder / "t.vcd.gz");
  }
  WaveText read(const std::string& packed, const vp::WaveOptions& options = {}) const {
    kit::write_file(folder / "u.vcd.gz", packed);
    return WaveText(folder / "u.vcd.gz", options);
  }
  std::string refusal(const std::string& packed, const vp::WaveOptions& options = {}) const {
    try {
      read(packed, options);
      return "";
    } catch (const vp::InputError& error) {
      return error.what();
    }
  }
  kit::TemporaryFolder folder;
  std::string bytes;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(gzip)

BOOST_AUTO_TEST_CASE(it_reads_as_the_file_that_was_packed) {
  const Packed packed(counter());
  const WaveText plain(packed.folder / "t.vcd", {}), unpacked = packed.read(packed.bytes);
  BOOST_TEST(plain.lines.size() == 20'000u);
  BOOST_TEST(unpacked.lines == plain.lines);
  BOOST_TEST(unpacked.warnings.empty());
}

BOOST_AUTO_TEST_CASE(streams_behind_each_other_are_one) {
  const std::string text = counter(), end = "#999999\nb11 !\n";
  const Packed first(text), second(end);
  const WaveText both = first.read(first.bytes + second.bytes);
  BOOST_TEST(both.lines.size() == 20'001u);
  BOOST_TEST(both.lines.back() == "999999 top.n 11");
  BOOST_TEST(both.warnings.empty());
}

BOOST_AUTO_TEST_CASE(what_is_cut_off_gives_all_before_and_says_so) {
  const Packed packed(counter());
  const std::string half = packed.bytes.substr(0, packed.bytes.size() / 2);
  const WaveText text = packed.read(half);
  BOOST_TEST(text.lines.size() > 5'000u);
  BOOST_TEST(text.lines.size() < 15'000u);
  BOOST_TEST_REQUIRE(!text.warnings.empty());
  BOOST_TEST(text.warnings.front().find("was cut off: its gzip data have no end") == 0u);
  vp::WaveOptions strict;
  strict.strict = true;
  BOOST_TEST(packed.refusal(half, strict).find("gzip data have no end") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(damaged_data_are_refused_with_their_byte) {
  const Packed packed(counter());
  // The trailer says what the text adds up to; damage before it may look like text.
  std::string damaged = packed.bytes;
  damaged[damaged.size() - 8] ^= '\x5a';
  BOOST_TEST(packed.refusal(damaged).find("its gzip data are damaged near byte ") !=
             std::string::npos);
  damaged = packed.bytes;
  for (std::size_t i = 0; i < 8; ++i) damaged[damaged.size() / 2 + i] ^= '\x5a';
  BOOST_TEST(packed.refusal(damaged) != "");
  BOOST_TEST(packed.refusal(packed.bytes + "garbage").find("damaged") != std::string::npos);
  BOOST_TEST(packed.refusal("\x1f\x8b") != "");
  BOOST_TEST(packed.refusal("\x1f") != "");
}

BOOST_AUTO_TEST_CASE(a_vcd_is_written_packed_if_its_name_says_so) {
  const kit::TemporaryFolder folder;
  const auto written = [&](const std::string& name) {
    const auto writer = vp::open_wave_writer(folder / name);
    const auto id = writer->add("top.n", vp::WaveWriter::Kind::wire, 32);
    writer->begin(0, {0});
    for (std::uint64_t i = 1; i < 100'000; ++i) {
      writer->set_time(i * 7);
      writer->change(id, i * 2654435761U);
    }
    writer->close(1'000'000);
    return kit::read_file(folder / name);
  };
  const std::string plain = written("t.vcd"), packed = written("t.vcd.gz");
  BOOST_TEST(packed.size() < plain.size() / 2);
  const kit::Outcome outcome = kit::run_process("/bin/gzip", {"-dc", folder / "t.vcd.gz"}, "/tmp");
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST((outcome.out == plain));
  BOOST_TEST((written("again.vcd.gz") == packed));
  BOOST_TEST(WaveText(folder / "t.vcd.gz").lines.size() == 100'000u);
  BOOST_CHECK_EXCEPTION(
      vp::open_wave_writer(folder / "t.gz"), vp::InputError, [](const vp::InputError& e) {
        return std::string(e.what()).find("must end in .vcd, .vcd.gz or .fst") != std::string::npos;
      });
}

BOOST_AUTO_TEST_SUITE_END()
