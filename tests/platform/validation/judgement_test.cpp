// Verdicts and gates, and that each gate can fail.
#include <validation/judgement.h>
#include <validation/reasons.h>

#include <boost/test/unit_test.hpp>

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
