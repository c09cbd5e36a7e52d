#include <vp/power_meter.h>

#include <boost/test/unit_test.hpp>
#include <cmath>

using namespace vp;

namespace {

EnergyEntry entry(const std::string& module, const std::string& rail, PowerKind kind, double j) {
  return {module, module.substr(0, 2), rail, kind, "test", {j / 2, j, 2 * j}};
}

/// Entries of very different size, as a run has them.
EnergyLedger some_ledger() {
  EnergyLedger ledger;
  for (int i = 0; i < 1000; ++i) {
    ledger.add(entry(i % 3 == 0 ? "ps.cores" : "pl.blob", i % 2 == 0 ? "Vccint" : "Vccpint",
                     static_cast<PowerKind>(i % 4), 1e-9 * std::pow(1.02, i)));
  }
  return ledger;
}

template <class Map>
double sum(const Map& parts) {
  double total = 0;
  for (const auto& part : parts) total += part.second.nominal;
  return total;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(energy_ledger)

BOOST_AUTO_TEST_CASE(every_sum_is_the_total) {
  const EnergyLedger ledger = some_ledger();
  const double total = ledger.total().nominal;
  const auto near = boost::test_tools::tolerance(1e-9);
  BOOST_TEST(sum(ledger.by_module()) == total, near);
  BOOST_TEST(sum(ledger.by_rail()) == total, near);
  BOOST_TEST(sum(ledger.by_group()) == total, near);
  BOOST_TEST(sum(ledger.by_kind()) == total, near);
}

BOOST_AUTO_TEST_CASE(an_entry_that_is_left_out_shows) {
  EnergyLedger ledger = some_ledger();
  const double modules = sum(ledger.by_module());
  ledger.add(entry("pl.forgotten", "Vccint", PowerKind::event, modules * 1e-8));
  BOOST_TEST(std::abs(modules - ledger.total().nominal) > 1e-9 * modules);
}

BOOST_AUTO_TEST_CASE(the_same_module_rail_and_kind_is_one_entry) {
  EnergyLedger ledger;
  ledger.add(entry("ps.cores", "Vccpint", PowerKind::state, 1));
  ledger.add(entry("ps.cores", "Vccpint", PowerKind::state, 2));
  ledger.add(entry("ps.cores", "Vccpint", PowerKind::event, 4));
  BOOST_TEST(ledger.entries().size() == 2u);
  BOOST_TEST(ledger.entries()[0].joules.nominal == 3.0);
  BOOST_TEST(ledger.entries()[0].joules.low == 1.5);
  BOOST_TEST(ledger.total().high == 14.0);
}

// Errors of two coefficients are independent; those of one are the same, wherever it is used.
BOOST_AUTO_TEST_CASE(causes_add_up_in_quadrature) {
  EnergyLedger ledger;
  const auto add = [&](const char* module, const char* source, const char* cause, double below,
                       double above) {
    ledger.add(
        {module, "pl", "Vccint", PowerKind::state, source, {10 - below, 10, 10 + above}, cause});
  };
  add("pl.a", "logic", "", 3, 6);
  add("pl.b", "clock", "", 4, 8);
  BOOST_TEST(ledger.total().low == 15.0);
  BOOST_TEST(ledger.total().nominal == 20.0);
  BOOST_TEST(ledger.total().high == 30.0);
  add("pl.c", "clock", "", 0, 1);  // the same source
  BOOST_TEST(ledger.total().high == 30 + std::hypot(6, 9));
  add("pl.d", "memory", "activity", 0, 2);
  add("pl.e", "multiplier", "activity", 0, 2);  // another source of the same cause
  BOOST_TEST(ledger.total().high == 50 + std::hypot(std::hypot(6, 9), 4),
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(ledger.by_module().at("pl.b").high == 18.0);
}

BOOST_AUTO_TEST_CASE(another_source_is_another_entry) {
  EnergyLedger ledger;
  ledger.add({"pl.a", "pl", "Vccint", PowerKind::state, "logic", {1, 1, 1}});
  ledger.add({"pl.a", "pl", "Vccint", PowerKind::state, "multipliers", {1, 2, 3}});
  BOOST_TEST(ledger.entries().size() == 2u);
  BOOST_TEST(ledger.by_module().at("pl.a").nominal == 3.0);
}

BOOST_AUTO_TEST_CASE(ledgers_add_up) {
  EnergyLedger all = some_ledger();
  all.add(some_ledger());
  BOOST_TEST(all.total().nominal == 2 * some_ledger().total().nominal,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(all.entries().size() == some_ledger().entries().size());
}

BOOST_AUTO_TEST_CASE(kinds_have_names) {
  BOOST_TEST(to_string(PowerKind::leakage) == "static");
  BOOST_TEST(to_string(PowerKind::clock) == "clock");
  BOOST_TEST(to_string(PowerKind::state) == "state");
  BOOST_TEST(to_string(PowerKind::event) == "event");
}

BOOST_AUTO_TEST_SUITE_END()
