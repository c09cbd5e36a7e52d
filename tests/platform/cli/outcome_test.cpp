// What a fault came to, of what is seen of a run.
#include <boost/test/unit_test.hpp>

#include <memory>
#include <string>

#include <cli/faults/outcome.h>
#include <nlohmann/json.hpp>

using platform::cli::classify;
using platform::cli::Outcome;
using platform::cli::Witness;

namespace {

/// Units 1 and 2, in words.
Witness witness(const std::string& first, const std::string& second) {
  Witness witness;
  witness.units = {first, second};
  witness.told = {first == "given up", second == "given up"};
  witness.ended = true;
  return witness;
}

const Witness right = witness("a", "b");

/// Says when something happened to a unit, and what came of it.
class Echo : public platform::facts::UnitExtra {
 public:
  Echo(double at_us, int height) : at_us_(at_us), height_(height) {}
  std::string heading() const override { return "an echo"; }
  void add_members(Place place, Json& json) const override {
    if (place == Place::behind_index) json["taken_us"] = at_us_;
    if (place == Place::behind_counts) json["echo"] = {{"at_us", at_us_}, {"height", height_}};
  }

 private:
  double at_us_;
  int height_;
};

Witness echo(double at_us, int height) {
  platform::facts::UnitReport unit;
  unit.extra = std::make_shared<Echo>(at_us, height);
  Witness witness;
  witness.add(unit);
  witness.ended = true;
  return witness;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(outcome)

BOOST_AUTO_TEST_CASE(a_right_run_is_masked_unless_something_was_noticed) {
  Witness seen = right;
  BOOST_TEST((classify(right, seen) == Outcome::masked));
  seen.add_warning("pl.axi_dma_0: odd (/markervp/odd at 12 us)");
  BOOST_TEST((classify(right, seen) == Outcome::recovered));
  BOOST_TEST(sign(right, seen) == "pl.axi_dma_0: odd (/markervp/odd");
}

BOOST_AUTO_TEST_CASE(a_unit_that_comes_later_is_right) {
  BOOST_TEST((classify(echo(1.5, 3), echo(2.5, 3)) == Outcome::masked));
  BOOST_TEST((classify(echo(1.5, 3), echo(1.5, 4)) == Outcome::unnoticed));
}

BOOST_AUTO_TEST_CASE(a_warning_of_the_right_run_is_no_sign) {
  Witness before = right;
  before.add_warning("ps: late (/markervp/late at 12 us)");
  Witness seen = witness("a", "c");
  seen.add_warning("ps: late (/markervp/late at 13 us)");
  BOOST_TEST((classify(before, seen) == Outcome::unnoticed));
}

BOOST_AUTO_TEST_CASE(a_wrong_unit_without_a_sign_is_unnoticed) {
  BOOST_TEST((classify(right, witness("a", "c")) == Outcome::unnoticed));
  BOOST_TEST((classify(right, witness("c", "b")) == Outcome::unnoticed));
  // One is given up, another silently wrong.
  BOOST_TEST((classify(right, witness("given up", "c")) == Outcome::unnoticed));
}

BOOST_AUTO_TEST_CASE(a_wrong_unit_that_says_so_is_recovered_if_the_last_is_right) {
  BOOST_TEST((classify(right, witness("given up", "b")) == Outcome::recovered));
  BOOST_TEST((classify(right, witness("a", "given up")) == Outcome::reported));
  Witness seen = witness("a", "c");
  seen.exit_code = 1;
  BOOST_TEST((classify(right, seen) == Outcome::reported));
}

BOOST_AUTO_TEST_CASE(units_that_do_not_come_are_a_hang) {
  Witness seen = right;
  seen.units.erase(1);
  seen.told.pop_back();
  BOOST_TEST((classify(right, seen) == Outcome::hang));
  seen = right;
  seen.ended = false;
  BOOST_TEST((classify(right, seen) == Outcome::hang));
}

// Units without data, or none: what the program delivers is its text.
BOOST_AUTO_TEST_CASE(text_of_a_program_whose_units_have_no_data_is_right_or_wrong) {
  const auto run = [](const std::string& text, int exit_code = 0) {
    Witness witness;
    witness.add(platform::facts::UnitReport());
    witness.add_console(text, {"again"});
    witness.ended = true;
    witness.exit_code = exit_code;
    return witness;
  };
  const Witness right = run("sum 12\r\nsum 13\n");
  BOOST_TEST((classify(right, run("sum 12\nsum 13\n")) == Outcome::masked));
  BOOST_TEST((classify(right, run("sum 12\nagain\nsum 13\n")) == Outcome::recovered));
  BOOST_TEST((classify(right, run("sum 12\nsum 99\n")) == Outcome::unnoticed));
  BOOST_TEST((classify(right, run("sum 12\nsum 99\n", 1)) == Outcome::reported));
  BOOST_TEST((classify(right, run("sum 99\nagain\nsum 13\n")) == Outcome::recovered));
  BOOST_TEST((classify(right, run("")) == Outcome::unnoticed));
  BOOST_TEST((classify(run(""), run("sum 12\n", 1)) == Outcome::reported));
  BOOST_TEST(sign(right, run("sum 12\nsum 99\n")) == "console: sum 99");
  BOOST_TEST(sign(right, run("sum 12\n")) == "console: without 'sum 13'");
}

BOOST_AUTO_TEST_CASE(text_beside_units_with_data_may_differ) {
  Witness before = echo(1.5, 3);
  before.add_console("in 12 us\n", {});
  Witness seen = echo(1.5, 3);
  seen.add_console("in 13 us\n", {});
  BOOST_TEST((classify(before, seen) == Outcome::masked));
  seen.add_console("lost one\n", {"lost"});
  BOOST_TEST((classify(before, seen) == Outcome::recovered));
}

// Wilson 1927; the values are those of R's prop.test(correct = FALSE).
BOOST_AUTO_TEST_CASE(intervals_of_shares) {
  const auto interval = platform::cli::wilson(10, 100);
  BOOST_TEST(interval.low == 0.05522914, boost::test_tools::tolerance(1e-6));
  BOOST_TEST(interval.high == 0.1743657, boost::test_tools::tolerance(1e-6));
  BOOST_TEST(platform::cli::wilson(0, 10).low == 0.0);
  BOOST_TEST(platform::cli::wilson(0, 10).high == 0.2775328, boost::test_tools::tolerance(1e-6));
  BOOST_TEST(platform::cli::wilson(0, 0).high == 1.0);
}

BOOST_AUTO_TEST_SUITE_END()
