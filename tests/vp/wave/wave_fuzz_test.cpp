// Nothing in a file makes the reader crash: good files with seeded damage, under the sanitizers
// too.
#include <vp/wave_writer.h>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <random>

#include "wave_kit.h"

namespace {

/// A file with everything in it.
void write_good(const std::string& file, unsigned instants) {
  using Kind = vp::WaveWriter::Kind;
  const auto writer = vp::open_wave_writer(file);
  writer->add("top.flag", Kind::wire, 1);
  writer->add("top.below.word", Kind::reg, 32);
  writer->add("top.below.real", Kind::real, 64);
  writer->add("top.text", Kind::text, 1);
  for (unsigned i = 0; i < 100; ++i) {
    writer->add("top.many.s" + std::to_string(i), Kind::wire, 1 + i % 64);
  }
  writer->begin(0, std::vector<std::uint64_t>(104, 0));
  for (unsigned i = 1; i < instants; ++i) {
    writer->set_time(i * 1000);
    writer->change(0, i % 2);
    writer->change(1, i * 2654435761u);
    writer->change(4 + i % 100, i);
    if (i % 5 == 0) writer->change_text(3, "text " + std::to_string(i));
    if (i % 50 == 0) writer->pause();
    if (i % 50 == 2) writer->resume(std::vector<std::uint64_t>(104, i));
  }
  writer->close(instants * 1000);
}

/// One to eight places damaged: bytes changed, removed, doubled, cut off, moved.
std::string damaged(std::string bytes, std::mt19937& random) {
  const auto below = [&](std::size_t limit) { return random() % std::max<std::size_t>(limit, 1); };
  static const std::string likely = "01xzbrs#$! \n\t\x00\xff-.";
  for (auto left = 1 + below(8); left > 0 && !bytes.empty(); --left) {
    const std::size_t at = below(bytes.size());
    switch (below(7)) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes[at] = likely[below(likely.size())];
        break;
      case 2:
        bytes.erase(at, 1 + below(20));
        break;
      case 3:
        bytes.insert(at, bytes.substr(below(bytes.size()), below(200)));
        break;
      case 4:
        bytes.resize(at);
        break;
      case 5:
        bytes.insert(at, std::string(below(300), likely[below(likely.size())]));
        break;
      default:
        bytes.insert(at, "$end $scope $var wire 1 ! a $end #");
        break;
    }
  }
  return bytes;
}

void fuzz_text(const kit::TemporaryFolder& folder, const std::string& name, unsigned rounds,
               const std::string& good, const vp::WaveOptions& options = {}) {
  std::mt19937 random(2026);
  unsigned refused = 0;
  for (unsigned round = 0; round < rounds; ++round) {
    kit::write_file(folder / name, damaged(good, random));
    try {
      const WaveText text(folder / name, options);
    } catch (const vp::InputError& error) {
      ++refused;
      const std::string message = error.what();
      BOOST_TEST(message.find(name) != std::string::npos);
      BOOST_TEST(message.find('\n') == std::string::npos);
    }
  }
  BOOST_TEST(refused > rounds / 4);
}

void fuzz(const std::string& name, unsigned rounds, unsigned instants) {
  const kit::TemporaryFolder folder;
  write_good(folder / name, instants);
  fuzz_text(folder, name, rounds, kit::read_file(folder / name));
}

/// What other tools write, all in one file.
const std::string dialects =
    "\xEF\xBB\xBF$timescale 5 ns $end\n$attrbegin misc 07 state_t 2 idle run 00 01 1 $end\n"
    "$scope module $end\n$scope module top $end\n$var wire 1 ! q [2] $end\n"
    "$var wire 1 \" q [1] $end\n$var wire 1 # q [0] $end\n"
    "$attrbegin misc 07 \"\" 1 $end\n$var reg 2 $ state [1:0] $end\n$upscope $end\n"
    "$scope module top $end\n$var wire 1 % q $end\n$var event 1 & go $end\n$upscope $end\n"
    "$upscope $end\n$var port [3:0] <1 p $end\n$var wire 0 ' none $end\n"
    "$var real 1 r caf\xE9 x $end\n$var string 1 text s $end\n$enddefinitions $end\n"
    "1!\nU\"\n#3.0\nH#\nb0b1 $\nsRUN %\n1&\npLHNZ 0000 6666 <1\nb '\nr+1.5 r\n"
    "s\\040a text\n#4\n$dumpoff\nx!\n$end\n#5\n$dumpon\n0!\n$end\nbxx1 $\n1 \"\n#6\n1&\n"
    "$vcdclose #9 $end\n";

}  // namespace

BOOST_AUTO_TEST_SUITE(wave_fuzz)

BOOST_AUTO_TEST_CASE(damaged_vcds_are_read_or_refused) {
  fuzz("t.vcd", 1000, 60);
}

BOOST_AUTO_TEST_CASE(damaged_dialects_are_read_or_refused) {
  const kit::TemporaryFolder folder;
  vp::WaveOptions lenient;
  lenient.lenient = true;
  fuzz_text(folder, "t.vcd", 3000, dialects);
  fuzz_text(folder, "t.vcd", 3000, dialects, lenient);
}

BOOST_AUTO_TEST_CASE(damaged_fsts_are_read_or_refused) {
  fuzz("t.fst", 3000, 60);
}

BOOST_AUTO_TEST_SUITE_END()
