// markervp history: a run is made again, and tells who accessed a register last.
#include <boost/test/unit_test.hpp>

#include <regex>
#include <sstream>

#include "executable.h"

using namespace integration;

namespace {

struct History : Workplace {
  History() {
    const kit::Outcome outcome = run({"z1.0", "z1.5", "--no-pictures", "--no-report", "--log-bus",
                                      "bus.log", "--log-bus-filter", "axi_dma_1"});
    BOOST_TEST_REQUIRE(outcome.exit_code == 0, outcome.err);
  }
  kit::Outcome ask(const Arguments& arguments, const std::string& folder = "out") const {
    Arguments all{"history", folder, "--register"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return kit::run_process(MARKERVP_EXECUTABLE, all, path());
  }
  std::vector<std::string> lines(const Arguments& arguments) const {
    const kit::Outcome outcome = ask(arguments);
    BOOST_TEST(outcome.exit_code == 0, outcome.err);
    BOOST_TEST(outcome.err == "");
    std::istringstream text(outcome.out);
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }
  /// The lines of the bus log with all of `parts`.
  std::vector<std::string> logged(const std::vector<std::string>& parts) const {
    std::istringstream text(kit::read_file(*this / "bus.log"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) {
      bool all = true;
      for (const std::string& part : parts) all = all && line.find(part) != line.npos;
      if (all) lines.push_back(line);
    }
    return lines;
  }
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(history, History)

BOOST_AUTO_TEST_CASE(it_is_what_the_bus_log_had_with_the_line) {
  const auto expected = logged({"axi_dma_1.S2MM_DA "});
  const auto told = lines({"axi_dma_1.S2MM_DA", "--count", "3"});
  BOOST_TEST_REQUIRE(told.size() == 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string& line = expected.at(expected.size() - 3 + i);
    BOOST_TEST(told[i].substr(0, line.size()) == line);
    BOOST_TEST(contains(told[i], "drivers::AxiDma::"), told[i]);
    BOOST_TEST(contains(told[i], "axi_dma.cpp:"), told[i]);
    BOOST_TEST(contains(told[i], ", called from "), told[i]);
  }
}

BOOST_AUTO_TEST_CASE(before_a_time_nothing_later_is_told) {
  const auto expected = logged({"axi_dma_1.S2MM_DA "});
  const std::string& second = expected.at(1);
  const std::string at = second.substr(0, second.find("  "));
  const auto told = lines({"axi_dma_1.S2MM_DA", "--before", at});
  BOOST_TEST_REQUIRE(told.size() == 1u);
  BOOST_TEST(told[0].substr(0, expected[0].size()) == expected[0]);
  BOOST_TEST(lines({"axi_dma_1.S2MM_DA", "--before", "1 ns"}).at(0) ==
             "no access of axi_dma_1.S2MM_DA before 1 ns");
}

BOOST_AUTO_TEST_CASE(a_poll_is_one_line) {
  const auto told = lines({"axi_gpio_1.GPIO_DATA", "--before", "10 ms", "--count", "2"});
  BOOST_TEST_REQUIRE(told.size() == 2u);
  BOOST_TEST(std::regex_search(told[1], std::regex("\\([0-9]{2,} times since ")), told[1]);
}

BOOST_AUTO_TEST_CASE(writes_alone) {
  for (const std::string& line : lines({"axi_dma_1.S2MM_DMASR", "--writes"}))
    BOOST_TEST(contains(line, "  write  "), line);
  BOOST_TEST(lines({"axi_gpio_1.GPIO_DATA", "--writes"}).at(0) ==
             "no write of axi_gpio_1.GPIO_DATA");
}

BOOST_AUTO_TEST_CASE(a_run_that_failed_has_one_too) {
  const kit::Outcome failed =
      run({"--program", "blink", "--set", "ps.cpu.timeout=5 us", "--no-pictures", "--no-report"});
  BOOST_TEST(failed.exit_code == 3, failed.err);
  BOOST_TEST(!lines({"axi_gpio_0.GPIO_TRI"}).empty());
}

BOOST_AUTO_TEST_CASE(it_writes_nothing) {
  const std::string before = result_text();
  lines({"axi_dma_1.S2MM_DA"});
  BOOST_TEST(result_text() == before);
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_told) {
  const auto fails = [this](const Arguments& arguments, const std::string& message,
                            const std::string& folder = "out") {
    const kit::Outcome outcome = ask(arguments, folder);
    BOOST_TEST(outcome.exit_code == 2);
    BOOST_TEST(contains(outcome.err, message), outcome.err);
  };
  fails({"axi_dma_7.S2MM_DA"}, "no device 'axi_dma_7': choose ocm_low, ddr, stacks, axi_dma_0");
  fails({"axi_dma_1.DA"}, "no register 'axi_dma_1.DA': axi_dma_1 has ");
  fails({"axi_dma_1.S2MM_DA", "--before", "soon"}, "--before 'soon' ");
  fails({"axi_dma_1.S2MM_DA"}, "cannot read result 'nowhere/result.json'", "nowhere");
  std::filesystem::create_directory(*this / "other");
  kit::write_file(*this / "other/result.json", "{}");
  fails({"axi_dma_1.S2MM_DA"}, "is not of 'markervp run'", "other");
}

BOOST_AUTO_TEST_SUITE_END()
