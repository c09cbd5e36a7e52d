// What the program does wrong, and the platform forgives: a warning, once, and no other.
#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <vp/text.h>

#include "command_line.h"

using namespace negative;

namespace {

struct Diagnostics : CommandLine {
  /// Runs the careless program on a frame.
  kit::Outcome run(int mistake, const Words& more = {},
                   const std::string& program = MARKERVP_CARELESS) const {
    Words arguments{"run",
                    "z1.0",
                    "--no-pictures",
                    "--program",
                    program,
                    "--set",
                    "sw.mistake=" + std::to_string(mistake)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return start(arguments);
  }

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
  for (const int mistake : {5, 6, 8}) {
    check(mistake, 1,
          {"the program reads 0x", ", which a DMA wrote and the program never invalidated",
           "hal_cache_invalidate()", "not_invalidated at "});
  }
  for (const int mistake : {5, 6}) BOOST_TEST(contains(run(mistake).err, "take_packet()+"));
  BOOST_TEST(contains(run(8).err, "look_at_all_words()+"));
}

BOOST_AUTO_TEST_CASE(loops_that_may) {
  check(7, 0);
  check(9, 0);
  check(16, 0);
}

BOOST_AUTO_TEST_CASE(a_buffer_that_was_not_invalidated) {
  check(10, 1,
        {"the program reads 0x", "never invalidated", "hal_cache_invalidate()",
         "not_invalidated at "});
}

BOOST_AUTO_TEST_CASE(an_interrupt_that_is_acknowledged_late) {
  check(11, 2,
        {"returned 1000 times in a row with an interrupt still pending (interrupt 62, "
         "pl.axi_dma_1.s2mm_introut, a level held since ",
         "acknowledge it at the device", "not_acknowledged at "});
}

BOOST_AUTO_TEST_CASE(interrupts_that_come_too_fast) {
  check(12, 2,
        {"interrupts come faster than they are handled", "1000 times in a row",
         "(interrupt 29, ps.private_timer.irq, an edge at ", "do less in the handler",
         "overrun at "});
}

BOOST_AUTO_TEST_CASE(a_sleep_with_interrupts_unmasked) {
  check(13, 1, {"hal_wait_for_interrupt() with IRQ unmasked", "hal_interrupt_enable(false)"});
}

BOOST_AUTO_TEST_CASE(a_transfer_that_leaves_its_buffer) {
  check(14, 2,
        {"axi_dma_1: S2MM transfer of 132 bytes at 0x", "leaves its buffer, 128 bytes at 0x",
         "by 4 bytes", "past_buffer at "});
}

BOOST_AUTO_TEST_CASE(a_clock_that_the_chip_does_not_give) {
  for (const char* part :
       {"FCLK_CLK1 is set to 500000000 Hz", "(250000000 Hz)", "[/markervp/slcr/fclk_too_fast] at ",
        "set_pl_clock", "called from clock_faster (", "careless.cpp:"}) {
    BOOST_TEST(contains(run(15).err, part), run(15).err);
  }
}

/// What the program `caches` is warned of.
struct Caches : CommandLine {
  std::string errors(int mistake, unsigned line, const Words& more = {}) const {
    Words arguments{"run",           "z1.0",
                    "--no-pictures", "--no-report",
                    "--program",     MARKERVP_CACHES,
                    "--set",         "ps.cpu.timeout=5 ms",
                    "--set",         "sw.mistake=" + std::to_string(mistake),
                    "--set",         "sw.line=" + std::to_string(line)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const kit::Outcome outcome = start(arguments);
    BOOST_TEST(outcome.exit_code == 0, outcome.err);
    return outcome.err;
  }
  void check(int mistake, unsigned line, const std::string& what) const {
    const std::string err = errors(mistake, line);
    BOOST_TEST(contains(err, what), "mistake " << mistake << ", line " << line << ": " << err);
    BOOST_TEST(contains(err, "caches.cpp:"), err);
    BOOST_TEST(std::count(err.begin(), err.end(), '\n') == 1, err);
  }

  static constexpr std::uint32_t buffer = 0x1004'B000;  // behind the image
  static constexpr std::array<unsigned, 8> lines{0, 1, 3, 4, 15, 16, 30, 31};
};

// Eight mistakes in eight lines each: all are found, at the very byte, and nothing else is.
BOOST_FIXTURE_TEST_CASE(flushes_that_are_missing_early_or_misplaced, Caches) {
  constexpr int never = 8;
  for (int mistake = 1; mistake <= never; ++mistake) {
    for (const unsigned line : lines) {
      const std::uint32_t byte = mistake == never ? 0 : 31;
      check(mistake, line,
            "a DMA reads " + vp::hex(buffer + 32 * line + byte) +
                (mistake == never ? ", which the program never flushed"
                                  : ", which the program wrote after it was flushed"));
    }
  }
  for (const int right : {0, 9, 10, 11}) {
    for (const unsigned line : {0u, 15u, 31u}) BOOST_TEST(errors(right, line) == "");
  }
}

// Ten mistakes in eight lines each.
BOOST_FIXTURE_TEST_CASE(invalidations_that_are_missing_early_or_misplaced, Caches) {
  constexpr int first = 13, drops = 21, dirty = 22;
  for (int mistake = first; mistake <= dirty; ++mistake) {
    const bool early = mistake == 14 || mistake == 20;
    for (const unsigned line : lines) {
      const std::string at = vp::hex(buffer + 32 * line);
      if (mistake == drops) {
        check(mistake, line,
              "reads " + at + ", which it wrote and then invalidated without a flush");
      } else if (mistake == dirty) {
        check(mistake, line,
              "a DMA is about to write the cache line of " + vp::hex(buffer + 32 * line + 31));
      } else {
        check(
            mistake, line,
            "reads " + at + ", which a DMA wrote " +
                (early ? "after the program invalidated it" : "and the program never invalidated"));
      }
    }
  }
  for (const int right : {12, 23, 24, 25, 26}) {
    for (const unsigned line : {0u, 15u, 31u}) BOOST_TEST(errors(right, line) == "");
  }
  BOOST_TEST(errors(first, 5, {"--set", "ps.cache_guard_steps=0"}) == "");
}

// What a DMA was ordered to write and has not yet, in eight lines each.
BOOST_FIXTURE_TEST_CASE(a_program_that_does_not_wait, Caches) {
  constexpr int all = 27, byte = 28, ends = 29, polls = 30, again = 31;
  const std::string why =
      ": S2MM of pl.axi_dma_1 had been ordered to write it and had not yet, so it saw what was "
      "there before; wait for the end of the transfer first [/markervp/cpu/not_awaited] at ";
  for (const unsigned line : lines) {
    const std::string at = vp::hex(buffer + 32 * line);
    check(all, line, "the program read " + at + why);
    const std::string once = errors(byte, line);
    BOOST_TEST(contains(once, "the program read " + at + " at "), once);
    BOOST_TEST(contains(once, why), once);
    BOOST_TEST(contains(once, "caches.cpp:"), once);
    const std::string open = errors(ends, line);
    BOOST_TEST(contains(open,
                        "the program ended while S2MM of pl.axi_dma_1 had written 0 of the "
                        "128 bytes at " +
                            vp::hex(buffer + 128 * (line / 4))),
               open);
    for (const int right : {polls, again}) BOOST_TEST(errors(right, line) == "");
  }
  BOOST_TEST(errors(all, 5, {"--set", "ps.cache_guard_steps=0"}) == "");
}

// The run ends with the program: what an engine was doing is said, and is no warning.
BOOST_FIXTURE_TEST_CASE(an_engine_that_runs_when_the_program_ends, Caches) {
  constexpr int left_sending = 32;
  const std::string said = errors(left_sending, 0, {"--strict"});
  BOOST_TEST(contains(said,
                      "pl.axi_dma_0: MM2S was sending 128 bytes when the program ended, and the "
                      "run with it: on the chip it runs on"),
             said);
  BOOST_TEST(!contains(said, "warning"), said);
}

// Races are reported once, with both places; what both cores wait for, by name.
BOOST_AUTO_TEST_CASE(two_cores_err_together) {
  const auto errors = [this](int mistake, int exit_code, const Words& more = {}) {
    const kit::Outcome outcome = run(mistake, more, MARKERVP_CORES);
    BOOST_TEST(outcome.exit_code == exit_code, outcome.err);
    return outcome.err;
  };
  BOOST_TEST(errors(0, 0) == "");
  for (const int race : {1, 2}) {
    const std::string err = errors(race, 0);
    for (const char* part :
         {"warning: ps.cpu", " writes 4 bytes, some of which ps.cpu", " wrote at ", "(pc 0x",
          "cores.cpp:", ", and nothing orders the two", "[/markervp/cpu/race] at ", ", pc 0x"}) {
      BOOST_TEST(contains(err, part), err);
    }
    BOOST_TEST(std::count(err.begin(), err.end(), '\n') == 1, err);
    const auto last = err.rfind("cores.cpp:");
    BOOST_TEST(err.find("cores.cpp:") < last, err);
    BOOST_TEST(errors(race, 0, {"--set", "ps.cpu.quantum=0 s"}) == err);
    BOOST_TEST(errors(race, 0, {"--fidelity", "clocked"}) == err);
  }
  const std::string deadlock = errors(3, 3);
  BOOST_TEST(contains(deadlock, "deadlock: ps.cpu waits for lock 'second', which ps.cpu1 has held"),
             deadlock);
  BOOST_TEST(contains(deadlock, ", ps.cpu1 waits for lock 'first', which ps.cpu has held since "),
             deadlock);
  BOOST_TEST(contains(deadlock, "take_both"), deadlock);
  BOOST_TEST(contains(errors(4, 3), "hal_cpu_start(1): the core was started already: ps.cpu1 "));
  const std::string fault = errors(5, 3);
  BOOST_TEST(contains(fault, "segmentation fault: write to 0x00000010"), fault);
  BOOST_TEST(contains(fault, " on cpu1 of program 'cores', pc 0x"), fault);
  BOOST_TEST(contains(fault, "second()+"), fault);
}

BOOST_AUTO_TEST_CASE(a_warning_leads_to_the_line) {
  const std::string err = run(14).err;
  BOOST_TEST(contains(err, "[/markervp/axi_dma/past_buffer] at "), err);
  BOOST_TEST(contains(err, "careless.cpp:"), err);
  BOOST_TEST(contains(err, ", called from "), err);
  const kit::Outcome strip = shell("strip -o stripped.so '" + std::string(MARKERVP_CARELESS) + "'");
  BOOST_TEST_REQUIRE(strip.exit_code == 0);
  const std::string stripped = run(14, {}, "./stripped.so").err;
  BOOST_TEST(contains(stripped, "[/markervp/axi_dma/past_buffer] at "), stripped);
  BOOST_TEST(contains(stripped, ", pc 0x"), stripped);
  BOOST_TEST(!contains(stripped, "careless.cpp"), stripped);
}

BOOST_AUTO_TEST_CASE(warnings_are_failures_for_the_strict) {
  BOOST_TEST(run(0).exit_code == 0);
  const Words stored{"--strict", "--set", "sw.upload=0"};
  const kit::Outcome outcome = run(14, stored);
  BOOST_TEST(outcome.exit_code == 1);
  BOOST_TEST(contains(outcome.err, "--strict lets none pass"), outcome.err);
  const auto result = nlohmann::json::parse(kit::read_file(*this / "out/result.json"));
  BOOST_TEST(result["frames"].size() == 1u);
  BOOST_TEST(start({"run", "z1.0", "--no-pictures", "--strict"}).exit_code == 0);
}

BOOST_AUTO_TEST_SUITE_END()
