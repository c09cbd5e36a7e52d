#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <numeric>

#include <marker/validation/published.h>
#include <marker/validation/validation.h>
#include <vp/error.h>

#include "synthetic.h"

using namespace platform::validation;

namespace {

Published value_of(const std::string& id, double value, int decimals) {
  Published published;
  published.id = id;
  published.unit = "x";
  published.value = value;
  published.decimals = decimals;
  return published;
}

/// The row when the model gives `modelled` for a published value. All frames of the hybrid system
/// take 10 ms in translation tests, so the PS-only time decides the speed-up.
Row judged(const std::string& id, double value, int decimals, double modelled) {
  synthetic::Measured measured = synthetic::all_images();
  for (Frame& frame : measured.hybrid.frames) frame.times_us["frame"] = 10'000;
  for (Frame& frame : measured.ps_only.frames) frame.times_us["frame"] = 10'000 * modelled;
  return judge_rows({value_of(id, value, decimals)}, measured, {}).front();
}

/// A row that is met by construction, of a kind and use.
Row row_with(Verdict verdict, Use use) {
  Row row;
  row.published.id = "some.row";
  row.verdict = verdict;
  row.use = use;
  return row;
}

bool passes(const std::vector<Gate>& gates, const std::string& part) {
  for (const Gate& gate : gates) {
    if (gate.name.find(part) != std::string::npos) return gate.passed;
  }
  throw std::out_of_range(part);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(judgement)

BOOST_AUTO_TEST_CASE(a_row_is_met_within_the_band) {
  BOOST_TEST((judged("speedup.translation", 12.6, 1, 12.6 * 1.0499).verdict == Verdict::met));
  BOOST_TEST((judged("speedup.translation", 12.6, 1, 12.6 * 0.9501).verdict == Verdict::met));
  const Row high = judged("speedup.translation", 12.6, 1, 12.6 * 1.06);
  BOOST_TEST((high.verdict == Verdict::missed));
  BOOST_TEST(!high.reason.empty());
  BOOST_TEST((judged("speedup.translation", 12.6, 1, 12.6 * 0.94).verdict == Verdict::missed));
}

BOOST_AUTO_TEST_CASE(few_digits_stand_for_the_values_that_round_to_them) {
  BOOST_TEST((judged("speedup.translation", 7, 0, 6.2).verdict == Verdict::met_rounded));
  BOOST_TEST((judged("speedup.translation", 7, 0, 6.1).verdict == Verdict::missed));
  BOOST_TEST((judged("speedup.translation", 7, 1, 6.2).verdict == Verdict::missed));
  BOOST_TEST(judged("speedup.translation", 7, 0, 6.2).difference_percent == 100 * (6.2 / 7 - 1),
             boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(a_known_reason_explains_no_more_than_it_says) {
  for (const KnownMiss& known : known_misses()) {
    BOOST_TEST(find_rule(known.id) != nullptr, known.id);
    BOOST_TEST(known.least_percent < known.most_percent, known.id);
    BOOST_TEST(!known.reason.empty(), known.id);
  }
  const KnownMiss& known = *find_known_miss("speedup.rotation");
  const auto at = [&](double percent) {
    return judged("speedup.rotation", 14, 1, 14 * (1 + percent / 100)).verdict;
  };
  BOOST_TEST((at((known.least_percent + known.most_percent) / 2) == Verdict::known_miss));
  BOOST_TEST((at(known.least_percent - 1) == Verdict::missed));
  BOOST_TEST((at(-known.most_percent) == Verdict::missed));
  BOOST_TEST((at(0) == Verdict::met));
}

BOOST_AUTO_TEST_CASE(use_tells_what_a_value_was_fitted_to) {
  const auto rows = judge_rows(synthetic::published(), synthetic::all_images(),
                               {"corner.delta", "corner.hybrid", "threshold.ps"});
  BOOST_TEST((synthetic::row(rows, "corner.delta").use == Use::calibration));
  BOOST_TEST((synthetic::row(rows, "corner.speedup").use == Use::follows));
  BOOST_TEST((synthetic::row(rows, "threshold.speedup").use == Use::follows));
  BOOST_TEST((synthetic::row(rows, "blob.speedup").use == Use::predicted));
  BOOST_TEST((synthetic::row(rows, "delta.features").use == Use::predicted));
}

BOOST_AUTO_TEST_CASE(accuracies_are_explained_and_never_fail) {
  const auto rows = judge_rows(synthetic::published(), synthetic::all_images(), {});
  for (const Row& row : rows) {
    if (row.kind != Kind::accuracy) continue;
    BOOST_TEST((row.verdict == Verdict::explained), row.published.id);
    BOOST_TEST(!row.reason.empty(), row.published.id);
  }
}

BOOST_AUTO_TEST_CASE(a_missed_row_fails_its_gate_and_a_known_one_does_not) {
  const synthetic::Measured measured = synthetic::all_images();
  const Row met = row_with(Verdict::met, Use::predicted);
  BOOST_TEST(passes(judge_gates({met}, measured), "predicted"));
  BOOST_TEST(passes(judge_gates({met, row_with(Verdict::known_miss, Use::predicted)}, measured),
                    "predicted"));
  const Row missed = row_with(Verdict::missed, Use::predicted);
  BOOST_TEST(!passes(judge_gates({met, missed}, measured), "predicted"));
  BOOST_TEST(!all_passed(judge_gates({met, missed}, measured)));
  const Row unfit = row_with(Verdict::missed, Use::calibration);
  BOOST_TEST(!passes(judge_gates({met, unfit}, measured), "calibration"));
}

BOOST_AUTO_TEST_CASE(a_marker_that_one_system_misses_fails) {
  const struct {
    const char* input;
    const char* gate;
  } cases[] = {{"roll30", "poses"}, {"squares7", "5.2.4"}, {"id52", "ten"}, {"front249", "250"}};
  for (const auto& [input, gate] : cases) {
    for (const bool hybrid : {true, false}) {
      synthetic::Measured measured = synthetic::all_images();
      BOOST_TEST(passes(judge_gates({}, measured), gate));
      for (Frame& frame : (hybrid ? measured.hybrid : measured.ps_only).frames) {
        if (frame.input == input) frame.found.reset();
      }
      BOOST_TEST(!passes(judge_gates({}, measured), gate), input);
    }
  }
}

BOOST_AUTO_TEST_CASE(an_image_that_was_not_run_fails) {
  synthetic::Measured measured = synthetic::all_images();
  measured.hybrid.frames.pop_back();
  measured.ps_only.frames.pop_back();
  BOOST_TEST(!passes(judge_gates({}, measured), "250"));
}

BOOST_AUTO_TEST_CASE(systems_that_find_different_things_fail) {
  synthetic::Measured measured = synthetic::all_images();
  BOOST_TEST(passes(judge_gates({}, measured), "both systems"));
  measured.ps_only.frames[20].markers = "[other]";
  BOOST_TEST(!passes(judge_gates({}, measured), "both systems"));
}

BOOST_AUTO_TEST_SUITE_END()

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
