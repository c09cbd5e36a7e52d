// Access times of the port to the PL and of the private bus.
#include <ps/interconnect/interconnect.h>
#include <vp/error.h>
#include <boost/test/unit_test.hpp>

#include "bench.h"

using namespace bench;

namespace {

struct PortBench : Bench {
  explicit PortBench(std::uint64_t pl_hertz = 100'000'000) {
    pl_clock.set_frequency(pl_hertz);
    bus.map("m_axi_gp0", 0x8000'0000, 0x1000'0000).bind(port.socket);
    port.link.socket.bind(slave.socket);
  }
  ps::GpPort port{"port", pl_clock};
  Device slave{"slave", scheduler};

  /// Time at the slave and time after the access, started at `start_ps`.
  std::pair<std::uint64_t, std::uint64_t> access(bool write, std::uint32_t start_ns) {
    run([=] {
      hal_work(step, start_ns);
      if (write) {
        hal_write32(0x8000'0010, 5);
      } else {
        hal_read32(0x8000'0010);
      }
      return 0;
    });
    return {slave.times().at(0), cpu.end_ps()};
  }
};

using Pair = std::pair<std::uint64_t, std::uint64_t>;

Pair read_at(std::uint64_t hertz, std::uint32_t start_ns) {
  return PortBench(hertz).access(false, start_ns);
}
Pair write_at(std::uint64_t hertz, std::uint32_t start_ns) {
  return PortBench(hertz).access(true, start_ns);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(gp_port)

BOOST_AUTO_TEST_CASE(a_read_takes_80_ns_and_8_clocks) {
  // The slave samples at the first edge (multiples of 10 ns) at or after 40 ns and 4 clocks.
  BOOST_TEST((read_at(100'000'000, 0) == Pair(80'000, 160'000)));
  BOOST_TEST((read_at(100'000'000, 1) == Pair(90'000, 161'000)));
  BOOST_TEST((read_at(100'000'000, 10) == Pair(90'000, 170'000)));
  BOOST_TEST((read_at(100'000'000, 19) == Pair(100'000, 179'000)));
}

BOOST_AUTO_TEST_CASE(a_write_takes_96_ns_and_6_5_clocks) {
  BOOST_TEST((write_at(100'000'000, 0) == Pair(90'000, 161'000)));
  BOOST_TEST((write_at(100'000'000, 2) == Pair(90'000, 163'000)));
  BOOST_TEST((write_at(100'000'000, 3) == Pair(100'000, 164'000)));
}

BOOST_AUTO_TEST_CASE(the_clock_of_the_pl_counts) {
  BOOST_TEST((read_at(200'000'000, 0) == Pair(60'000, 120'000)));
  BOOST_TEST((read_at(50'000'000, 0) == Pair(120'000, 240'000)));
  BOOST_TEST((write_at(200'000'000, 0) == Pair(70'000, 128'500)));
  // 148.5 MHz: 8 clocks are 53 872 ps; 40 ns and 4 clocks are 66 936 ps, edge 10 is at 67 340 ps.
  BOOST_TEST((read_at(148'500'000, 0) == Pair(67'340, 133'872)));
}

BOOST_AUTO_TEST_CASE(a_slave_may_take_part_of_the_rest_or_more) {
  PortBench part;
  part.slave.delay_ps = 30'000;
  BOOST_TEST((part.access(false, 0) == Pair(80'000, 160'000)));
  PortBench more;
  more.slave.wait_ps = 50'000;
  more.slave.delay_ps = 50'000;
  BOOST_TEST((more.access(false, 0) == Pair(130'000, 180'000)));
}

BOOST_AUTO_TEST_CASE(accesses_keep_their_address_and_are_counted) {
  PortBench b;
  b.access(true, 0);
  BOOST_TEST(b.slave.log.at(0).write);
  BOOST_TEST(b.slave.log.at(0).address == 0x10u);
  BOOST_TEST(b.slave.log.at(0).value == 5u);
  BOOST_TEST(b.port.link.writes == 1u);
}

BOOST_AUTO_TEST_CASE(a_stopped_clock_is_an_error_not_a_hang) {
  PortBench b(0);
  b.run(
      [] {
        hal_function_enter(inner);
        return hal_read32(0x8000'0010) ? 1 : 0;
      },
      false);
  BOOST_CHECK_THROW(b.cpu.check(), vp::ProtocolError);
  BOOST_TEST(b.failure() ==
             "bus hang: read of 0x00000010 through port, but the clock pl_clock is stopped"
             ", at 0 ps in function 'inner' of program 'bench'");
}

BOOST_AUTO_TEST_CASE(a_clock_that_changes_on_the_way) {
  PortBench b;
  sc_core::sc_spawn([&] {
    sc_core::wait(vp::from_ps(20'000));
    b.pl_clock.set_frequency(8'000'000);  // edges at 145 ns, 270 ns …
  });
  BOOST_TEST((b.access(false, 0) == Pair(145'000, 160'000)));
}

BOOST_AUTO_TEST_CASE(private_accesses_take_cycles_of_the_cpu) {
  Bench b;
  ps::RegisterBus bus("private_bus", b.cpu_clock, ps::private_bus_times);
  b.bus.map("private", ps::private_bus_base, ps::private_bus_size, vp::Router::Addresses::absolute)
      .bind(bus.socket);
  Device timer("timer", b.scheduler);
  bus.devices.map("timer", 0xF8F0'0200, 0x20).bind(timer.socket);
  b.run([] {
    hal_work(step, 1);
    hal_read32(0xF8F0'0204);      // 32 cycles
    hal_write32(0xF8F0'0208, 7);  // 24 cycles
    return 0;
  });
  const std::vector<Device::Access> expected{{false, 4, 0, 17'000}, {true, 8, 7, 45'000}};
  BOOST_TEST(timer.log == expected, boost::test_tools::per_element());
  BOOST_TEST(b.cpu.end_ps() == 57'000u);
}

BOOST_AUTO_TEST_CASE(nothing_at_a_private_address) {
  Bench b;
  ps::RegisterBus bus("private_bus", b.cpu_clock, ps::private_bus_times);
  b.bus.map("private", ps::private_bus_base, ps::private_bus_size, vp::Router::Addresses::absolute)
      .bind(bus.socket);
  b.run([] { return hal_read32(0xF8F0'0600) ? 1 : 0; }, false);
  BOOST_TEST(b.failure().find("0xF8F00600: DECERR") != std::string::npos, b.failure());
}

BOOST_AUTO_TEST_SUITE_END()
