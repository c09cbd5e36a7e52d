// On-chip memory, and the bus to the I/O peripherals.
#include "bus_master.h"

#include <ps/interconnect/interconnect.h>
#include <ps/memory/memory.h>
#include <vp/report.h>
#include <boost/test/unit_test.hpp>

#include "bench.h"

using namespace bench;
using kit::BusMaster;

namespace {

struct OcmBench : Bench {
  OcmBench() { bus.map("ocm", ps::Ocm::base, ps::Ocm::size).bind(ocm.socket); }
  ps::Ocm ocm{"ocm", cpu_clock};
};

struct MovedBench : OcmBench {
  vp::ReportRouter reports;
  explicit MovedBench(std::uint32_t at_top) : at_top(at_top) {
    bus.map("ocm_low", 0, ps::Ocm::size).bind(low.socket);
    ocm.follow([this] { return this->at_top; });
  }
  ps::OcmLow low{"ocm_low", ocm};
  std::uint32_t at_top;
};

struct MasterBench : kit::Simulation {
  MasterBench() { master.socket.bind(ocm.socket); }
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 1'000'000'000};
  ps::Ocm ocm{"ocm", clock};
  BusMaster master{"master"};
};

constexpr auto first = static_cast<std::uint32_t>(ps::Ocm::base);
constexpr std::uint32_t last = 0xFFFF'FFFC;

}  // namespace

BOOST_AUTO_TEST_SUITE(ocm_test)

