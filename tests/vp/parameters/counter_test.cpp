#include <vp/counter.h>

#include <boost/test/unit_test.hpp>

#include "simulation.h"

namespace {

struct Link : sc_core::sc_module {
  explicit Link(const sc_core::sc_module_name& name) : sc_core::sc_module(name) {}
  vp::Counter reads{"reads", "read transactions"};
  vp::Counter writes{"writes", "write transactions"};
};

struct Bus : sc_core::sc_module {
  explicit Bus(const sc_core::sc_module_name& name) : sc_core::sc_module(name) {}
  Link second{"second"};
  Link first{"first"};
  vp::Counter errors{"errors", "decode errors"};
};

std::vector<std::string> names(const std::vector<const vp::Counter*>& counters) {
  std::vector<std::string> names;
  for (const vp::Counter* counter : counters) names.emplace_back(counter->name());
  return names;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(counter, kit::Simulation)

BOOST_AUTO_TEST_CASE(includes_what_is_counted_elsewhere) {
  const auto words = std::make_shared<std::uint64_t>(3);
  vp::Counter accesses("accesses", "accesses");
  vp::Counter bytes("bytes", "bytes moved");
  accesses.include(words, 1);
  bytes.include(words, 4);
  bytes.add(2);
  BOOST_TEST(accesses == 3u);
  BOOST_TEST(bytes == 14u);
  bytes.reset();
  BOOST_TEST(bytes == 0u);
  ++*words;
  BOOST_TEST(bytes == 4u);
  BOOST_TEST(accesses == 4u);
}

BOOST_AUTO_TEST_CASE(counts_beyond_32_bits) {
  vp::Counter bytes("bytes", "bytes moved");
  BOOST_TEST(bytes == 0u);
  ++bytes;
  bytes.add(std::uint64_t{1} << 40);
  BOOST_TEST(bytes.get() == (std::uint64_t{1} << 40) + 1);
  BOOST_TEST(bytes.documentation() == "bytes moved");
  bytes.reset();
  BOOST_TEST(bytes == 0u);
}

BOOST_AUTO_TEST_CASE(collects_in_the_order_of_construction) {
  Bus bus("bus");
  Link other("other");
  const std::vector<std::string> all{"bus.second.reads", "bus.second.writes", "bus.first.reads",
                                     "bus.first.writes", "bus.errors",        "other.reads",
                                     "other.writes"};
  const std::vector<std::string> below{"bus.first.reads", "bus.first.writes"};
  BOOST_TEST(names(vp::all_counters()) == all, boost::test_tools::per_element());
  BOOST_TEST(names(vp::counters_below(bus.first)) == below, boost::test_tools::per_element());
  BOOST_TEST(vp::counters_below(bus.errors).empty());
}

BOOST_AUTO_TEST_SUITE_END()
