// Jitter, evidence and files.
#include <chip/run/cost_profile.h>
#include <marker/scene/renderer.h>
#include <marker/scene/scene.h>
#include <marker/validation/measured.h>
#include <marker/validation/validation.h>
#include <vp/error.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "synthetic.h"
#include "temporary_files.h"

using namespace platform::validation;
namespace fs = std::filesystem;

namespace {

Validation validation(const synthetic::Measured& measured, std::uint32_t repetitions = 1) {
  const auto profile = platform::profiles::load_cost_profile("thesis", std::nullopt);
  return validate_runs(measured, profile, synthetic::published(), repetitions);
}

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(validation_report)

BOOST_AUTO_TEST_CASE(once_is_exact_and_repetitions_deviate_as_published) {
  const synthetic::Measured measured = synthetic::all_images();
  BOOST_TEST(repeated(measured.hybrid, 1).frames[3].times_us == measured.hybrid.frames[3].times_us);
  const auto deviation = [&](const Run& run, std::uint32_t repetitions) {
    const Run jittered = repeated(run, repetitions);
    std::vector<double> changes;
    for (std::size_t i = 0; i < run.frames.size(); ++i) {
      changes.push_back(jittered.frames[i].times_us.at("frame") -
                        run.frames[i].times_us.at("frame"));
    }
    return mean_of(changes);
  };
  // 316 means of 20: 20 us / sqrt(20).
  for (const Run* run : {&measured.hybrid, &measured.ps_only}) {
    const Measurement change = deviation(*run, 20);
    BOOST_TEST(std::abs(change.value) < 1);
    BOOST_TEST(change.spread.value() > 4.0);
    BOOST_TEST(change.spread.value() < 5.0);
  }
  BOOST_TEST(repeated(measured.hybrid, 20).frames[3].times_us ==
             repeated(measured.hybrid, 20).frames[3].times_us);
}

BOOST_AUTO_TEST_CASE(jitter_keeps_the_sum_of_the_stages) {
  const synthetic::Measured measured = synthetic::all_images();
  const Frame fast = repeated(measured.hybrid, 5).frames[7];
  BOOST_TEST(fast.ms("frame") == fast.ms("feature_extraction") + fast.ms("receive") +
                                     fast.ms("evaluation") + fast.ms("identification") +
                                     fast.ms("pose"),
             boost::test_tools::tolerance(1e-9));
  const Frame slow = repeated(measured.ps_only, 5).frames[7];
  BOOST_TEST(slow.ms("feature_extraction") == slow.ms("capture") + slow.ms("corner_detection") +
                                                  slow.ms("threshold") + slow.ms("blob_detection"),
             boost::test_tools::tolerance(1e-9));
  BOOST_TEST(slow.ms("frame") == slow.ms("feature_extraction") + slow.ms("evaluation") +
                                     slow.ms("identification") + slow.ms("pose"),
             boost::test_tools::tolerance(1e-9));
  BOOST_TEST(slow.ms("capture") == 6);
}

BOOST_AUTO_TEST_CASE(orders_of_the_squares_span_what_is_possible) {
  // 2 ms for the marker, 1 ms for each of 14 squares: seven candidates' worth of time before it.
  const auto study = study_orders(synthetic::all_images(), 9, 4.2, 5);
  BOOST_TEST_REQUIRE(study.has_value());
  BOOST_TEST(study->orders == 3432u);
  // All seven last: 1/7 to 7/7 of 14 ms in the last seven images; all first: in the first.
  BOOST_TEST(study->least_ms == 2 + (2 + 4 + 6 + 8 + 10 + 12 + 14) / 15.0,
             boost::test_tools::tolerance(1e-9));
  BOOST_TEST(study->most_ms == 2 + (56 + 7 * 14) / 15.0, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(study->identification > 0u);
  BOOST_TEST(study->both <= std::min(study->identification, study->speedup));
  BOOST_TEST(study_orders(synthetic::all_images(), 100, 4.2, 5)->identification == 0u);
}

BOOST_AUTO_TEST_CASE(turned_pictures_tell_what_the_speed_up_would_cost) {
  synthetic::Measured measured = synthetic::all_images();
  for (Frame& frame : measured.ps_only.frames) {
    if (frame.group != "roll") continue;
    frame.times_us["corner_detection"] += 2200;
    frame.times_us["frame"] += 2200;
  }
  // 12 of 22 images cost 2.2 ms more, 1.2 ms on average.
  const double mean_ms = 78 + 1.2, asked = 8.5;
  const auto study = study_turns(measured, asked);
  BOOST_TEST_REQUIRE(study.has_value());
  BOOST_TEST(study->excess_ms == 1.2, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(study->asked_ms == 85, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(study->lacking_ms == 85 - mean_ms, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(study->growth == 1 + (54.0 / 40 - 1) * (1 + (85 - mean_ms) / 1.2),
             boost::test_tools::tolerance(1e-9));
}

/// Pixels that pass the pre-test of FAST: two adjacent ones of the four compass pixels at distance
/// 3 are brighter by more than `threshold`.
std::uint64_t count_evaluated(const platform::GreyImage& image, int threshold) {
  constexpr int radius = 3;
  std::uint64_t count = 0;
  for (int y = radius; y < image.height - radius; ++y) {
    for (int x = radius; x < image.width - radius; ++x) {
      const int limit = image.at(x, y) + threshold;
      const bool vertical = image.at(x, y - radius) > limit || image.at(x, y + radius) > limit;
      if (vertical && (image.at(x - radius, y) > limit || image.at(x + radius, y) > limit)) ++count;
    }
  }
  return count;
}

BOOST_AUTO_TEST_CASE(turned_edges_have_less_than_twice_the_pixels_that_squares_bring) {
  const auto evaluated = [](const std::vector<std::string>& scenes) {
    double sum = 0;
    for (const std::string& scene : scenes) {
      const auto count = count_evaluated(platform::render(platform::make_scene(scene)), 30);
      sum += static_cast<double>(count) / static_cast<double>(scenes.size());
    }
    return sum;
  };
  std::vector<std::string> turned;
  for (const platform::SceneGroup& group : platform::scene_groups()) {
    if (group.section.substr(0, 5) != "5.2.3") continue;
    turned.insert(turned.end(), group.scenes.begin(), group.scenes.end());
  }
  BOOST_TEST(turned.size() == 22u);
  const double turns = evaluated(turned) - evaluated({"z1.0"});
  const double squares = evaluated({"squares15"}) - evaluated({"squares1"});
  BOOST_TEST(turns / squares == 1.57, boost::test_tools::tolerance(0.01));
}

BOOST_AUTO_TEST_CASE(files_have_all_rows_and_frames) {
  const Validation v = validation(synthetic::all_images());
  BOOST_TEST(lines(rows_csv(v)) == 1 + v.rows.size());
  BOOST_TEST(lines(frames_csv(v)) == 1 + 2 * v.measured.hybrid.frames.size());
  const auto json = nlohmann::json::parse(json_text(v));
  BOOST_TEST(json.at("rows").size() == v.rows.size());
  BOOST_TEST(json.at("fitted").size() == v.fitted.size());
  BOOST_TEST(json.at("passed").get<bool>() == v.passed());
  for (const auto& row : json.at("rows")) BOOST_TEST(row.contains("verdict"));
}

BOOST_AUTO_TEST_CASE(the_console_names_rows_constants_reasons_and_failed_gates) {
  const Validation v = validation(synthetic::all_images());
  const std::string text = console_text(v);
  BOOST_TEST(!v.passed());
  for (const char* part : {"scale of corner_detection", "speedup.all", "used for calibration",
                           "predicted", "MISSED", "[1] ", "validation FAILED: "}) {
    BOOST_TEST(text.find(part) != std::string::npos, part);
  }
}

BOOST_AUTO_TEST_CASE(another_profile_is_fitted_to_nothing) {
  const auto profile = platform::profiles::load_cost_profile("a9-O0", std::nullopt);
  synthetic::Measured measured = synthetic::all_images();
  measured.hybrid.profile = measured.ps_only.profile = "a9-O0";
  const Validation plain = validate_runs(measured, profile, synthetic::published(), 1);
  BOOST_TEST(plain.fitted.empty());
  measured.hybrid.profile = measured.ps_only.profile = "thesis-O2";
  const Validation fast = validation(measured);
  for (const Validation* v : {&plain, &fast}) {
    for (const Row& row : v->rows) {
      BOOST_TEST((row.use == Use::predicted || row.use == Use::taken), row.published.id);
    }
  }
}

BOOST_AUTO_TEST_CASE(runs_on_different_images_are_refused) {
  synthetic::Measured measured = synthetic::all_images();
  measured.ps_only.frames.pop_back();
  BOOST_CHECK_THROW(validation(measured), vp::InputError);
}

BOOST_AUTO_TEST_CASE(every_row_is_in_the_page) {
  const Validation v = validation(synthetic::all_images());
  const std::string page = markdown_text(v);
  for (const Row& row : v.rows) {
    if (row.kind == Kind::given) continue;
    BOOST_TEST(page.find("| `" + row.published.id + "`") != std::string::npos, row.published.id);
  }
}

BOOST_AUTO_TEST_SUITE_END()
