// --software-profile: all of a program's time by function, the same in every run.
#include <boost/test/unit_test.hpp>
#include <map>
#include <numeric>

#include "executable.h"

using namespace integration;

namespace {

struct Profile : Workplace {
  Profile() {
    Json costs = Json::parse(kit::read_file(MARKERVP_SOURCE "/data/profiles/a9-O2.json"));
    costs["profile"] = "own";
    costs["other_units"] = {{"samples", {{"cycles", 10}, {"stall_ns", 5}}}};
    kit::write_file(*this / "own.json", costs.dump());
  }

  std::string write(const Arguments& more = {}) const {
    Arguments arguments{"--program",        MARKERVP_PROFILED,    "--set",
                        "profile=own.json", "--frames",           "1",
                        "--no-pictures",    "--software-profile", "p.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const kit::Outcome outcome = run(arguments);
    BOOST_TEST(outcome.exit_code == 0, outcome.err);
    return kit::read_file(*this / "p.json");
  }
};

/// What a profile of a file says of each stack, the names joined by "/", without arguments.
std::map<std::string, double> stacks(const Json& file, std::size_t profile) {
  std::map<std::string, double> found;
  const Json& p = file["profiles"][profile];
  for (std::size_t i = 0; i < p["samples"].size(); ++i) {
    std::string path;
    for (const auto& frame : p["samples"][i]) {
      std::string name = file["shared"]["frames"][frame.get<std::size_t>()]["name"];
      const std::string nobody = "(anonymous namespace)::";
      if (name.compare(0, nobody.size(), nobody) == 0) name.erase(0, nobody.size());
      path += (path.empty() ? "" : "/") + name.substr(0, name.find('('));
    }
    found[path] += p["weights"][i].get<double>();
  }
  return found;
}

double sum_below(const std::map<std::string, double>& all, const std::string& part) {
  double sum = 0;
  for (const auto& [path, weight] : all) sum += path.find(part) != path.npos ? weight : 0;
  return sum;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(software_profile, Profile)

BOOST_AUTO_TEST_CASE(each_function_has_its_time) {
  const Json file = Json::parse(write());
  const auto time = stacks(file, 0);
  const auto near = boost::test_tools::tolerance(1e-6);
  BOOST_TEST(sum_below(time, "/filter/compute") == 40.0, near);
  BOOST_TEST(time.at("program/run/filter/compute/[memory stalls]") == 10.0, near);
  BOOST_TEST(sum_below(time, "/interrupted/compute") == 40.0, near);
  BOOST_TEST(time.at("program/run/rest/[asleep]") > 990.0);
  BOOST_TEST(time.at("program/run/rest/[asleep]") < 1001.0);
  // Nothing is lost, and nothing counted twice.
  double sum = 0;
  for (const auto& [path, us] : time) sum += us;
  const double end = result()["program_end"]["time_us"];
  BOOST_TEST(sum == end, near);
  BOOST_TEST(file["profiles"][0]["endValue"].get<double>() == end, near);
  // Entry and exit of two handlers, 160 cycles each, and what they did.
  const double handlers = sum_below(time, "program/interrupt handlers");
  BOOST_TEST(time.at("program/interrupt handlers/[registers, barriers, caches]") == 0.48, near);
  BOOST_TEST(handlers > 0.48);
  BOOST_TEST(handlers < 5);
  BOOST_TEST(sum_below(time, "/on_tick") > 0);
  const auto cycles = stacks(file, 1);
  BOOST_TEST(sum_below(cycles, "/filter/compute") == 40e-6 * 666'666'667, near);
  BOOST_TEST(sum_below(stacks(file, 2), "/filter/compute") == 40e-6 * 666'666'667 * 0.415e-3, near);
}

BOOST_AUTO_TEST_CASE(calls_are_counted) {
  const auto calls = stacks(Json::parse(write()), 3);
  const std::map<std::string, double> expected{{"compute", 3}, {"filter", 1},      {"on_tick", 2},
                                               {"rest", 1},    {"interrupted", 1}, {"run", 1}};
  for (const auto& [name, count] : expected) {
    BOOST_TEST_REQUIRE(calls.count(name) == 1u, name);
    BOOST_TEST(calls.at(name) == count, name);
  }
  // With time of their own, too: what a loop of 64 blocks is counts no call.
  BOOST_TEST((stacks(Json::parse(write({"--set", "ps.cpu.block_cycles=2 cycles"})), 3) == calls));
}

BOOST_AUTO_TEST_CASE(no_result_depends_on_how_it_is_computed) {
  const std::string once = write();
  BOOST_TEST(once == write());
  BOOST_TEST(once == write({"--set", "ps.cpu.quantum=0 ps"}));
  BOOST_TEST(once == write({"--set", "ps.poll_elision=false"}));
  write();
  const std::string with = result_text();
  run({"--program", MARKERVP_PROFILED, "--set", "profile=own.json", "--frames", "1",
       "--no-pictures"});
  const Json without = result();
  for (const char* part : {"program_end", "summary", "configuration"}) {
    BOOST_TEST(Json::parse(with)[part] == without[part], part);
  }
}

BOOST_AUTO_TEST_CASE(the_page_has_it_with_the_latencies) {
  write();
  const std::string page = kit::read_file(*this / "out/report.html");
  if (page.find("MARKERVP_EXTRAS") == page.npos && page.find("\"profile\":{") == page.npos) return;
  BOOST_TEST(page.find("29 ps.private_timer.irq") != page.npos);
}

BOOST_AUTO_TEST_CASE(a_file_that_cannot_be_written) {
  const kit::Outcome outcome = run({"--software-profile", "no/such/folder/p.json"});
  BOOST_TEST(outcome.exit_code == 2);
  BOOST_TEST(outcome.err.find("no/such/folder") != std::string::npos, outcome.err);
  const kit::Outcome same = run({"--software-profile", "x", "--register-coverage", "x"});
  BOOST_TEST(same.exit_code == 2);
  BOOST_TEST(same.err.find("two outputs would be one file") != std::string::npos, same.err);
}

BOOST_AUTO_TEST_SUITE_END()
