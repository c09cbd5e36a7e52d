#include <vp/error.h>
#include <vp/yaml.h>

#include <boost/test/unit_test.hpp>
#include <random>

#include "input_error.h"

namespace {

std::string refusal(const std::string& yaml) {
  return input_error([&] { vp::load_yaml(yaml, "f.yaml"); });
}

std::string repeated(const std::string& part, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i) text += part;
  return text;
}

/// Lists of ten of the list before, `levels` times: 10 to the power of `levels` values.
std::string bomb(std::size_t levels) {
  std::string text = "l0: &l0 [x]\n";
  for (std::size_t i = 1; i <= levels; ++i) {
    const std::string before = "*l" + std::to_string(i - 1);
    text += "l" + std::to_string(i) + ": &l" + std::to_string(i) + " [" + before +
            repeated(", " + before, 9) + "]\n";
  }
  return text;
}

/// Goes through a whole tree as a reader does.
std::size_t count(const YAML::Node& node) {
  std::size_t values = 1;
  if (node.IsSequence())
    for (const YAML::Node& item : node) values += count(item);
  if (node.IsMap())
    for (const auto& entry : node) values += count(entry.first) + count(entry.second);
  return values;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(yaml)

BOOST_AUTO_TEST_CASE(documents_are_read) {
  BOOST_TEST(vp::load_yaml("a: [1, {b: 2}]", "f")["a"][1]["b"].as<int>() == 2);
  BOOST_TEST(vp::load_yaml("a: &x [1, 2]\nb: *x", "f")["b"].size() == 2u);
  BOOST_TEST(vp::load_yaml("", "f").IsNull());
  BOOST_TEST(vp::load_yaml("a: 1\n---\nb: 2", "f", vp::YamlDocuments::first)["a"].as<int>() == 1);
}

BOOST_AUTO_TEST_CASE(what_is_no_yaml_is_told_in_our_words) {
  BOOST_TEST(refusal("a: 1\nb: [1, 2") ==
             "f.yaml:2:1: this is not YAML, here or in a line above: check that lines are indented "
             "with spaces, that a space follows each ':', and that every quote, '[' and '{' is "
             "closed");
  BOOST_TEST(refusal("a: *nowhere").rfind("f.yaml:1:", 0) == 0u);
  BOOST_TEST(refusal(std::string(9, '\0')) ==
             "f.yaml: it has bytes that are not text: name a YAML file");
  BOOST_TEST(refusal("a: 1\n---\nb: 2") ==
             "f.yaml:2:1: a second document: leave out all behind '---', the file has one");
}

BOOST_AUTO_TEST_CASE(an_anchor_inside_itself_is_refused) {
  const std::string inside = "an alias inside its own anchor: write the values out";
  BOOST_TEST(refusal("camera_matrix: &a [*a]") == "f.yaml:1:20: " + inside);
  BOOST_TEST(refusal("a: &self\n  b: *self") == "f.yaml:2:6: " + inside);
  BOOST_TEST(refusal("&a {*a : 1}").find(inside) != std::string::npos);
  BOOST_TEST(refusal("a: &x [&y [*x]]").find(inside) != std::string::npos);
}

BOOST_AUTO_TEST_CASE(nesting_is_bounded_with_aliases_and_without) {
  const std::string deep = "nested more than 32 levels deep: write it flatter";
  BOOST_TEST(refusal(repeated("[", 32) + repeated("]", 32)) == "nothing thrown");
  BOOST_TEST(refusal(repeated("[", 33) + repeated("]", 33)) == "f.yaml:1:33: " + deep);
  for (const std::size_t levels : {33, 400, 1000, 300'000}) {
    BOOST_TEST(refusal(repeated("[", levels)).find(deep) != std::string::npos);
    BOOST_TEST(refusal(repeated("{a: ", levels)).find(deep) != std::string::npos);
    BOOST_TEST(refusal(repeated("- ", levels)).find(deep) != std::string::npos);
    BOOST_TEST(refusal(repeated("? ", levels)).find(deep) != std::string::npos);
  }
  std::string chain = "a0: &a0 [x]\n";
  for (int i = 1; i < 10'000; ++i) {
    chain += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [*a" + std::to_string(i - 1) +
             "]\n";
  }
  BOOST_TEST(refusal(chain).find(deep) != std::string::npos);
}

/// 643 bytes took 2.3 GB.
BOOST_AUTO_TEST_CASE(alias_bombs_are_refused) {
  BOOST_TEST(count(vp::load_yaml(bomb(4), "f")) < 30'000u);
  const std::string text = refusal(bomb(20));
  BOOST_TEST(text.find("more than 500000 values, aliases counted as what they stand for: write "
                       "less") != std::string::npos,
             text);
  BOOST_TEST(refusal("[" + repeated("1,", 600'000) + "1]").find("more than 500000 values") !=
             std::string::npos);
}

/// Damaged texts are read or refused, and what was read can be walked.
BOOST_AUTO_TEST_CASE(any_text_ends) {
  const std::string good =
      "%YAML:1.0\n---\na: &x !!t [1, {b: 'c', \"d\": *y}]\ne:\n   - >-\n     text\n   - &y |\n"
      "     more\n? k\n: v\n# c\n";
  std::mt19937 random(7);
  std::size_t read = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string text = good;
    for (auto edits = random() % 6 + 1; edits > 0; --edits) {
      const std::size_t at = random() % text.size();
      const char letter = "[]{}&*!|>-?:'\"%#, \n\tax\\\0"[random() % 24];
      switch (random() % 3) {
        case 0:
          text[at] = letter;
          break;
        case 1:
          text.insert(at, random() % 40, letter);
          break;
        default:
          text += text.substr(at, random() % 30);
      }
    }
    try {
      read += count(vp::load_yaml(text, "f")) > 0;
    } catch (const vp::InputError&) {
    }
  }
  BOOST_TEST(read > 0u);
}

BOOST_AUTO_TEST_SUITE_END()
