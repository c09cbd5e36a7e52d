// RTL beside the model of its IP: equal RTL changes nothing, the first difference is reported with
// clock and values.
#include <systemc>

#include <vp/unit.h>
#include <boost/test/unit_test.hpp>
#include <string>

#include "pipeline.h"

namespace {

/// "pl.fidelity.corner_detection" for one of the objects beside this test.
std::string beside(const std::string& object) {
  return "pl.fidelity.corner_detection=lockstep:" MARKERVP_LOCKSTEP_OBJECTS "/" + object + ".so";
}

struct Frame : harness::Pipeline {
  explicit Frame(std::vector<std::string> more = {})
      : Pipeline({}, [&more] {
          std::vector<std::string> settings = harness::frame_size(64, 32);
          settings.insert(settings.end(), more.begin(), more.end());
          return settings;
        }()) {
    load(harness::noise(64, 32, 7));
  }

  /// What ends the simulation.
  std::string failure() {
    try {
      run_frame();
    } catch (const sc_core::sc_report& report) {
      return report.get_msg();
    }
    return "nothing failed";
  }
};

/// The frame's first corner in the unwatched logic: when, and its word.
harness::Word first_corner() {
  Frame frame;
  for (const harness::Word& word : frame.run_frame()) {
    if (word.kind == 'C') return word;
  }
  return {};
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(lockstep)

BOOST_AUTO_TEST_CASE(equal_rtl_is_not_noticed) {
  std::vector<harness::Word> alone, watched;
  {
    Frame frame;
    alone = frame.run_frame();
  }
  Frame frame({beside("equal")});
  watched = frame.run_frame();
  BOOST_TEST(harness::first_difference(watched, alone) == "");
  BOOST_TEST(harness::count(watched, 'C') > 0u);
}

// The pipeline is one register too long: seen behind the clock in which the model's first corner
// leaves.
BOOST_AUTO_TEST_CASE(a_word_one_clock_late_is_told_on_its_clock) {
  const harness::Word corner = first_corner();
  Frame frame({beside("late")});
  const std::string failure = frame.failure();
  const std::uint64_t ps = frame.monitor.time_of(corner.clock);
  BOOST_TEST(contains(failure, "pl.corner_detection.rtl: RTL"), failure);
  BOOST_TEST(contains(failure, "late.so"), failure);
  BOOST_TEST(
      contains(failure, ", at " + vp::format_time(ps) + ": corner_out is 1, and 0 in the RTL"),
      failure);
  // Eight more clocks for a trace, and the one in which the difference is seen.
  BOOST_TEST(kit::now_ps() == ps + 33 * 20'000);
}

// Another threshold: a word differs, or a corner is missing.
BOOST_AUTO_TEST_CASE(another_threshold_is_told) {
  Frame frame({beside("threshold")});
  const std::string failure = frame.failure();
  BOOST_TEST(contains(failure, "corner_"), failure);
  BOOST_TEST(contains(failure, "in the RTL"), failure);
}

BOOST_AUTO_TEST_CASE(what_the_rtl_gives_can_be_traced) {
  Frame frame({beside("late")});
  frame.failure();
  for (const char* signal : {"corner_out", "corner_data", "differs"}) {
    const std::string path = std::string("pl.corner_detection.rtl.") + signal;
    BOOST_TEST(sc_core::sc_find_object(path.c_str()) != nullptr, path);
  }
}

// Whether the simulation ends on the clock of the difference or some clocks later.
BOOST_AUTO_TEST_CASE(a_difference_just_before_the_end_is_told_there) {
  const harness::Word corner = first_corner();
  for (const std::uint64_t clocks : {0, 1, 5}) {
    Frame frame({beside("late")});
    frame.raise_ena();
    frame.run_to_clock(corner.clock + clocks);
    std::string failure;
    try {
      sc_core::sc_stop();
    } catch (const sc_core::sc_report& report) {
      failure = report.get_msg();
    }
    BOOST_TEST(contains(failure, "corner_out is 1, and 0 in the RTL"), clocks << ": " << failure);
    BOOST_TEST(contains(failure, ", at " + vp::format_time(frame.monitor.time_of(corner.clock))),
               clocks << ": " << failure);
  }
}

// One that came to its end beside equal RTL has nothing to tell.
BOOST_AUTO_TEST_CASE(equal_rtl_ends_in_silence) {
  Frame frame({beside("equal")});
  frame.run_frame();
  BOOST_CHECK_NO_THROW(sc_core::sc_stop());
}

BOOST_AUTO_TEST_SUITE_END()
