// What counts as a result, and that nothing is lost without a word.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "executable.h"
#include "platform_run.h"

using namespace integration;

namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const auto near = boost::test_tools::tolerance(1e-9);

/// Dark dots on bright ground, each of them a corner: more than 11 000.
platform::GreyImage dots() {
  platform::GreyImage image{640, 480, std::vector<std::uint8_t>(640 * 480, 255)};
  for (int y = 8; y < 472; y += 5) {
    for (int x = 8; x < 632; x += 5) image.pixels[static_cast<std::size_t>(y * 640 + x)] = 0;
  }
  return image;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(figures)

BOOST_AUTO_TEST_CASE(the_documentation_lists_every_figure) {
  const Workplace place;
  const kit::Outcome outcome =
      kit::run_process(MARKERVP_EXECUTABLE, {"metrics", "--markdown"}, place.path());
  const std::string page =
      kit::read_file(std::filesystem::path(MARKERVP_SOURCE) / "docs/figures.md");
  BOOST_TEST((page == outcome.out),
             "docs/figures.md is old: markervp metrics --markdown > docs/figures.md");
}

// Words are dropped, so the DMA never finishes the last burst: the software gives every frame up.
BOOST_AUTO_TEST_CASE(a_frame_without_result_makes_no_rate) {
  for (const char* depth : {"1", "4"}) {
    const Workplace place;
    const kit::Outcome outcome =
        place.run({"demo", "--set", "pl.burst_words=2", "--set",
                   std::string("pl.axi_threshold_bridge.fifo_depth=") + depth});
    BOOST_TEST(outcome.exit_code == 1);
    BOOST_TEST(contains(outcome.out, "demo: no result, the software gave up: "), outcome.out);
    BOOST_TEST(contains(outcome.out, "1 frame, 0 with a marker, 1 without a result"), outcome.out);
    BOOST_TEST(contains(outcome.out, "no result: there is no frame rate and no latency"));
    BOOST_TEST(!contains(outcome.out, "FPS"), outcome.out);
    const Json result = place.result();
    const Json& summary = result["summary"];
    BOOST_TEST(summary["frames"] == 1);
    BOOST_TEST(summary["delivered"] == 0);
    for (const char* key : {"fps", "latency_us", "energy_per_frame_mj"})
      BOOST_TEST(!summary.contains(key), key);
    BOOST_TEST(summary["power_w"]["total"].get<double>() > 2.0);
    BOOST_TEST(contains(result["frames"][0]["gave_up"].get<std::string>(), "binary image"));
    BOOST_TEST(!result["frames"][0].contains("energy_mj"));
    BOOST_TEST(!result.contains("stages"));
  }
}

// Three frames of equal work, of which the second is given up.
BOOST_AUTO_TEST_CASE(time_and_energy_of_a_frame_given_up_are_those_of_the_next_result) {
  const Workplace place;
  const kit::Outcome outcome =
      place.run({"demo", "z1.0", "z2.0", "--program", MARKERVP_LOSSES, "--no-pictures"});
  BOOST_TEST_REQUIRE(outcome.exit_code == 0, outcome.err);
  const Json result = place.result();
  const Json &summary = result["summary"], &frames = result["frames"];
  BOOST_TEST(summary["frames"] == 3);
  BOOST_TEST(summary["delivered"] == 2);
  const auto us = [&](int frame) { return frames[frame]["time_us"]["frame"].get<double>(); };
  const double whole = us(0) + us(1) + us(2);
  // The stamps leave a few cycles between the frames out.
  BOOST_TEST(summary["fps"]["mean"].get<double>() == 2e6 / whole,
             boost::test_tools::tolerance(1e-3));
  BOOST_TEST(summary["fps"]["min"].get<double>() == 1e6 / (us(1) + us(2)),
             boost::test_tools::tolerance(1e-3));
  BOOST_TEST(summary["latency_us"]["mean"].get<double>() == (us(0) + us(2)) / 2, near);
  BOOST_TEST(!frames[1].contains("energy_mj"));
  const double energy =
      frames[0]["energy_mj"]["total"].get<double>() + frames[2]["energy_mj"]["total"].get<double>();
  const double per_frame = summary["energy_per_frame_mj"];
  BOOST_TEST(energy == 2 * per_frame, near);
  BOOST_TEST(per_frame * summary["fps"]["mean"].get<double>() / 1e3 ==
                 summary["power_w"]["total"].get<double>(),
             boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(a_frame_of_which_the_program_says_nothing_is_judged) {
  const Workplace place;
  const kit::Outcome outcome =
      place.run({"demo", "--repeat", "5", "--program", MARKERVP_LOSSES, "--no-pictures"});
  BOOST_TEST_REQUIRE(outcome.exit_code == 0, outcome.err);
  const Json result = place.result();
  BOOST_TEST(result["summary"]["frames"] == 4);
  BOOST_TEST(result["summary"]["unpublished"] == 1);
  const Json& job = result["verdict"]["job"];
  BOOST_TEST(job["holds"] == "no");
  BOOST_TEST(contains(job["why"], "1 of 5 frames taken and never published"), job);
  BOOST_TEST(contains(outcome.out, "1 never published"), outcome.out);
}

BOOST_AUTO_TEST_CASE(all_that_software_loses_is_counted_and_told) {
  const Workplace place;
  const kit::Outcome outcome = place.run({"--program", MARKERVP_LOSSES, "--no-pictures"});
  const Json frame = place.result()["frames"][0];
  BOOST_TEST(frame["counts"]["software_overflow"] == 1 + 2 + 3 + 4);
  BOOST_TEST(frame["counts"]["malformed"] == 5);
  for (const char* warning :
       {"1 feature words without room", "2 corners without room", "3 blobs without room",
        "4 candidates without room", "5 malformed blobs"}) {
    BOOST_TEST(contains(frame["warnings"].dump(), warning), frame["warnings"].dump());
    BOOST_TEST(contains(outcome.out, warning), outcome.out);
  }
}

BOOST_AUTO_TEST_CASE(more_corners_than_the_software_has_room_for_are_warned_of) {
  const PlatformRun run = run_images({dots()}, {}, System::ps_only);
  const platform::facts::UnitReport& frame = run.frames.at(0);
  BOOST_TEST(frame.counts["corners"] > 8192u);
  BOOST_TEST(frame.counts["software_overflow"] == frame.counts["corners"] - 8192);
  BOOST_TEST(
      std::any_of(frame.warnings.begin(), frame.warnings.end(), [](const std::string& warning) {
        return contains(warning, "corners without room in the software");
      }));
}

BOOST_AUTO_TEST_CASE(stages_say_which_contains_which) {
  for (const char* system : {"hybrid", "ps-only"}) {
    const Workplace place;
    const kit::Outcome outcome = place.run({"--no-pictures", "--program", system});
    const Json result = place.result();
    // What is part of something and has no parts itself fills the frame.
    double sum = 0;
    for (const Json& stage : result["stages"]) {
      bool has_parts = false;
      for (const Json& other : result["stages"])
        has_parts = has_parts || other.value("part_of", "") == stage["name"];
      if (stage.contains("part_of") && !has_parts)
        sum += result["frames"][0]["time_us"][stage["name"].get<std::string>()].get<double>();
    }
    BOOST_TEST(sum == result["frames"][0]["time_us"]["frame"].get<double>(),
               boost::test_tools::tolerance(1e-4));
    BOOST_TEST(contains(outcome.out, "\n    corner_detection ") ==
               (std::string(system) == "ps-only"));
  }
}

BOOST_AUTO_TEST_CASE(timing_above_a_lower_bound_is_unknown_not_missed) {
  const Workplace place;
  const kit::Outcome outcome =
      place.run({"-q", "--no-pictures", "--set", "ps.fclk_clk0.frequency=120 MHz"});
  BOOST_TEST(contains(outcome.err, "whether timing is met is not known"), outcome.err);
  BOOST_TEST(contains(outcome.out, "timing   unknown for "), outcome.out);
  BOOST_TEST(!contains(outcome.out, "MISSED"), outcome.out);
}

BOOST_AUTO_TEST_SUITE_END()
