#include <vp/configuration.h>

#include <boost/test/unit_test.hpp>

#include "input_error.h"

namespace {

/// The value of `key` in a YAML text; "absent" if it is not there.
std::string value(const char* yaml, const char* key) {
  vp::Configuration configuration;
  configuration.load_text(yaml, "f.yaml");
  const vp::Setting* found = configuration.find(key);
  return found == nullptr ? "absent" : found->text;
}

std::string refusal(const char* yaml) {
  vp::Configuration configuration;
  return input_error([&] { configuration.load_text(yaml, "f.yaml"); });
}

const std::string key_form = "a name, or names joined by dots, of at most 500 characters";

}  // namespace

BOOST_AUTO_TEST_SUITE(configuration_yaml)

BOOST_AUTO_TEST_CASE(nested_and_dotted_keys_are_the_same) {
  BOOST_TEST(value("pl:\n  clock: 50 MHz", "pl.clock") == "50 MHz");
  BOOST_TEST(value("pl.clock: 50 MHz", "pl.clock") == "50 MHz");
  BOOST_TEST(value("pl:\n  corner.threshold: 3", "pl.corner.threshold") == "3");
  BOOST_TEST(value("{pl: {clock: 50 MHz}}", "pl.clock") == "50 MHz");
}

BOOST_AUTO_TEST_CASE(scalars_are_text_as_written) {
  BOOST_TEST(value("a: 010", "a") == "010");
  BOOST_TEST(value("a: true", "a") == "true");
  BOOST_TEST(value("a: \"x # y\"  # comment", "a") == "x # y");
  BOOST_TEST(value("a: ''", "a") == "");
  BOOST_TEST(value("base: &clock 5 MHz\na: *clock", "a") == "5 MHz");
}

BOOST_AUTO_TEST_CASE(an_empty_file_sets_nothing) {
  BOOST_TEST(refusal("") == "nothing thrown");
  BOOST_TEST(refusal("# only a comment\n") == "nothing thrown");
  BOOST_TEST(value("pl: {}", "pl") == "absent");
}

BOOST_AUTO_TEST_CASE(malformed_yaml_names_line_and_column) {
  BOOST_TEST(refusal("a: 1\nb: [1, 2").rfind("f.yaml:2:1: this is not YAML", 0) == 0u);
  BOOST_TEST(refusal("a: 1\n  b: 2").substr(0, 11) == "f.yaml:2:4:");
  BOOST_TEST(refusal("a: *nowhere").substr(0, 9) == "f.yaml:1:");
}

BOOST_AUTO_TEST_CASE(lists_are_refused) {
  BOOST_TEST(refusal("pl:\n  clock: [1 MHz]") ==
             "f.yaml:2:10: 'pl.clock' is a list: write one value for each key");
}

BOOST_AUTO_TEST_CASE(a_list_of_maps_is_one_text) {
  BOOST_TEST(value("faults:\n  - {what: flip, bit: 3}\n  - what: lost", "faults") ==
             "[{what: flip, bit: 3}, {what: lost}]");
}

BOOST_AUTO_TEST_CASE(a_file_that_is_no_map_is_refused) {
  BOOST_TEST(refusal("- a\n- b") == "f.yaml:1:1: expected 'key: value' lines");
  BOOST_TEST(refusal("just text") == "f.yaml:1:1: expected 'key: value' lines");
}

BOOST_AUTO_TEST_CASE(a_key_without_value_is_refused) {
  BOOST_TEST(refusal("pl:\n  clock:\n") == "f.yaml:2:3: 'pl.clock' has no value");
  BOOST_TEST(refusal("pl: ~") == "f.yaml:1:1: 'pl' has no value");
}

BOOST_AUTO_TEST_CASE(a_key_set_twice_is_refused) {
  BOOST_TEST(refusal("a: 1\na: 2") == "f.yaml:2:1: 'a' is set twice, first at f.yaml:1");
  BOOST_TEST(refusal("pl.clock: 1\npl:\n  clock: 2") ==
             "f.yaml:3:3: 'pl.clock' is set twice, first at f.yaml:1");
}

BOOST_AUTO_TEST_CASE(keys_are_names) {
  BOOST_TEST(refusal("a b: 1") == "f.yaml:1:1: a key is " + key_form);
  BOOST_TEST(refusal(".a: 1") == "f.yaml:1:1: a key is " + key_form);
  const std::string long_name(300, 'n');
  BOOST_TEST(value((long_name + ": 1").c_str(), long_name.c_str()) == "1");
  BOOST_TEST(refusal((long_name + ":\n  " + long_name + ": 1").c_str()) ==
             "f.yaml:2:3: a key is " + key_form);
  BOOST_TEST(refusal("? [a]\n: 1").find("a key is a name") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_second_document_is_refused) {
  BOOST_TEST(refusal("a: 1\n---\nb: 2").find("a second document") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
