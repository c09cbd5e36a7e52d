// What the program does wrong, and the platform forgives: a warning, once, and no other.
#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include "command_line.h"

using namespace negative;

namespace {

struct Diagnostics : CommandLine {
  /// Runs the careless program on two frames. The warnings of all frames and of the run.
  Words warnings(int mistake, const Words& more = {}) const {
    Words arguments{"run",       "z1.0",
                    "z1.5",      "--no-pictures",
                    "--program", MARKERVP_CARELESS,
                    "--set",     "sw.mistake=" + std::to_string(mistake)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const kit::Outcome outcome = start(arguments);
    BOOST_TEST(outcome.exit_code == 0, outcome.err);
    const auto result = nlohmann::json::parse(kit::read_file(*this / "out/result.json"));
    Words all;
    const auto add = [&](const nlohmann::json& json) {
      if (!json.contains("warnings")) return;
      for (const auto& warning : json["warnings"]) {
        // The rest of the binary image has nowhere to go.
        if (!contains(warning, "binary words dropped")) all.push_back(warning);
      }
    };
    for (const auto& frame : result["frames"]) add(frame);
    add(result);
    return all;
  }

  /// `count` warnings with all of `parts`, the same at each fidelity, with poll elision and
  /// without. None: `count` 0.
  void check(int mistake, std::size_t count, const Words& parts = {}) const {
    BOOST_TEST_CONTEXT("mistake " << mistake) {
      const Words tlm = warnings(mistake);
      BOOST_TEST(tlm == warnings(mistake, {"--fidelity", "clocked"}),
                 boost::test_tools::per_element());
      BOOST_TEST(tlm == warnings(mistake, {"--set", "ps.poll_elision=false"}),
                 boost::test_tools::per_element());
      BOOST_TEST(tlm.size() == count);
      for (const std::string& warning : tlm) {
        for (const std::string& part : parts) BOOST_TEST(contains(warning, part), warning);
      }
    }
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(diagnostics, Diagnostics)

BOOST_AUTO_TEST_CASE(nothing_wrong) {
  check(0, 0);
}

BOOST_AUTO_TEST_CASE(ready_twice_after_a_word) {
  const Words all = warnings(1);
  BOOST_TEST_REQUIRE(all.size() == 4u);
  for (const std::size_t i : {0u, 2u}) {
    BOOST_TEST(contains(all[i], "toggles of `ready` with nothing to acknowledge"), all[i]);
    for (const char* part : {"`ready` was toggled although no feature word waits",
                             "program 'careless', pc ", "/markervp/cpu/stray_ready at "}) {
      BOOST_TEST(contains(all[i + 1], part), all[i + 1]);
    }
  }
  BOOST_TEST(all == warnings(1, {"--fidelity", "clocked"}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(ready_before_the_first_word) {
  check(2, 2, {"`ready` was toggled although no feature word waits", "stray_ready at "});
}

BOOST_AUTO_TEST_CASE(polls_after_the_end_word) {
  check(3, 2,
        {"was read 1000 times more after the end word", "which the program saw at ",
         "polls_after_end at "});
  check(4, 2, {"was read 3 times more after the end word", "`rst`, then `ena`"});
}

BOOST_AUTO_TEST_CASE(a_loop_that_reads_a_dma_buffer) {
  check(5, 1,
        {"a loop without HAL call reads 0x", "axi_dma_1 is about to write",
         "hal_cache_invalidate()", "hal_barrier()", "take_packet()+", "spins_on_memory at "});
  check(8, 1,
        {"a loop without HAL call reads 0x", "nothing made it visible", "look_at_all_words()+"});
}

BOOST_AUTO_TEST_CASE(loops_that_may) {
  check(6, 0);
  check(7, 0);
  check(9, 0);
}

BOOST_AUTO_TEST_CASE(a_buffer_that_was_not_invalidated) {
  check(10, 1,
        {"a DMA wrote 0x", "never invalidated", "hal_cache_invalidate()", "not_invalidated at "});
}

BOOST_AUTO_TEST_SUITE_END()
