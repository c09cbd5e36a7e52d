// Which frames a trigger keeps.
#include <boost/test/unit_test.hpp>

#include "counter_platform.h"
#include "wave_kit.h"

namespace {

/// Frames of 100 ns: the counter of the fast clock, bits 7:3 … its bit 3 is no frame signal; so the
/// slow one's `odd`, which changes every 25 ns, is.
struct GateFixture : TraceFixture {
  GateFixture() {
    options.trigger.emplace();
    options.trigger->frame = "top.slow.odd";
  }
  WaveText kept(const std::string& condition, unsigned before = 0) {
    options.trigger->condition = vp::Expression(condition);
    options.trigger->frames_before = before;
    run(200'000);
    return WaveText(options.file.string());
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(frame_gate, GateFixture)

// Frames begin at 25, 50, 75 … ns; top.fast.count is t / 10 ns.
BOOST_AUTO_TEST_CASE(only_the_frame_in_which_it_comes_true_is_kept) {
  const WaveText text = kept("fast.count == 6");
  BOOST_TEST(text.lines.front().substr(0, 6) == "50000 ");
  BOOST_TEST(text.end_ps == 75'000u);
  BOOST_TEST(text.value("top.fast.count", 50'000) == "101");
  BOOST_TEST(text.value("top.fast.count", 60'000) == "110");
}

BOOST_AUTO_TEST_CASE(and_frames_before_it) {
  const WaveText text = kept("fast.count == 6", 1);
  BOOST_TEST(text.lines.front().substr(0, 6) == "25000 ");
  BOOST_TEST(text.value("top.fast.count", 49'999) == "100");
  BOOST_TEST(text.end_ps == 75'000u);
}

BOOST_AUTO_TEST_CASE(between_kept_frames_nothing_is_known) {
  const WaveText text = kept("fast.count == 3 or fast.count == 13");
  BOOST_TEST(text.value("top.fast.count", 30'000) == "11");
  BOOST_TEST(text.value("top.fast.count", 80'000) == "x");
  BOOST_TEST(text.value("top.fast.odd", 124'999) == "x");
  BOOST_TEST(text.value("top.fast.count", 125'000) == "1100");
  BOOST_TEST(text.value("top.fast.count", 130'000) == "1101");
  BOOST_TEST(text.end_ps == 150'000u);
}

BOOST_AUTO_TEST_CASE(neighbours_are_kept_without_a_gap) {
  const WaveText text = kept("fast.count == 6 or fast.count == 8");
  BOOST_TEST(text.value("top.fast.count", 79'999) == "111");
  BOOST_TEST(text.end_ps == 100'000u);
}

BOOST_AUTO_TEST_CASE(signals_of_the_trigger_are_traced_whatever_the_filter_says) {
  options.filter = vp::TraceFilter({"top.slow.count"});
  const WaveText text = kept("fast.count == 6");
  BOOST_TEST(text.declared == "top.fast.count top.slow.count top.slow.odd ");
}

BOOST_AUTO_TEST_CASE(no_such_frame_no_file) {
  options.trigger->condition = vp::Expression("fast.count == 77");
  Platform platform(options);
  sc_core::sc_start(sc_core::sc_time(200, sc_core::SC_NS));
  BOOST_TEST(!platform.tracer.close());
  BOOST_TEST(folder.entries().empty());
}

BOOST_AUTO_TEST_CASE(unknown_signals_are_refused_before_the_run) {
  options.trigger->condition = vp::Expression("fast.cont == 1");
  BOOST_CHECK_EXCEPTION(run(1000), vp::InputError, [](const auto& error) {
    return std::string(error.what()).find("no signal 'fast.cont'") != std::string::npos;
  });
}

BOOST_AUTO_TEST_CASE(a_small_buffer_gives_up_the_beginning) {
  options.trigger->frame = "top.fast.odd";  // rests once the counter sleeps
  options.trigger->buffer = 1;
  options.trigger->condition = vp::Expression("slow.count == 15");
  options.level = vp::TraceLevel::registers;
  Platform platform(options, 3);
  sc_core::sc_start(sc_core::sc_time(1, sc_core::SC_US));
  // Processes may write without end: more than a chunk of changes in one frame.
  for (unsigned i = 0; i < 600'000; ++i) {
    sc_core::sc_start(sc_core::sc_time(1, sc_core::SC_NS));
    platform.slow.count = static_cast<std::uint8_t>(i % 16);
  }
  BOOST_TEST(platform.tracer.close());
  const WaveText text(options.file.string());
  BOOST_TEST(text.lines.size() < 600'000u);
  BOOST_TEST(text.end_ps == 601'000'000u);
}

BOOST_AUTO_TEST_SUITE_END()
