// From Google Benchmark's results to one number a figure.
#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include "table.h"

namespace {

std::string result(const std::string& entries) {
  return R"({"context": {}, "benchmarks": [)" + entries + "]}";
}

std::string entry(const std::string& name, double cpu_time, const std::string& more = "") {
  return R"({"name": ")" + name + R"(", "iterations": 3, "real_time": 9, "cpu_time": )" +
         std::to_string(cpu_time) + R"(, "time_unit": "us")" + more + "}";
}

}  // namespace

BOOST_AUTO_TEST_SUITE(samples)

BOOST_AUTO_TEST_CASE(a_program_of_one_benchmark_is_called_as_the_table_calls_it) {
  const bench::Round round = bench::read_samples(
      result(entry("rtl/iterations:3", 1500, R"(, "label": "abc", "corners": 83)")), "thesis/demo");
  BOOST_REQUIRE(round.size() == 1u);
  const bench::Sample& sample = round.at("thesis/demo");
  BOOST_TEST(sample.cpu_ms == 1.5);
  BOOST_TEST(sample.label == "abc");
  BOOST_TEST(sample.counters.size() == 1u);
  BOOST_TEST(sample.counters.at("corners") == 83.0);
}

BOOST_AUTO_TEST_CASE(several_benchmarks_keep_their_names) {
  const bench::Round round =
      bench::read_samples(result(entry("a/demo", 1000) + "," + entry("b/demo", 3000)), "");
  BOOST_TEST(round.at("a/demo").cpu_ms == 1.0);
  BOOST_TEST(round.at("b/demo").cpu_ms == 3.0);
}

BOOST_AUTO_TEST_CASE(what_is_no_result_is_refused) {
  BOOST_CHECK_THROW(bench::read_samples("", "x"), std::runtime_error);
  BOOST_CHECK_THROW(bench::read_samples("{}", "x"), std::runtime_error);
  BOOST_CHECK_THROW(bench::read_samples(result(""), "x"), std::runtime_error);
  BOOST_CHECK_THROW(bench::read_samples(result(R"({"name": "a"})"), "x"), std::runtime_error);
}

BOOST_AUTO_TEST_CASE(the_median_is_the_middle_one) {
  BOOST_TEST(!bench::median({}).has_value());
  BOOST_TEST(*bench::median({5}) == 5.0);
  BOOST_TEST(*bench::median({9, 1, 4}) == 4.0);
  BOOST_TEST(*bench::median({9, 1, 4, 6}) == 5.0);
}

// The ratio of each round, not of the medians: peers of one round saw the same machine.
BOOST_AUTO_TEST_CASE(a_figure_is_the_median_of_the_rounds_own_ratios) {
  const bench::Figure figure = bench::figures("tlm").front();
  std::vector<bench::Round> rounds(3);
  const double clocked[] = {10, 20, 40}, thesis[] = {100, 100, 440};
  for (std::size_t i = 0; i < 3; ++i) {
    rounds[i]["clocked/demo"].cpu_ms = clocked[i];
    rounds[i]["thesis/demo"].cpu_ms = thesis[i];
  }
  BOOST_TEST(*bench::reached(figure, rounds, "demo") == 10.0);
  BOOST_TEST(!bench::reached(figure, rounds, "noise").has_value());
  rounds[2].erase("thesis/demo");
  BOOST_TEST(*bench::reached(figure, rounds, "demo") == 7.5);
}

BOOST_AUTO_TEST_CASE(peers_that_computed_something_else_are_named) {
  std::vector<bench::Round> rounds(2);
  for (bench::Round& round : rounds) {
    round["a"].label = round["b"].label = "same";
    round["c"].label = "other";
  }
  const std::vector<std::string> none, both{"a", "c"};
  BOOST_TEST(bench::disagreeing(rounds, {"a", "b"}) == none, boost::test_tools::per_element());
  BOOST_TEST(bench::disagreeing(rounds, {"a", "absent", "c"}) == both,
             boost::test_tools::per_element());
  rounds[1]["b"].label = "later";
  BOOST_TEST(bench::disagreeing(rounds, {"a", "b"}).size() == 2u);
}

BOOST_AUTO_TEST_SUITE_END()
