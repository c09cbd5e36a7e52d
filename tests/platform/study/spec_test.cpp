#include <marker/input/image_input.h>
#include <marker/report/marker_metrics.h>
#include <study/inputs.h>
#include <study/spec.h>

#include "sweep_kit.h"

using platform::study::parse_spec;
using platform::study::Sampling;
using platform::study::Spec;
using sweep_test::complaint;
using sweep_test::contains;

namespace {

// The keys of an application.
const platform::study::InputKindRegistration images(platform::input::image_input);
const bool has_metrics = platform::register_marker_metrics();

std::string problem(const std::string& text) {
  return complaint([&] { parse_spec(text, "s.yaml"); });
}

}  // namespace

BOOST_AUTO_TEST_SUITE(spec_files)

BOOST_AUTO_TEST_CASE(everything_has_its_place) {
  const Spec spec = parse_spec(R"(
title: T
inputs: [z1.0, roll]
system: hybrid
design: improved
fidelity: tlm
set: {sw: {upload: 0}}
parameters:
  a.b: [1, 2]
  c: {start: 1 MHz, stop: 8 MHz, count: 4, scale: log}
  inputs: {near: [z1.0], far: [z4.0, z4.5]}
zip:
  - {d: [1, 2], e: [3, 4]}
sample: {method: sobol, points: 5, seed: 2}
constraints: [a.b < c]
objectives: [max summary.fps.mean]
)",
                               "folder/s.yaml");
  BOOST_TEST(spec.name == "s");
  BOOST_TEST(spec.set.at("sw.upload") == "0");
  BOOST_TEST(spec.set.at("design") == "improved");
  BOOST_TEST(spec.set.at("fidelity") == "tlm");
  BOOST_REQUIRE(spec.dimensions.size() == 4u);
  BOOST_TEST(spec.dimensions[1].axes[0].range->logarithmic);
  BOOST_TEST(spec.dimensions[3].axes.size() == 2u);
  BOOST_TEST(spec.input_sets.at("far").size() == 2u);
  BOOST_TEST((spec.sampling.method == Sampling::Method::sobol));
  BOOST_TEST(spec.constraints[0].where == "folder/s.yaml:15");
}

BOOST_AUTO_TEST_CASE(mistakes_are_named_with_their_line) {
  BOOST_TEST(contains(problem("parametres: {a: 1}"), "did you mean 'parameters'"));
  BOOST_TEST(
      contains(problem("title: x\npl.width: 320 px"), "s.yaml:2: 'pl.width' is a parameter"));
  BOOST_TEST(contains(problem("title: x\nparameters: {a: []}"), "s.yaml:2"));
  BOOST_TEST(contains(problem("parameters: {a: []}"), "no values"));
  BOOST_TEST(contains(problem("parameters: {a: {start: 1}}"), "'start' and 'stop'"));
  BOOST_TEST(contains(problem("parameters: {a: {start: 1, stop: 2, step: 1, count: 2}}"),
                      "leave out one"));
  BOOST_TEST(contains(problem("parameters: {a: 1}\nzip: [{a: 2}]"), "swept twice"));
  BOOST_TEST(contains(problem("sample: {method: sobl, points: 3}"), "did you mean 'sobol'"));
  BOOST_TEST(contains(problem("sample: {method: random}"), "needs 'points'"));
  BOOST_TEST(contains(problem("sample: {method: morris, levels: 3}"), "even"));
  BOOST_TEST(contains(problem("a: [1"), "s.yaml:"));
  BOOST_TEST(contains(problem("repeat: -1"), "whole number"));
  BOOST_TEST(contains(problem("system: a\nprogram: b"), "both name the PS program"));
  BOOST_TEST(
      contains(complaint([] { platform::study::read_spec("/nowhere.yaml"); }), "No such file"));
}

BOOST_AUTO_TEST_CASE(constraints_that_no_point_can_meet_are_refused) {
  BOOST_TEST(contains(problem("target_rate: 200 fps\nconstraints: [summary.fps.mean < 100]"),
                      "s.yaml:2: 'summary.fps.mean >= 200' and 'summary.fps.mean < 100' "
                      "contradict each other"));
  for (const char* pair : {"a > 5, a < 5", "a >= 5, a < 5", "a == 5, a == 6", "a == 5, a > 5"})
    BOOST_TEST(contains(problem("constraints: [" + std::string(pair) + "]"), "contradict"), pair);
  for (const char* pair : {"a >= 5, a <= 5", "a > 5, b < 5", "a > 5, a < 6", "a > 5, a + 0 < 5"})
    BOOST_CHECK_NO_THROW(
        platform::study::parse_spec("constraints: [" + std::string(pair) + "]", "s.yaml"));
}

BOOST_AUTO_TEST_CASE(scenes_are_every_combination_of_their_conditions) {
  const Spec spec = parse_spec(
      "inputs: [z1.0]\nscenes: {base: demo, distance: [1 m, 2 m], noise: [0.01, 0.03]}\n",
      "here.yaml");
  const std::vector<std::string> wanted{
      "z1.0", "demo@distance=1 m,noise=0.01", "demo@distance=1 m,noise=0.03",
      "demo@distance=2 m,noise=0.01", "demo@distance=2 m,noise=0.03"};
  BOOST_TEST(spec.inputs == wanted, boost::test_tools::per_element());
  BOOST_TEST(parse_spec("scenes: {blur: 1 px}\n", "x").inputs.front() == "front0@blur=1 px");
  BOOST_TEST(contains(complaint([] { parse_spec("scenes: [demo]\n", "x"); }),
                      "'scenes' is 'condition: values' lines"));
}

BOOST_AUTO_TEST_CASE(control_characters_in_a_study_are_refused_with_their_key) {
  const auto problem = [](const std::string& yaml) {
    return complaint([&] { parse_spec(yaml, "s.yaml"); });
  };
  const std::string rest = "parameters: {a: [1, 2]}\n";
  BOOST_TEST(contains(problem("title: \"a\\n!touch pwned\"\n" + rest),
                      "s.yaml:1: 'a\\n!touch pwned' for 'title' has a control character"));
  BOOST_TEST(contains(problem(rest + "text: \"\\e[2J\"\n"), "s.yaml:2: '\\x1b[2J' for 'text'"));
  BOOST_TEST(contains(problem("parameters: {a: [1, \"2\\u202e\"]}\n"), "'2\\u202e' for 'a'"));
  BOOST_TEST(contains(problem("inputs: {\"a\\x7f\": [demo]}\n" + rest), "'a\\x7f' for 'inputs'"));
  BOOST_TEST(problem("title: Größe µs\ntext: |\n  Two\n  lines.\n" + rest) == "");
}

BOOST_AUTO_TEST_SUITE_END()
