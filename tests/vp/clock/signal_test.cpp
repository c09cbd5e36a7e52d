#include "recorder.h"

#include <simulation.h>
#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(signals)

struct Fixture : kit::Simulation {
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
};

/// A module of standard SystemC, bound to our signal by sc_in.
struct Foreign : sc_core::sc_module {
  SC_HAS_PROCESS(Foreign);
  explicit Foreign(sc_core::sc_module_name name) : sc_module(name) {
    SC_METHOD(note);
    sensitive << in;
    dont_initialize();
  }
  void note() { seen.emplace_back(kit::now_ps(), in.read()); }
  sc_core::sc_in<std::uint32_t> in{"in"};
  std::vector<std::pair<std::uint64_t, std::uint32_t>> seen;
};

BOOST_FIXTURE_TEST_CASE(a_foreign_module_sees_each_change_at_its_time, Fixture) {
  CountingModule source{"source", clock};
  Foreign foreign{"foreign"};
  foreign.in(source.count);
  run_to(35'000);
  BOOST_REQUIRE(foreign.seen.size() == 3u);
  for (std::uint32_t i = 0; i < 3; ++i) {
    BOOST_TEST(foreign.seen[i].first == 10'000u * (i + 1));
    BOOST_TEST(foreign.seen[i].second == i + 1);
  }
}

struct Listener : vp::SignalListener {
  void on_change(vp::SignalBase& signal, std::uint32_t id) override {
    values.push_back(signal.bits());
    last_id = id;
  }
  std::vector<std::uint64_t> values;
  std::uint32_t last_id = 0;
};

struct Inverter : vp::SignalForce {
  std::uint64_t seen(std::uint64_t driven) override { return inverts ? ~driven & 0x1F : driven; }
  bool inverts = true;
};

BOOST_FIXTURE_TEST_CASE(a_force_decides_what_a_signal_shows, Fixture) {
  vp::Signal<std::uint8_t> wire{"wire", 5, 3};
  Listener listener;
  wire.attach(listener);
  Inverter inverter;
  wire.force(&inverter);
  BOOST_TEST(wire.is_forced());
  BOOST_TEST(wire.get() == 3u, "until it is asked, or written to");
  wire.drive_again();
  wire = 1;
  wire = 1;
  inverter.inverts = false;
  wire.drive_again();
  wire.force(nullptr);
  wire = 2;
  BOOST_TEST((listener.values == std::vector<std::uint64_t>{28, 30, 1, 2}));
  wire.detach(listener);
}

BOOST_FIXTURE_TEST_CASE(what_drives_nothing_cannot_be_forced, Fixture) {
  BOOST_TEST(!vp::Signal<double>("real").can_be_forced());
  BOOST_TEST(vp::Signal<bool>("bit").can_be_forced());
  vp::Signal<bool> wire{"wire"};
  Inverter first, second;
  wire.force(&first);
  BOOST_CHECK_THROW(wire.force(&second), std::logic_error);
}

BOOST_FIXTURE_TEST_CASE(listeners_hear_changes_only, Fixture) {
  vp::Signal<std::uint8_t> wire{"wire", 5, 3};
  Listener listener;
  wire.attach(listener, 9);
  wire = 3;
  wire = 4;
  wire = 4;
  wire.detach(listener);
  wire = 5;
  const std::vector<std::uint64_t> expected{4};
  BOOST_TEST(listener.values == expected, boost::test_tools::per_element());
  BOOST_TEST(listener.last_id == 9u);
  BOOST_TEST(wire.get() == 5u);
  BOOST_TEST(wire.width() == 5u);
}

BOOST_FIXTURE_TEST_CASE(real_values_show_their_bits, Fixture) {
  vp::Signal<double> power{"power", 64, 1.0};
  BOOST_TEST(power.is_real());
  BOOST_TEST(power.bits() == 0x3FF0'0000'0000'0000u);
}

BOOST_FIXTURE_TEST_CASE(the_writer_is_the_module_around_the_signal_unless_told, Fixture) {
  CountingModule source{"source", clock}, driver{"driver", clock};
  vp::Signal<std::uint32_t> link{"link"};
  BOOST_TEST(source.count.writer() == &source);
  BOOST_TEST(link.writer() == nullptr);
  vp::Out<std::uint32_t> out{&driver};
  out(link);
  BOOST_TEST(link.writer() == &driver);
}

BOOST_AUTO_TEST_SUITE_END()