BOOST_AUTO_TEST_CASE(a_program_reads_what_it_wrote_to_the_last_word) {
  OcmBench b;
  b.run([] {
    BOOST_TEST(hal_read32(first) == 0u);
    hal_write32(first, 0x1234'5678);
    hal_write32(last, 0x9ABC'DEF0);
    BOOST_TEST(hal_read32(first) == 0x1234'5678u);
    BOOST_TEST(hal_read32(last) == 0x9ABC'DEF0u);
    return 0;
  });
  BOOST_TEST(b.cpu.end_ps() == 5 * 24'000u);
  BOOST_TEST(b.ocm.contents()[0] == 0x78);
  BOOST_TEST(b.ocm.contents().back() == 0x9A);
  BOOST_TEST(b.ocm.reads == 3u);
  BOOST_TEST(b.ocm.writes == 2u);
}

BOOST_AUTO_TEST_CASE(three_quarters_are_at_0_after_boot_and_the_last_one_is_at_the_top) {
  MovedBench b(0x8);
  b.run([] {
    hal_write32(0, 1);
    hal_write32(0x2'FFFC, 2);
    hal_write32(0xFFFF'0000, 3);
    BOOST_TEST(hal_read32(0x2'FFFC) == 2u);
    return 0;
  });
  BOOST_TEST(b.cpu.end_ps() == 4 * 24'000u);
  BOOST_TEST(b.ocm.contents()[0] == 1);
  BOOST_TEST(b.ocm.contents()[0x2'FFFC] == 2);
  BOOST_TEST(b.ocm.contents()[0x3'0000] == 3);
  BOOST_TEST(b.reports.count("/markervp/ocm/elsewhere") == 0u);
}

BOOST_AUTO_TEST_CASE(a_quarter_that_is_at_0_is_told_once_where_it_is_used_at_the_top) {
  MovedBench b(0x8);
  b.run([] {
    hal_write32(first, 1);
    hal_write32(first + 4, 1);
    return 0;
  });
  BOOST_TEST(b.reports.count("/markervp/ocm/elsewhere") == 1u);
}

BOOST_AUTO_TEST_CASE(nothing_is_at_0_when_all_quarters_were_moved_to_the_top) {
  for (const std::uint32_t address : {0u, 0x3'0000u}) {
    MovedBench b(address == 0 ? 0x1F : 0x8);
    b.run(
        [=] {
          hal_write32(address, 1);
          return 0;
        },
        false);
    const std::string error = b.failure();
    BOOST_TEST(error.find("DECERR") != std::string::npos, error);
  }
}

BOOST_AUTO_TEST_CASE(bursts_take_a_cycle_for_each_further_8_bytes) {
  MasterBench b;
  b.master.simulate([&] {
    std::vector<unsigned char> data(64, 0xA5);
    b.master.prepare(tlm::TLM_WRITE_COMMAND, 0x100, data.data(), 64);
    b.master.send();
    BOOST_TEST(kit::now_ps() == 31'000u);  // 24 + 7
    BOOST_TEST(b.master.payload.is_dmi_allowed());
    std::vector<unsigned char> back(64, 0);
    b.master.prepare(tlm::TLM_READ_COMMAND, 0x100, back.data(), 64);
    b.master.send();
    BOOST_TEST(back == data, boost::test_tools::per_element());
  });
}

BOOST_AUTO_TEST_CASE(byte_enables_streaming_and_errors) {
  MasterBench b;
  b.master.simulate([&] {
    b.master.write(0, 0x1111'1111);
    std::uint32_t word = 0xFFFF'FFFF;
    unsigned char enables[] = {0, TLM_BYTE_ENABLED, 0, 0};
    b.master.prepare(tlm::TLM_WRITE_COMMAND, 0, &word, 4);
    b.master.payload.set_byte_enable_ptr(enables);
    b.master.payload.set_byte_enable_length(4);
    b.master.send();
    BOOST_TEST(b.master.read(0) == 0x1111'FF11u);

    const auto answer = [&](std::uint64_t address, unsigned length, unsigned streaming) {
      unsigned char data[16] = {};
      b.master.prepare(tlm::TLM_READ_COMMAND, address, data, length);
      b.master.payload.set_streaming_width(streaming);
      b.master.send();
      return b.master.response();
    };
    BOOST_TEST(answer(ps::Ocm::size, 4, 4) == tlm::TLM_ADDRESS_ERROR_RESPONSE);
    BOOST_TEST(answer(ps::Ocm::size - 4, 8, 8) == tlm::TLM_ADDRESS_ERROR_RESPONSE);
    BOOST_TEST(answer(ps::Ocm::size - 4, 8, 4) == tlm::TLM_OK_RESPONSE, "a FIXED burst");
    BOOST_TEST(answer(0, 4, 0) == tlm::TLM_BURST_ERROR_RESPONSE);
    b.master.access(tlm::TLM_IGNORE_COMMAND, 0, &word);
    BOOST_TEST(b.master.response() == tlm::TLM_COMMAND_ERROR_RESPONSE);
    b.master.prepare(tlm::TLM_READ_COMMAND, 0, &word, 4);
    b.master.payload.set_byte_enable_ptr(enables);
    b.master.send();
    BOOST_TEST(b.master.response() == tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
  });
}

BOOST_AUTO_TEST_CASE(debug_and_direct_access) {
  MasterBench b;
  b.master.simulate([&] {
    std::uint32_t word = 0x5566'7788;
    BOOST_TEST(b.master.debug(tlm::TLM_WRITE_COMMAND, 8, &word, 4) == 4u);
    std::uint64_t both = 0;
    BOOST_TEST(b.master.debug(tlm::TLM_READ_COMMAND, ps::Ocm::size - 4, &both, 8) == 4u);
    BOOST_TEST(b.master.debug(tlm::TLM_READ_COMMAND, ps::Ocm::size, &both, 8) == 0u);
    BOOST_TEST(b.master.debug(tlm::TLM_IGNORE_COMMAND, 0, &both, 8) == 0u);
    tlm::tlm_dmi dmi;
    b.master.prepare(tlm::TLM_READ_COMMAND, 8, &word, 4);
    BOOST_TEST(b.master.socket->get_direct_mem_ptr(b.master.payload, dmi));
    BOOST_TEST(dmi.get_start_address() == 0u);
    BOOST_TEST(dmi.get_end_address() == ps::Ocm::size - 1);
    BOOST_TEST(dmi.get_dmi_ptr()[8] == 0x88);
    BOOST_TEST(dmi.get_read_latency() == sc_core::sc_time(24, sc_core::SC_NS));
    b.master.prepare(tlm::TLM_READ_COMMAND, ps::Ocm::size, &word, 4);
    BOOST_TEST(!b.master.socket->get_direct_mem_ptr(b.master.payload, dmi));
    BOOST_TEST(kit::now_ps() == 0u);
    BOOST_TEST(b.ocm.reads == 0u);
  });
}

BOOST_AUTO_TEST_CASE(peripheral_accesses_take_cycles_of_the_cpu) {
  Bench b;
  ps::RegisterBus bus("peripheral_bus", b.cpu_clock, ps::peripheral_bus_times);
  b.bus.map("peripherals", 0xE000'0000, 0x1000, vp::Router::Addresses::absolute).bind(bus.socket);
  Device device("uart0", b.scheduler);
  bus.devices.map("uart0", 0xE000'0000, 0x1000).bind(device.socket);
  b.run([] {
    hal_read32(0xE000'002C);
    hal_write32(0xE000'0030, 7);
    return 0;
  });
  const std::vector<Device::Access> expected{{false, 0x2C, 0, 39'000}, {true, 0x30, 7, 117'000}};
  BOOST_TEST(device.log == expected, boost::test_tools::per_element());
  BOOST_TEST(b.cpu.end_ps() == 156'000u);
}

BOOST_AUTO_TEST_CASE(nothing_at_a_peripheral_address) {
  Bench b;
  ps::RegisterBus bus("peripheral_bus", b.cpu_clock, ps::peripheral_bus_times);
  b.bus.map("peripherals", 0xE000'0000, 0x1000, vp::Router::Addresses::absolute).bind(bus.socket);
  b.run([] { return static_cast<int>(hal_read32(0xE000'0000)); }, false);
  BOOST_TEST(b.failure().find("0xE0000000: DECERR") != std::string::npos, b.failure());
}

BOOST_AUTO_TEST_SUITE_END()
