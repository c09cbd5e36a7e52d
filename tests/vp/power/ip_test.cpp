// Parts of a design say what they are, and are found in the hierarchy.
#include <boost/test/unit_test.hpp>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <simulation.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/ip.h>

namespace {

struct Part : sc_core::sc_module, vp::Ip {
  Part(sc_core::sc_module_name name, const vp::Clock* clock) : sc_module(name), Ip(clock) {}
  vp::IpEstimate own_estimate() const override {
    vp::IpEstimate e;
    e.lut = 7;
    e.active_clocks = [] { return std::uint64_t{3}; };
    return e;
  }
};

/// Holds parts, and is one.
struct Block : Part {
  Block(sc_core::sc_module_name name, const vp::Clock& clock)
      : Part(name, &clock), inner("inner", &clock) {}
  Part inner;
};

struct Design : sc_core::sc_module {
  Design(sc_core::sc_module_name name, const vp::Clock& clock)
      : sc_module(name), first("first", &clock), block("block", clock), wires("wires", nullptr) {}
  Part first;
  Block block;
  Part wires;
};

struct Bench : kit::Simulation {
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  Part outside{"outside", &clock};
  Design design{"design", clock};

  std::vector<std::string> found() const {
    std::vector<std::string> names;
    for (const vp::Ip* ip : vp::ips_below(design)) names.emplace_back(ip->object().name());
    return names;
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(ip)

BOOST_FIXTURE_TEST_CASE(the_hierarchy_is_the_list, Bench) {
  const std::vector<std::string> expected{"design.first", "design.block", "design.block.inner",
                                          "design.wires"};
  BOOST_TEST(found() == expected, boost::test_tools::per_element());
}

BOOST_FIXTURE_TEST_CASE(a_design_groups_its_parts_and_says_their_order, Bench) {
  design.wires.set_group("bridge", 0);
  design.block.inner.set_group("core", 1);
  const std::vector<std::string> expected{"design.wires", "design.block.inner", "design.first",
                                          "design.block"};
  BOOST_TEST(found() == expected, boost::test_tools::per_element());
  BOOST_TEST(design.wires.group() == "bridge");
  BOOST_TEST(design.first.group() == "pl");
}

BOOST_FIXTURE_TEST_CASE(a_part_counts_its_work_unless_the_design_knows_better, Bench) {
  BOOST_TEST(design.first.estimate().active_clocks() == 3u);
  design.first.set_active_clocks([] { return std::uint64_t{0}; });
  BOOST_TEST(design.first.estimate().active_clocks() == 0u);
  BOOST_TEST(design.first.estimate().lut == 7u);
}

BOOST_FIXTURE_TEST_CASE(a_part_without_a_clock_says_so, Bench) {
  BOOST_CHECK_EXCEPTION(design.wires.logic_clock(), std::logic_error, [](const auto& error) {
    return std::string(error.what()).find("design.wires") != std::string::npos;
  });
  design.wires.set_logic_clock(clock);
  BOOST_TEST(&design.wires.logic_clock() == &clock);
}

BOOST_AUTO_TEST_SUITE_END()
