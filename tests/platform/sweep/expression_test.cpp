#include <sweep/expression.h>

#include "sweep_kit.h"

using platform::sweep::Expression;
using platform::sweep::Value;
using sweep_test::complaint;
using sweep_test::contains;

namespace {

Value lookup(const std::string& name) {
  Value value;
  if (name == "system") {
    value.is_text = true;
    value.text = "hybrid";
  } else if (name == "clock") {
    value.number = 50e6;
    value.unit = vp::Unit::frequency;
  } else {
    value.number = 7;
  }
  return value;
}

double evaluated(const std::string& text) {
  return Expression(text, "here").evaluate(lookup).number;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(expressions)

BOOST_AUTO_TEST_CASE(arithmetic_binds_as_usual) {
  BOOST_TEST(evaluated("1 + 2 * 3 - 4 / 2") == 5);
  BOOST_TEST(evaluated("-(1 + 2) * 2") == -6);
  BOOST_TEST(evaluated("1.5e2 - 50") == 100);
}

BOOST_AUTO_TEST_CASE(conditions_combine) {
  BOOST_TEST(evaluated("n == 7 and not n > 7") == 1);
  BOOST_TEST(evaluated("n < 7 or n != 7 or n >= 8") == 0);
  BOOST_TEST(evaluated("true and false") == 0);
}

BOOST_AUTO_TEST_CASE(units_are_checked) {
  BOOST_TEST(evaluated("clock <= 0.05 GHz") == 1);
  BOOST_TEST(evaluated("clock / 25 MHz") == 2);
  BOOST_TEST(
      contains(complaint([] { evaluated("clock <= 100"); }), "compares Hz and a plain number"));
  BOOST_TEST(contains(complaint([] { evaluated("clock + 1 ms"); }), "adds"));
  BOOST_TEST(contains(complaint([] { evaluated("n < 3 parsec"); }), "no unit"));
}

BOOST_AUTO_TEST_CASE(texts_are_equal_or_not) {
  BOOST_TEST(evaluated("system == 'hybrid'") == 1);
  BOOST_TEST(evaluated("system != \"ps-only\"") == 1);
  BOOST_TEST(contains(complaint([] { evaluated("system < 'x'"); }), "only == and !="));
  BOOST_TEST(contains(complaint([] { evaluated("system == n"); }), "quotes"));
}

BOOST_AUTO_TEST_CASE(mistakes_are_named) {
  for (const char* wrong : {"", "1 +", "(1", "1 = 1", "n n", "'open", "1 ** 2", "n / 0"}) {
    const std::string said = complaint([&] { evaluated(wrong); });
    BOOST_TEST(contains(said, "here: '"), wrong << " gave: " << said);
  }
  BOOST_TEST(contains(complaint([] { evaluated(std::string(5000, '(')); }), "more than 100"));
}

/// They overran the stack.
BOOST_AUTO_TEST_CASE(length_is_bounded) {
  const auto repeated = [](const std::string& part, std::size_t times) {
    std::string text;
    for (std::size_t i = 0; i < times; ++i) text += part;
    return text;
  };
  BOOST_TEST(evaluated("0" + repeated(" + 1", 400)) == 400);
  BOOST_TEST(evaluated(repeated("not ", 300'001) + "n") == 0);
  BOOST_TEST(evaluated(repeated("not ", 300'000) + "n") == 1, "a truth, not the number");
  for (const char* part : {" + 1", " or n", " and n", "*1"}) {
    const std::string said = complaint([&] { evaluated("n" + repeated(part, 300'000)); });
    BOOST_TEST(contains(said, "more than 1000 values and operators"), said);
    BOOST_TEST(said.size() < 400u, "the message repeats the expression");
  }
  BOOST_TEST(
      contains(complaint([&] { evaluated(repeated("- ", 300'000) + "1"); }), "more than 100"));
}

BOOST_AUTO_TEST_SUITE_END()
