#include <vp/error.h>
#include <vp/expression.h>
#include <boost/test/unit_test.hpp>

#include <map>

namespace {

/// a = 5 (before: 4), b = 0 (before: 1), x is unknown.
struct Values : vp::ExpressionValues {
  vp::ExpressionValue now(std::uint32_t signal) const override { return at(signal, 5, 0); }
  vp::ExpressionValue before(std::uint32_t signal) const override { return at(signal, 4, 1); }
  static vp::ExpressionValue at(std::uint32_t signal, int a, int b) {
    if (signal > 1) return vp::ExpressionValue::unknown();
    return signal == 0 ? a : b;
  }
};

std::optional<double> value(const std::string& text) {
  vp::Expression expression(text);
  expression.bind([](const std::string& name) { return name == "a" ? 0u : name == "b" ? 1u : 2u; });
  const vp::ExpressionValue value = expression.value(Values());
  if (!value.known) return std::nullopt;
  return static_cast<double>(value.number);
}

/// Of one point: n is 7, the clock has 50 MHz, the system is a text.
vp::ExpressionValue at_point(const std::string& name) {
  vp::ExpressionValue value(7.0L);
  if (name == "system") {
    value.is_text = true;
    value.text = "hybrid";
  } else if (name == "clock") {
    value.number = 50e6L;
    value.unit = vp::Unit::frequency;
  } else if (name != "n") {
    throw vp::InputError("unknown metric '" + name + "'");
  }
  return value;
}

double point_value(const std::string& text) {
  return static_cast<double>(vp::Expression(text, "here").value(at_point).number);
}

/// What is wrong with it, of a point.
std::string point_complaint(const std::string& text) {
  try {
    point_value(text);
    return "";
  } catch (const vp::InputError& error) {
    return error.what();
  }
}

std::string complaint(const std::string& text) {
  try {
    vp::Expression expression(text);
    return "";
  } catch (const vp::InputError& error) {
    return error.what();
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(expression)

BOOST_AUTO_TEST_CASE(numbers_and_precedence) {
  const std::map<std::string, double> expected = {
      {"2 + 3 * 4", 14}, {"(2 + 3) * 4", 20},   {"7 - 2 - 1", 4},      {"0x1F", 31},
      {"a", 5},          {"a[2]", 1},           {"a[2:1]", 2},         {"a[0] + 1", 2},
      {"a == 5", 1},     {"a != 5", 0},         {"a < 5", 0},          {"a <= 5", 1},
      {"a > 4.5", 1},    {"a >= 6", 0},         {"not a", 0},          {"not not b", 0},
      {"a and b", 0},    {"a or b", 1},         {"b or b or a", 1},    {"not b and a", 1},
      {"a rises", 1},    {"a falls", 0},        {"b falls", 1},        {"b changes", 1},
      {"a[0] rises", 1}, {"(a + b) rises", 0},  {"(a == 5) rises", 1}, {"a changes", 1},
      {"b and x", 0},    {"a or x", 1},         {"12 changes", 0},     {"a / 2", 2.5},
      {"-a + 1", -4},    {"not not a", 1},      {"1.5e2 - 50", 100},   {"`a` == 5", 1},
      {"true", 1},       {"50 MHz / 25 MHz", 2}};
  for (const auto& [text, number] : expected) {
    const auto result = value(text);
    BOOST_REQUIRE_MESSAGE(result.has_value(), text);
    BOOST_TEST(*result == number, text);
  }
}

BOOST_AUTO_TEST_CASE(what_depends_on_an_unknown_value_is_unknown) {
  for (const char* text : {"x", "x + 1", "x == x", "not x", "a and x", "b or x", "x rises", "a / b",
                           "a / b == a / b"}) {
    BOOST_TEST(!value(text).has_value(), text);
  }
}

BOOST_AUTO_TEST_CASE(names_are_listed_once) {
  const vp::Expression expression("pl.a_1 rises and order == pl.a_1 or android[3] > 2");
  BOOST_TEST(expression.names().size() == 3u);
  BOOST_TEST(expression.names()[1] == "order");
  BOOST_TEST(expression.names()[2] == "android");
}

BOOST_AUTO_TEST_CASE(mistakes_are_shown_with_their_column) {
  BOOST_TEST(complaint("a +") == "'a +', column 4: a value is missing");
  BOOST_TEST(
      complaint("a == == 2") ==
      "'a == == 2', column 6: here should be a value: a number, a name, a text in quotes or '('");
  BOOST_TEST(complaint("(a") == "'(a', column 3: a ')' is missing");
  BOOST_TEST(complaint("a b") == "'a b', column 3: an operator is missing, or this is too much");
  BOOST_TEST(complaint("a[1048576]").find("a bit is a number from 0 to 1048575") !=
             std::string::npos);
  BOOST_TEST(complaint("a[64:0]").find("at most 64 bits are taken together") != std::string::npos);
  BOOST_TEST(complaint("a[1:2]").find("[high:low]") != std::string::npos);
  BOOST_TEST(complaint("a = 1") == "'a = 1', column 3: write '==' to compare");
  BOOST_TEST(complaint("a < 3 parsec") == "'a < 3 parsec', column 7: 'parsec' is no unit");
  BOOST_TEST(complaint("'open") == "''open', column 1: a closing ' is missing");
  BOOST_TEST(complaint("0xG").find("no number") != std::string::npos);
  BOOST_TEST(complaint("").find("a value is missing") != std::string::npos);
  BOOST_TEST(complaint(std::string(10000, '(')).find("100 brackets") != std::string::npos);
}

/// Each edge doubled the work: forty took for ever.
BOOST_AUTO_TEST_CASE(edges_of_edges_are_quick) {
  for (const char* edge : {" rises", " changes"}) {
    std::string text = "a";
    for (int i = 0; i < 90; ++i) text = "(" + text + edge + ")";
    BOOST_TEST(value(text).value_or(-1) == 1, edge);
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
  BOOST_TEST(value(chain(" + 1", 400)).value() == 405);
  for (const char* part : {" + 1", " and a", " or b", "*1"}) {
    const std::string text = complaint(chain(part, 300'000));
    BOOST_TEST(text.find("more than 1000 values and operators") != std::string::npos, text);
    BOOST_TEST(text.size() < 400u, "the message repeats the expression");
  }
  std::string nots;
  for (int i = 0; i < 300'001; ++i) nots += "not ";
  BOOST_TEST(value(nots + "a").value() == 0);
}

BOOST_AUTO_TEST_CASE(what_has_no_past_knows_no_events) {
  BOOST_TEST(point_value("n == 7 and not n > 7") == 1);
  BOOST_TEST(point_complaint("n > 1 and n rises").find("column 13: 'rises'") != std::string::npos,
             point_complaint("n > 1 and n rises"));
}

BOOST_AUTO_TEST_CASE(units_are_checked) {
  BOOST_TEST(point_value("clock <= 0.05 GHz") == 1);
  BOOST_TEST(point_value("clock / 25 MHz") == 2);
  BOOST_TEST(point_value("2 * clock - 50 MHz == clock") == 1);
  BOOST_TEST(point_complaint("clock <= 100") ==
             "here: 'clock <= 100', column 7: compares Hz and a plain number");
  BOOST_TEST(point_complaint("n + (clock + 1 ms)") ==
             "here: 'n + (clock + 1 ms)', column 12: adds Hz and ps");
  BOOST_TEST(point_complaint("clock * clock").find("multiplies") != std::string::npos);
}

/// Before the first value is known.
BOOST_AUTO_TEST_CASE(units_of_signals_are_checked_when_they_are_bound) {
  vp::Expression expression("a > 1 and a > 5 ms");
  BOOST_CHECK_THROW(expression.bind([](const std::string&) { return 0u; }), vp::InputError);
}

BOOST_AUTO_TEST_CASE(what_does_not_hold_tells_how_far_it_is) {
  const auto shortfall = [](const std::string& text) {
    return vp::Expression(text, "here").shortfall([](const std::string& name) {
      return name == "n" ? vp::ExpressionValue(50.0L) : vp::ExpressionValue::unknown();
    });
  };
  BOOST_TEST(shortfall("n >= 50") == 0);
  BOOST_TEST(shortfall("n >= 200") == 0.75);
  BOOST_TEST(shortfall("n <= 40") == 0.2);
  BOOST_TEST(shortfall("n == 100") == 0.5);
  BOOST_TEST(shortfall("n >= 200 and n >= 100 and n > 1") == 1.25);
  BOOST_TEST(shortfall("n >= 200 or n >= 100") == 0.5);
  for (const char* text : {"not n >= 10", "n != 50", "unknown > 1", "n < 0 * n - 0 * n", "0 > 0"})
    BOOST_TEST(shortfall(text) == 1, text);
}

BOOST_AUTO_TEST_CASE(texts_are_equal_or_not) {
  BOOST_TEST(point_value("system == 'hybrid'") == 1);
  BOOST_TEST(point_value("system != \"ps-only\"") == 1);
  BOOST_TEST(point_complaint("system < 'x'").find("only == and !=") != std::string::npos);
  BOOST_TEST(point_complaint("system == n").find("quotes") != std::string::npos);
  BOOST_TEST(point_complaint("system and n").find("calculates with the text") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(an_unknown_name_is_shown_with_its_column) {
  BOOST_TEST(point_complaint("n > 1 or m == 2") ==
             "here: 'n > 1 or m == 2', column 10: unknown metric 'm'");
}

BOOST_AUTO_TEST_SUITE_END()
