// Each row's formula, on frames made by hand.
#include <validation/judgement.h>
#include <vp/error.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <numeric>

#include "synthetic.h"

using namespace platform::validation;

namespace {

/// Squares more than one in the 15 images.
constexpr int images = 15;

/// Mean of f(0) to f(14).
template <typename F>
double mean_over_squares(F f) {
  double sum = 0;
  for (int more = 0; more < images; ++more) sum += f(more);
  return sum / images;
}

double hybrid_ms(double more) {
  return 8 + 2 + more;
}
double ps_ms(double more) {
  return 6 + 40 + more + 10 + 20 + 2 * more + 1 + more / 2 + 1;
}
double speedup(double more) {
  return ps_ms(more) / hybrid_ms(more);
}

/// What the formulas must give, by ID.
const std::map<std::string, double>& expected() {
  static const std::map<std::string, double> values{
      {"fps.average", (41 * 1000 / hybrid_ms(0) +
                       images * mean_over_squares([](double m) { return 1000 / hybrid_ms(m); })) /
                          56},
      {"speedup.all", (2 * speedup(0) + mean_over_squares(speedup)) / 3},
      {"speedup.translation", speedup(0)},
      {"speedup.rotation", speedup(0)},
      {"speedup.features", mean_over_squares(speedup)},
      {"speedup.features.first", speedup(0)},
      {"speedup.features.last", speedup(14)},
      {"delta.features", mean_over_squares([](double m) { return ps_ms(m) - hybrid_ms(m); })},
      {"capture.offset", 6000},
      {"corner.hybrid", 7000},
      {"corner.delta", 47 - 7},
      {"corner.speedup", 47.0 / 7},
      {"corner.growth.hybrid", 1},
      {"corner.growth.ps", 54.0 / 40},
      {"blob.hybrid", 6000},
      {"blob.delta", 34 - 6},
      {"blob.speedup", 34.0 / 6},
      {"blob.growth.hybrid", 1},
      {"blob.growth.ps", 48.0 / 20},
      {"threshold.ps", 10},
      {"threshold.hybrid", 6},
      {"threshold.speedup", 10.0 / 6},
      {"threshold.delta", 4},
      {"identification.hybrid", 9},
      {"identification.speedup", 0.5},
      {"identification.share.hybrid.first", 100 * 2.0 / hybrid_ms(0)},
      {"identification.share.hybrid.last", 100 * 16.0 / hybrid_ms(14)},
      {"identification.share.ps.first", 100 * 1.0 / ps_ms(0)},
      {"identification.share.ps.last", 100 * 8.0 / ps_ms(14)},
      {"pose.duration", 500},
      {"pose.iterations", 2},
      {"jitter.ps", 20},
      {"jitter.pl", 1},
      {"corner.error.translation", 1.5 * 3},
      {"corner.error.roll", 1.5 * 3},
      {"pose.all.translation", 30},
      {"pose.all.rotation", 4},
  };
  return values;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(rows)

BOOST_AUTO_TEST_CASE(every_formula_gives_what_the_frames_say) {
  const auto rows = judge_rows(synthetic::published(), synthetic::all_images(), {});
  for (const Row& row : rows) {
    BOOST_TEST_CONTEXT(row.published.id) {
      if (row.kind == Kind::estimate) {
        BOOST_TEST(!row.modelled.has_value());
        BOOST_TEST((row.verdict == Verdict::absent));
        continue;
      }
      BOOST_TEST_REQUIRE(row.modelled.has_value());
      double value = 100;  // all widths
      if (row.kind == Kind::accuracy) {
        value = row.published.unit == "mm" ? 30 : 4;
      }
      const auto known = expected().find(row.published.id);
      if (known != expected().end()) value = known->second;
      BOOST_TEST(row.modelled->value == value, boost::test_tools::tolerance(1e-12));
      BOOST_TEST(row.difference_percent == 100 * (value / row.published.value - 1),
                 boost::test_tools::tolerance(1e-9));
    }
  }
}

BOOST_AUTO_TEST_CASE(rows_take_the_frames_of_their_test_only) {
  synthetic::Measured measured = synthetic::all_images();
  for (Frame& frame : measured.hybrid.frames) {
    if (frame.group == "pitch") frame.found->rotation_deg = 10;
    if (frame.group == "y") frame.found->corner_px = 2.5;
    if (frame.input == "z3.5") frame.found->width_px = 33;
    if (frame.group == "front") frame.found->rotation_deg = 90;
  }
  const auto rows = judge_rows(synthetic::published(), measured, {});
  BOOST_TEST(synthetic::row(rows, "pose.pitch.rotation").modelled->value == 10);
  BOOST_TEST(synthetic::row(rows, "pose.yaw.rotation").modelled->value == 4);
  BOOST_TEST(synthetic::row(rows, "corner.error.translation").modelled->value == 6,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(synthetic::row(rows, "table5.3.width.3.5m").modelled->value == 33);
  BOOST_TEST(synthetic::row(rows, "pose.all.rotation").modelled->value == (36 * 4 + 5 * 10) / 41.0,
             boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(power_and_clocks_are_read_where_a_run_has_them) {
  synthetic::Measured measured = synthetic::all_images();
  measured.hybrid.root = nlohmann::json::parse(R"({
    "summary": {"power_w": {"ps": 1.5}},
    "power": {"modules": [{"name": "pl.blob_detection", "w": 0.1},
                          {"name": "pl.blob_detection_2", "w": 0.1},
                          {"name": "pl.blob_detection", "w": 0.2}]},
    "timing": {"modules": [{"name": "pl.corner_detection", "fmax_mhz": 110},
                           {"name": "pl.blob_detection", "fmax_mhz": 55}]}})");
  const auto rows = judge_rows(synthetic::published(), measured, {});
  BOOST_TEST((synthetic::row(rows, "power.cpu").verdict == Verdict::met));
  BOOST_TEST((synthetic::row(rows, "power.cpu").use == Use::predicted));
  BOOST_TEST((synthetic::row(rows, "power.blob").verdict == Verdict::missed));
  BOOST_TEST(synthetic::row(rows, "power.blob").modelled->value == 0.3,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST((synthetic::row(rows, "fmax.blob").verdict == Verdict::met));
  BOOST_TEST((synthetic::row(rows, "fmax.blob").use == Use::taken));
  BOOST_TEST((synthetic::row(rows, "fmax.corner").verdict == Verdict::met), "a lower bound");
  BOOST_TEST((synthetic::row(rows, "fmax.threshold").verdict == Verdict::absent));
}

BOOST_AUTO_TEST_CASE(spreads_are_deviations_of_the_sample) {
  BOOST_TEST(mean_of({1, 2, 3, 4}).value == 2.5);
  BOOST_TEST(mean_of({1, 2, 3, 4}).spread.value() == std::sqrt(5.0 / 3),
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(!mean_of({1}).spread.has_value());
}

BOOST_AUTO_TEST_CASE(a_stage_that_is_missing_is_named) {
  synthetic::Measured measured = synthetic::all_images();
  for (Frame& frame : measured.ps_only.frames) frame.times_us.erase("corner_detection");
  try {
    judge_rows(synthetic::published(), measured, {});
    BOOST_ERROR("nothing was refused");
  } catch (const vp::InputError& error) {
    BOOST_TEST(std::string(error.what()).find("'corner_detection'") != std::string::npos);
  }
}

BOOST_AUTO_TEST_CASE(a_value_without_a_rule_is_refused) {
  Published unknown;
  unknown.id = "coffee";
  BOOST_CHECK_THROW(judge_rows({unknown}, synthetic::all_images(), {}), vp::InputError);
}

BOOST_AUTO_TEST_SUITE_END()
