// RTL in the place of an IP sleeps while further clocks would change nothing, which cannot be seen.
#include <dlfcn.h>

#include <boost/test/unit_test.hpp>
#include <string>

#include "pipeline.h"

namespace {

std::string file_of(const std::string& object) {
  return MARKERVP_LOCKSTEP_OBJECTS "/" + object + ".so";
}

/// How often the objects of this file were evaluated so far.
std::uint64_t evaluations(const std::string& object) {
  void* library = ::dlopen(file_of(object).c_str(), RTLD_NOW | RTLD_LOCAL);
  BOOST_TEST_REQUIRE(library != nullptr);
  void* symbol = ::dlsym(library, "evaluations");
  BOOST_TEST_REQUIRE(symbol != nullptr);
  const std::uint64_t count = reinterpret_cast<std::uint64_t (*)()>(symbol)();
  ::dlclose(library);
  return count;
}

std::vector<std::string> settings(const std::string& object) {
  std::vector<std::string> all = harness::frame_size(64, 32);
  if (!object.empty()) all.push_back("pl.fidelity.corner_detection=" + file_of(object));
  return all;
}

/// Three frames with pauses between them, and what the RTL was asked for in the last pause.
struct Frames : harness::Pipeline {
  static constexpr std::uint64_t pause_clocks = 10'000;

  explicit Frames(const std::string& object) : Pipeline({}, settings(object)) {
    for (const std::uint64_t seed : {7, 8, 9}) {
      load(harness::noise(64, 32, seed));
      for (const harness::Word& word : run_frame()) words.push_back(word);
      if (!object.empty()) in_pause = evaluations(object);
      run_for(pause_clocks * 20'000);
      if (!object.empty()) in_pause = evaluations(object) - in_pause;
    }
  }

  std::vector<harness::Word> words;
  std::uint64_t in_pause = 0;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(rest)

BOOST_AUTO_TEST_CASE(rtl_sleeps_between_frames_and_gives_the_words_of_its_model) {
  const std::vector<harness::Word> model = Frames("").words;
  const Frames frames("equal");
  BOOST_TEST(harness::first_difference(frames.words, model) == "");
  BOOST_TEST(harness::count(model, 'C') > 0u);
  BOOST_TEST(frames.in_pause < 100u);
}

// Two evaluations a clock: what they depend on is unknown.
BOOST_AUTO_TEST_CASE(rtl_that_does_not_show_its_state_never_sleeps) {
  BOOST_TEST(Frames("stateless").in_pause == 2 * Frames::pause_clocks);
}

std::vector<std::uint64_t> corner_clocks(const Frames& frames) {
  std::vector<std::uint64_t> clocks;
  for (const harness::Word& word : frames.words) {
    if (word.kind == 'C') clocks.push_back(word.clock);
  }
  return clocks;
}

// RTL that is a clock late is as late behind each pause.
BOOST_AUTO_TEST_CASE(a_frame_behind_a_pause_begins_on_its_clock) {
  std::vector<std::uint64_t> expected = corner_clocks(Frames(""));
  for (std::uint64_t& clock : expected) ++clock;
  const std::vector<std::uint64_t> late = corner_clocks(Frames("late"));
  BOOST_TEST(late == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()
