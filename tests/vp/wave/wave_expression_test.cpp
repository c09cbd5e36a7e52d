#include <vp/error.h>
#include <vp/wave_expression.h>
#include <boost/test/unit_test.hpp>

#include <map>

namespace {

/// a = 5 (before: 4), b = 0 (before: 1), x is unknown.
struct Values : vp::WaveValues {
  std::optional<vp::WaveNumber> now(std::uint32_t signal) const override {
    return at(signal, 5, 0);
  }
  std::optional<vp::WaveNumber> before(std::uint32_t signal) const override {
    return at(signal, 4, 1);
  }
  static std::optional<vp::WaveNumber> at(std::uint32_t signal, int a, int b) {
    if (signal > 1) return std::nullopt;
    return signal == 0 ? a : b;
  }
};

std::optional<vp::WaveNumber> value(const std::string& text) {
  vp::WaveExpression expression(text);
  expression.bind([](const std::string& name) { return name == "a" ? 0u : name == "b" ? 1u : 2u; });
  return expression.value(Values());
}

std::string complaint(const std::string& text) {
  try {
    vp::WaveExpression expression(text);
    return "";
  } catch (const vp::InputError& error) {
    return error.what();
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(wave_expression)

BOOST_AUTO_TEST_CASE(numbers_and_precedence) {
  const std::map<std::string, int> expected = {
      {"2 + 3 * 4", 14}, {"(2 + 3) * 4", 20},  {"7 - 2 - 1", 4},      {"0x1F", 31},
      {"a", 5},          {"a[2]", 1},          {"a[2:1]", 2},         {"a[0] + 1", 2},
      {"a == 5", 1},     {"a != 5", 0},        {"a < 5", 0},          {"a <= 5", 1},
      {"a > 4.5", 1},    {"a >= 6", 0},        {"not a", 0},          {"not not b", 0},
      {"a and b", 0},    {"a or b", 1},        {"b or b or a", 1},    {"not b and a", 1},
      {"a rises", 1},    {"a falls", 0},       {"b falls", 1},        {"b changes", 1},
      {"a[0] rises", 1}, {"(a + b) rises", 0}, {"(a == 5) rises", 1}, {"a changes", 1},
      {"b and x", 0},    {"a or x", 1},        {"12 changes", 0}};
  for (const auto& [text, number] : expected) {
    const auto result = value(text);
    BOOST_REQUIRE_MESSAGE(result.has_value(), text);
    BOOST_TEST(static_cast<double>(*result) == number, text);
  }
}

BOOST_AUTO_TEST_CASE(what_depends_on_an_unknown_value_is_unknown) {
  for (const char* text : {"x", "x + 1", "x == x", "not x", "a and x", "b or x", "x rises"}) {
    BOOST_TEST(!value(text).has_value(), text);
  }
}

BOOST_AUTO_TEST_CASE(names_are_listed_once) {
  const vp::WaveExpression expression("pl.a_1 rises and order == pl.a_1 or android[3] > 2");
  BOOST_TEST(expression.names().size() == 3u);
  BOOST_TEST(expression.names()[1] == "order");
  BOOST_TEST(expression.names()[2] == "android");
}

BOOST_AUTO_TEST_CASE(mistakes_are_shown_with_their_column) {
  BOOST_TEST(complaint("a +") == "'a +', column 4: a value is missing");
  BOOST_TEST(complaint("a == == 2") ==
             "'a == == 2', column 6: here should be a number, a signal or '('");
  BOOST_TEST(complaint("(a") == "'(a', column 3: a ')' is missing");
  BOOST_TEST(complaint("a b") == "'a b', column 3: something too much");
  BOOST_TEST(complaint("a[64]").find("a bit is a number from 0 to 63") != std::string::npos);
  BOOST_TEST(complaint("a[1:2]").find("[high:low]") != std::string::npos);
  BOOST_TEST(complaint("0xG").find("no number") != std::string::npos);
  BOOST_TEST(complaint("").find("a value is missing") != std::string::npos);
  BOOST_TEST(complaint(std::string(10000, '(')).find("100 brackets") != std::string::npos);
}

/// Each edge doubled the work: forty took for ever.
BOOST_AUTO_TEST_CASE(edges_of_edges_are_quick) {
  for (const char* edge : {" rises", " changes"}) {
    std::string text = "a";
    for (int i = 0; i < 90; ++i) text = "(" + text + edge + ")";
    BOOST_TEST(static_cast<double>(value(text).value_or(-1)) == 1, edge);
  }
  std::string both = "a rises";
  for (int i = 0; i < 7; ++i) both = "((" + both + ") == (" + both + ")) changes";
  BOOST_TEST(value(both).has_value());
}

/// They overran the stack.
BOOST_AUTO_TEST_CASE(length_is_bounded) {
  const auto chain = [](const std::string& part, std::size_t times) {
    std::string text = "a";
    for (std::size_t i = 0; i < times; ++i) text += part;
    return text;
  };
  BOOST_TEST(static_cast<double>(value(chain(" + 1", 400)).value()) == 405);
  for (const char* part : {" + 1", " and a", " or b", "*1"}) {
    const std::string text = complaint(chain(part, 300'000));
    BOOST_TEST(text.find("more than 1000 values and operators") != std::string::npos, text);
    BOOST_TEST(text.size() < 400u, "the message repeats the expression");
  }
  std::string nots;
  for (int i = 0; i < 300'001; ++i) nots += "not ";
  BOOST_TEST(static_cast<double>(value(nots + "a").value()) == 0);
}

BOOST_AUTO_TEST_CASE(a_signal_is_found_by_the_end_of_its_path) {
  const std::vector<std::string> paths = {"pl.one.count", "pl.two.count", "pl.two.full",
                                          "full_time"};
  BOOST_TEST(vp::find_path("full", paths, "") == 2u);
  BOOST_TEST(vp::find_path("two.count", paths, "") == 1u);
  BOOST_TEST(vp::find_path("pl.one.count", paths, "") == 0u);
  const auto fails = [&](const std::string& name, const std::string& expected) {
    BOOST_CHECK_EXCEPTION(vp::find_path(name, paths, "line 3: "), vp::InputError,
                          [&](const auto& error) { return error.what() == expected; });
  };
  fails("count", "line 3: 'count' may be pl.one.count or pl.two.count: write more of it");
  fails("ful", "line 3: there is no signal 'ful'; did you mean 'pl.two.full'?");
  fails("zzzzzzzz", "line 3: there is no signal 'zzzzzzzz'");
}

BOOST_AUTO_TEST_SUITE_END()
