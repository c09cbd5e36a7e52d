// A trace as a page holds it.
#include <boost/test/unit_test.hpp>

#include <trace/recording.h>

#include <optional>

#include "waves.h"

namespace {

using namespace platform::trace;

/// "10=1 20=x": times and values of a signal.
std::string unpacked(const Recording& recording, const Recording::Signal& signal) {
  std::size_t at = 0;
  const auto next = [&] {
    std::uint64_t number = 0;
    for (unsigned shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(signal.changes.at(at++));
      number |= std::uint64_t{byte & 0x7fU} << shift;
      if (byte < 0x80) return number;
    }
  };
  std::string text;
  std::uint64_t ps = recording.from_ps;
  for (std::uint64_t i = 0; i < signal.count; ++i) {
    const std::uint64_t number = next();
    const bool bit = signal.form == Recording::Form::bit;
    ps += bit ? number >> 3 : number;
    text += (i == 0 ? "" : " ") + std::to_string(ps) + "=";
    text += bit ? std::string(1, Recording::states[number & 7]) : signal.words.words().at(next());
  }
  return text;
}

Recording recorded(const std::string& file, const RecordingOptions& options = {}) {
  TraceFile trace(file, {});
  return recording(trace, options);
}

const char* changes =
    "#0\n0!\nb0 \"\n#100\n1!\nb101010 \"\n#200\n1!\nx!\n#300\nz!\nr2.5 #\nshello $\n#400\n0!\n";

}  // namespace

BOOST_AUTO_TEST_SUITE(recordings)

BOOST_AUTO_TEST_CASE(has_every_change_with_its_time) {
  const Waves waves("top.a 1, top.b 8, top.c real, top.d string", changes, "1ps");
  const Recording found = recorded(waves.file);
  BOOST_REQUIRE(found.signals.size() == 4u);
  BOOST_TEST(unpacked(found, found.signals[0]) == "0=0 100=1 200=x 300=z 400=0");
  BOOST_TEST(unpacked(found, found.signals[1]) == "0=0x0 100=0x2A");
  BOOST_TEST(unpacked(found, found.signals[2]) == "300=2.5");
  BOOST_TEST(unpacked(found, found.signals[3]) == "300=hello");
  BOOST_TEST(found.to_ps == 400u);
  BOOST_TEST(found.dropped + found.left_out == 0u);
}

BOOST_AUTO_TEST_CASE(a_window_begins_with_the_values_that_are_there) {
  const Waves waves("top.a 1, top.b 8, top.c real, top.d string", changes, "1ps");
  RecordingOptions options;
  options.from_ps = 150;
  options.to_ps = 350;
  options.signals = {"b", "a"};
  const Recording found = recorded(waves.file, options);
  BOOST_REQUIRE(found.signals.size() == 2u);
  BOOST_TEST(unpacked(found, found.signals[0]) == "150=0x2A");
  BOOST_TEST(unpacked(found, found.signals[1]) == "150=1 200=x 300=z");
  BOOST_TEST(found.to_ps == 350u);
}

BOOST_AUTO_TEST_CASE(what_changes_most_is_left_out_where_there_is_no_room) {
  const Waves waves("top.a 1, top.b 8, top.c real, top.d string", changes, "1ps");
  RecordingOptions options;
  options.most_changes = 5;
  const Recording found = recorded(waves.file, options);
  BOOST_TEST(found.dropped == 1u);
  BOOST_REQUIRE(found.signals.size() == 3u);
  BOOST_TEST(found.signals[0].path == "top.b");
  options = {};
  options.most_signals = 3;
  const Recording short_one = recorded(waves.file, options);
  BOOST_TEST(short_one.dropped == 0u);
  BOOST_TEST(short_one.left_out == 1u);
}

BOOST_AUTO_TEST_CASE(states_stay_apart_and_an_event_is_a_pulse) {
  const kit::TemporaryFolder folder;
  const std::string file = folder / "t.vcd";
  kit::write_file(file,
                  "$timescale 1ps $end $var wire 1 ! a $end $var wire 8 # v $end\n"
                  "$var event 1 % go $end $enddefinitions $end\n"
                  "#0 u! bz #\n#10 w! 1% bu #\n#20 -! bzzzz0001 #\n#30 l! 1%\n#31 1%\n#50\n");
  Recording found = recorded(file);
  BOOST_REQUIRE(found.signals.size() == 3u);
  BOOST_TEST(unpacked(found, found.signals[0]) == "0=u 10=w 20=- 30=0");
  BOOST_TEST(unpacked(found, found.signals[1]) == "0=0xz 10=0xu 20=0xz1");
  BOOST_TEST(unpacked(found, found.signals[2]) == "0=0 10=1 11=0 30=1 31=0 31=1 32=0");
  RecordingOptions late;
  late.from_ps = 20;
  found = recorded(file, late);
  BOOST_TEST(unpacked(found, found.signals[2]) == "20=0 30=1 31=0 31=1 32=0");
  late.from_ps = 30;
  found = recorded(file, late);
  BOOST_TEST(unpacked(found, found.signals[2]) == "30=1 31=0 31=1 32=0");
}

BOOST_AUTO_TEST_CASE(what_is_not_there_is_said) {
  const Waves waves("top.a 1", "#0\n0!\n#100\n1!\n", "1ps");
  RecordingOptions options;
  options.from_ps = 1000;
  BOOST_TEST(complaint([&] { recorded(waves.file, options); }).find("before the window begins") !=
             std::string::npos);
  options = {};
  options.signals = {"nothing"};
  BOOST_TEST(!complaint([&] { recorded(waves.file, options); }).empty());
}

BOOST_AUTO_TEST_SUITE_END()
