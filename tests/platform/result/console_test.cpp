#include <result/console.h>

#include <vp/text.h>
#include <boost/test/unit_test.hpp>

#include <marker/report/marker_text.h>
#include "report_kit.h"

using namespace platform;
using namespace report_test;

namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

void check_width(const std::string& text) {
  for (const std::string& line : vp::split(text, '\n')) {
    BOOST_TEST(line.size() <= result::console_width, line);
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(console)

BOOST_AUTO_TEST_CASE(a_frame_in_a_few_lines) {
  const std::string text = result::frame_text(found_frame("z1.0"), 41);
  check_width(text);
  BOOST_TEST(contains(text, "[ 1/41] z1.0: marker 0, upright\n"), text);
  BOOST_TEST(contains(text, "(322.00, 240.00)  (434.41, 240.00)"), text);
  BOOST_TEST(
      contains(
          text,
          "t (0.000, 0.000, 1.012) m   pitch 0.0 yaw 0.0 roll 0.0 deg   3 iterations to 0.25 px"),
      text);
  BOOST_TEST(contains(text, "corner 0.50 px   translation 12.0 mm   rotation 0.00 deg"), text);
  BOOST_TEST(
      contains(text, "31 corners   2 blobs   36 feature words   1 candidate   threshold 128"),
      text);
  BOOST_TEST(contains(text, "6144.5"), text);
}

BOOST_AUTO_TEST_CASE(small_errors_keep_two_digits) {
  facts::UnitReport frame = found_frame("z1.0");
  marker_frame(frame).markers[0].corners_px[0].x -= 2 - 0.0172;
  marker_frame(frame).markers[0].pose.translation[2] -= 0.012 - 0.0001654;
  const std::string text = result::frame_text(frame);
  BOOST_TEST(contains(text, "corner 0.0043 px   translation 0.165 mm   rotation 0.00 deg"), text);
}

BOOST_AUTO_TEST_CASE(a_frame_without_marker) {
  facts::UnitReport frame = found_frame("z1.0");
  marker_frame(frame).markers.clear();
  frame.warnings = {"3 features dropped"};
  const std::string text = result::frame_text(frame);
  BOOST_TEST(contains(text, "[1] z1.0: no marker\n"), text);
  BOOST_TEST(contains(text, "3 features dropped"), text);
}

BOOST_AUTO_TEST_CASE(a_wrong_marker_is_called_one) {
  facts::UnitReport frame = found_frame("z1.0");
  marker_frame(frame).markers[0].id = 3;
  marker_frame(frame).markers[0].rotation = 1;
  BOOST_TEST(contains(result::frame_text(frame), "marker 3, turned 90 deg clockwise"));
  BOOST_TEST(contains(result::frame_text(frame), "another marker: the scene has 0"));
}

BOOST_AUTO_TEST_CASE(many_stages_wrap) {
  facts::UnitReport frame = found_frame("z1.0");
  for (int i = 0; i < 12; ++i)
    frame.times.push_back({"further_stage_" + std::to_string(i), 1'000'000});
  check_width(result::frame_text(frame));
}

BOOST_AUTO_TEST_CASE(angles_are_those_of_the_scene) {
  BOOST_TEST(contains(result::frame_text(found_frame("yaw45")), "pitch 0.0 yaw 45.0 roll 0.0 deg"));
  BOOST_TEST(
      contains(result::frame_text(found_frame("pitch30")), "pitch 30.0 yaw 0.0 roll 0.0 deg"));
  BOOST_TEST(
      contains(result::frame_text(found_frame("roll60")), "pitch 0.0 yaw 0.0 roll 60.0 deg"));
}

BOOST_AUTO_TEST_CASE(the_summary_tells_fps_latency_errors_and_stages) {
  facts::Summary summary;
  summary.add(found_frame("z1.0", 0));
  facts::UnitReport wrong = found_frame("z2.0", 1);
  marker_frame(wrong).markers[0].id = 5;
  wrong.warnings = {"a word was lost"};
  summary.add(judged(wrong));
  const std::string text = result::summary_text(summary, run_facts(), marker_summary(summary));
  check_width(text);
  BOOST_TEST(contains(text, "2 frames, 2 with a marker, 1 of them a wrong one"), text);
  BOOST_TEST(contains(text, "FPS      mean 125.0   min 125.0   max 125.0"), text);
  BOOST_TEST(contains(text, "latency  mean 8.000 ms"), text);
  BOOST_TEST(contains(text,
                      "limit    feature extraction sets the frame rate: 6144.5 of 8000.0 us, one "
                      "stage follows the other\n"
                      "         faster with a higher ps.fclk_clk1.frequency\n"),
             text);
  BOOST_TEST(contains(text, "warnings in 1 frame, listed in result.json"), text);
  BOOST_TEST(
      contains(text,
               "corner 0.50 px   translation 12.0 mm   rotation 0.00 deg   (mean over 1 marker)"),
      text);
  BOOST_TEST(
      contains(text, "  feature_extraction        6144.5      6144.5      6144.5   76.8 % #######"),
      text);
}

BOOST_AUTO_TEST_CASE(a_run_that_gave_up_has_no_rate) {
  facts::Summary summary;
  facts::UnitReport frame = given_up_frame("z1.0");
  BOOST_TEST(contains(result::frame_text(frame),
                      "[1] z1.0: no result, the software gave up: binary image timed out\n"));
  summary.add(judged(frame));
  std::string text = result::summary_text(summary, run_facts(), marker_summary(summary));
  check_width(text);
  BOOST_TEST(contains(text, "1 frame, 0 with a marker, 1 without a result"), text);
  BOOST_TEST(contains(text, "no result: there is no frame rate and no latency"), text);
  BOOST_TEST(!contains(text, "FPS"), text);
  summary.add(found_frame("z1.0", 1));
  text = result::summary_text(summary, run_facts(), marker_summary(summary));
  BOOST_TEST(contains(text, "2 frames, 1 with a marker, 1 without a result"), text);
  BOOST_TEST(contains(text, "FPS      mean 62.5"), text);
}

BOOST_AUTO_TEST_CASE(parts_stand_below_the_stage_that_contains_them) {
  facts::UnitReport frame = found_frame("z1.0");
  frame.times = {{"upload", 3'000'000'000},
                 {"capture", 2'000'000'000, 0, "feature_extraction"},
                 {"threshold", 4'000'000'000, 0, "feature_extraction"},
                 {"feature_extraction", 6'000'000'000, 0, "frame"},
                 {"pose", 2'000'000'000, 0, "frame"},
                 {"frame", 8'000'000'000}};
  facts::Summary summary;
  summary.add(judged(frame));
  const std::string text = result::summary_text(summary, run_facts(), marker_summary(summary));
  check_width(text);
  const auto line = [](const std::string& name, const std::string& us, const std::string& share) {
    const std::string time = std::string(12 - us.size(), ' ') + us;
    std::string wanted = name + std::string(22 - name.size(), ' ') + time + time + time;
    return share.empty() ? wanted + "\n" : wanted + "  " + share;
  };
  const std::string lines[] = {line("upload", "3000.0", ""),
                               line("frame", "8000.0", ""),
                               line("  feature_extraction", "6000.0", " 75.0 % #######"),
                               line("    capture", "2000.0", " 25.0 % #######"),
                               line("    threshold", "4000.0", " 50.0 % #######"),
                               line("  pose", "2000.0", " 25.0 % #######")};
  std::size_t at = 0;
  for (const std::string& wanted : lines) {
    at = text.find(wanted, at);
    BOOST_TEST_REQUIRE(at != std::string::npos, wanted << " is not in its place in\n" << text);
  }
}

BOOST_AUTO_TEST_CASE(timing_is_met_missed_or_unknown) {
  facts::TimingReport timing;
  timing.met = false;
  timing.modules = {{"a", "clk", 120, 100, 400, false, -16.7, "published", ""},
                    {"b", "clk", 120, 100, 400, false, -16.7, "published", ""},
                    {"c", "clk", 120, 130, 130, true, 8.3, "published", ""}};
  const auto text = [&] { return result::design_text(facts::PowerReport{}, {}, timing); };
  BOOST_TEST(
      contains(text(), "timing   unknown for a and 1 more: 120 MHz, known to work up to 100 MHz\n"),
      text());
  timing.modules[2].met = false;
  timing.modules[2].frequency_mhz = 140;
  BOOST_TEST(contains(text(), "timing   MISSED by c: 140 MHz, at most 130 MHz\n"), text());
  timing = {true,
            {{"a", "clk", 100, 108, 188, true, 8, "synthesised", ""},
             {"b", "clk", 100, 106, 192, true, 6, "synthesised", ""}}};
  BOOST_TEST(contains(text(), "timing   met, 6 % to spare (b, perhaps 92 %)\n"), text());
}

BOOST_AUTO_TEST_CASE(the_busiest_rtl_comes_first_on_a_line_that_fits) {
  facts::PowerReport power;
  power.activity = {{"pl.filter", 0.003, 100}, {"pl.cipher", 0.412, 200}};
  const auto text = [&] { return result::design_text(power, {}, {}); };
  BOOST_TEST(contains(text(), "activity pl.cipher 0.412, pl.filter 0.003   changes a bit"), text());
  for (int i = 0; i < 30; ++i) power.activity.push_back({"pl.part_" + std::to_string(i), 0.1, 10});
  check_width(text());
  BOOST_TEST(contains(text(), "activity pl.cipher 0.412, pl.part_0 0.100"), text());
  BOOST_TEST(contains(text(), "others   changes a bit"), text());
  power.activity.clear();
  BOOST_TEST(!contains(text(), "activity"), text());
}

BOOST_AUTO_TEST_CASE(the_verdict_says_how_far_or_why_not) {
  facts::Summary summary;
  summary.add(found_frame("z1.0"));
  facts::RunFacts run = run_facts();
  run.end = {0, 1'250'000'000, false, {}};
  run.resources.emplace();
  run.resources->total.lut = 100;
  run.resources->available.lut = 150;
  run.clocks.emplace();
  run.timing = {true, {{"a", "clk", 100, 110, 110, true, 10, "published", ""}}};
  std::string text = result::summary_text(summary, run);
  BOOST_TEST(contains(text, "\nverdict  feasible   to spare: fits 50 % (lut), timing 10 % (a)\n"),
             text);
  run.timing->modules[0].met = false;
  run.timing->modules[0].fmax_high_mhz = 400;
  text = result::summary_text(summary, run);
  BOOST_TEST(contains(text, "\nverdict  unknown: timing unknown for a\n"), text);
  run.end->exit_code = 1;
  text = result::summary_text(summary, run);
  BOOST_TEST(contains(text,
                      "\nverdict  INFEASIBLE: the program ended with exit code 1\n"
                      "         timing unknown for a\n"),
             text);
  check_width(text);
}

BOOST_AUTO_TEST_CASE(an_empty_run) {
  facts::RunFacts run = run_facts();
  BOOST_TEST(contains(result::summary_text({}, run), "no frames: the program was stopped   ("));
  run.end = {7, 1'250'000'000, false, {}};
  BOOST_TEST(contains(result::summary_text({}, run),
                      "no frames: the program ended at 1.25 ms with exit code 7   ("));
  run.end = {0, 1'250'000'000, false, 250'000'000};
  BOOST_TEST(
      contains(result::summary_text({}, run),
               "no frames: main() returned at 250 us with exit code 0; interrupts were still "
               "on, or the other core, and did their last work at 1.25 ms   ("));
  run.end->reached_limit = true;
  BOOST_TEST(contains(result::summary_text({}, run),
                      "until the time limit, 1.25 ms (ps.cpu.after_main)   ("));
}

BOOST_AUTO_TEST_SUITE_END()
