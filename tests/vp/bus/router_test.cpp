#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include <bus_master.h>
#include <memory_target.h>
#include <simulation.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/configuration.h>
#include <vp/error.h>
#include <vp/router.h>

namespace {

struct Bench : kit::Simulation {
  Bench() {
    first.socket.bind(router.socket);
    second.socket.bind(router.socket);
    router.map("high", 0x8000, 0x100).bind(high.socket);
    router.map("low", 0x1000, 0x1000).bind(low.socket);
    router.map("through", 0x4000, 0x100, vp::Router::Addresses::absolute).bind(through.socket);
  }
  vp::ClockScheduler scheduler{"scheduler"};
  kit::BusMaster first{"first"};
  kit::BusMaster second{"second"};
  vp::Router router{"router"};
  kit::MemoryTarget low{"low_memory", 0x1000};
  kit::MemoryTarget high{"high_memory", 0x1000};
  kit::MemoryTarget through{"through_memory", 0x5000};
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(regions_are_found_by_address, Bench) {
  BOOST_TEST(router.find(0x0FFF) == nullptr);
  BOOST_TEST(router.find(0x1000)->name == "low");
  BOOST_TEST(router.find(0x1FFF)->name == "low");
  BOOST_TEST(router.find(0x2000) == nullptr);
  BOOST_TEST(router.find(0x80FF)->name == "high");
  BOOST_TEST(router.find(0x8100) == nullptr);
  BOOST_TEST(router.regions().size() == 3u);
}

BOOST_FIXTURE_TEST_CASE(accesses_reach_their_target, Bench) {
  second.set_script([&] {
    second.write(0x8004, 0x22222222);
    BOOST_TEST(second.payload.get_address() == 0x8004u);
  });
  first.simulate([&] {
    first.write(0x1004, 0x11111111);
    BOOST_TEST(first.response() == tlm::TLM_OK_RESPONSE);
    BOOST_TEST(first.payload.get_address() == 0x1004u);
    first.write(0x4010, 0x33333333);
    sc_core::wait(sc_core::sc_time(1, sc_core::SC_NS));
    BOOST_TEST(first.read(0x8004) == 0x22222222u);
  });
  BOOST_TEST(low.word(0x4) == 0x11111111u);
  BOOST_TEST(high.word(0x4) == 0x22222222u);
  BOOST_TEST(through.word(0x4010) == 0x33333333u);
  const vp::MmLink& link = *router.find(0x8000)->link;
  BOOST_TEST(std::string(link.name()) == "router.high");
  BOOST_TEST(link.writes == 1u);
  BOOST_TEST(link.reads == 1u);
  BOOST_TEST(link.bytes_read == 4u);
  BOOST_TEST(link.bytes_written == 4u);
  BOOST_TEST(link.errors == 0u);
}

BOOST_FIXTURE_TEST_CASE(a_miss_is_a_decode_error_and_nobody_is_asked, Bench) {
  first.simulate([&] {
    for (const std::uint64_t address : {0x0ull, 0x0FFCull, 0x2000ull, 0x8100ull, ~0ull - 3}) {
      first.read(address);
      BOOST_TEST(first.response() == tlm::TLM_ADDRESS_ERROR_RESPONSE);
      BOOST_TEST(first.payload.get_address() == address);
    }
    std::uint64_t data = 0;
    first.prepare(tlm::TLM_READ_COMMAND, 0x1FFC, &data, 8);
    first.send();
    BOOST_TEST(first.response() == tlm::TLM_ADDRESS_ERROR_RESPONSE, "leaves its region");
  });
  BOOST_TEST(router.decode_errors == 6u);
  BOOST_TEST(low.transactions == 0u);
}

BOOST_FIXTURE_TEST_CASE(errors_of_targets_pass_and_are_counted, Bench) {
  low.answer = tlm::TLM_GENERIC_ERROR_RESPONSE;
  first.simulate([&] {
    first.write(0x1000, 1);
    BOOST_TEST(first.response() == tlm::TLM_GENERIC_ERROR_RESPONSE);
    BOOST_TEST(first.payload.get_address() == 0x1000u);
  });
  BOOST_TEST(router.find(0x1000)->link->errors == 1u);
  BOOST_TEST(router.find(0x1000)->link->bytes_written == 0u);
  BOOST_TEST(router.decode_errors == 0u);
}

BOOST_FIXTURE_TEST_CASE(direct_memory_is_translated_and_clamped, Bench) {
  first.simulate([&] {
    std::uint32_t word = 0;
    tlm::tlm_dmi dmi;
    first.prepare(tlm::TLM_READ_COMMAND, 0x8010, &word, 4);
    BOOST_TEST(first.socket->get_direct_mem_ptr(first.payload, dmi));
    BOOST_TEST(first.payload.get_address() == 0x8010u);
    BOOST_TEST(dmi.get_start_address() == 0x8000u);
    BOOST_TEST(dmi.get_end_address() == 0x80FFu, "the memory is larger than what is mapped");
    BOOST_TEST(dmi.get_dmi_ptr() == high.data());

    dmi.init();
    first.prepare(tlm::TLM_READ_COMMAND, 0x4000, &word, 4);
    BOOST_TEST(first.socket->get_direct_mem_ptr(first.payload, dmi));
    BOOST_TEST(dmi.get_start_address() == 0x4000u);
    BOOST_TEST(dmi.get_end_address() == 0x40FFu);
    BOOST_TEST(dmi.get_dmi_ptr() == through.data() + 0x4000);

    dmi.init();
    first.prepare(tlm::TLM_READ_COMMAND, 0x2000, &word, 4);
    BOOST_TEST(!first.socket->get_direct_mem_ptr(first.payload, dmi));
    high.allow_dmi = false;
    first.prepare(tlm::TLM_READ_COMMAND, 0x8000, &word, 4);
    BOOST_TEST(!first.socket->get_direct_mem_ptr(first.payload, dmi));
  });
}

namespace {

struct Listener {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> ranges;
  void invalidate(sc_dt::uint64 first, sc_dt::uint64 last) { ranges.emplace_back(first, last); }
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(invalidation_reaches_every_initiator_clamped, Bench) {
  Listener one, two;
  first.invalidated = [&](std::uint64_t a, std::uint64_t b) { one.invalidate(a, b); };
  second.invalidated = [&](std::uint64_t a, std::uint64_t b) { two.invalidate(a, b); };
  first.simulate([&] {
    high.socket->invalidate_direct_mem_ptr(0x80, 0xFFF);
    high.socket->invalidate_direct_mem_ptr(0x200, 0xFFF);
  });
  BOOST_REQUIRE(one.ranges.size() == 1u);
  BOOST_TEST(one.ranges[0].first == 0x8080u);
  BOOST_TEST(one.ranges[0].second == 0x80FFu);
  BOOST_TEST(two.ranges.size() == 1u);
}

BOOST_FIXTURE_TEST_CASE(debug_access_ends_with_its_region, Bench) {
  first.simulate([&] {
    unsigned char bytes[16] = {1, 2, 3, 4};
    BOOST_TEST(first.debug(tlm::TLM_WRITE_COMMAND, 0x1FFC, bytes, 16) == 4u);
    BOOST_TEST(first.payload.get_address() == 0x1FFCu);
    BOOST_TEST(first.payload.get_data_length() == 16u);
    BOOST_TEST(low.word(0xFFC) == 0x04030201u);
    BOOST_TEST(first.debug(tlm::TLM_READ_COMMAND, 0x2000, bytes, 4) == 0u);
  });
  BOOST_TEST(router.find(0x1000)->link->writes == 0u);
}

BOOST_FIXTURE_TEST_CASE(a_router_without_a_master_is_refused_by_name, kit::Simulation) {
  vp::Router router("lonely");
  kit::MemoryTarget memory("memory", 0x1000);
  router.map("memory", 0, 0x1000).bind(memory.socket);
  std::string message;
  try {
    sc_core::sc_start(sc_core::SC_ZERO_TIME);
  } catch (const vp::InputError& error) {
    message = error.what();
  }
  BOOST_TEST(message ==
             "lonely: no master is connected, and it has 1 regions: bind a master to its socket, "
             "or leave it out");
}

BOOST_FIXTURE_TEST_CASE(overlapping_regions_are_refused_by_name, Bench) {
  for (const std::uint64_t base : {0x0F01ull, 0x1000ull, 0x1FFFull}) {
    try {
      router.map("intruder", base, 0x100);
      BOOST_ERROR("accepted");
    } catch (const vp::InputError& error) {
      const std::string message = error.what();
      BOOST_TEST(message.find("intruder") != std::string::npos);
      BOOST_TEST(message.find("low") != std::string::npos);
    }
  }
  BOOST_CHECK_THROW(router.map("empty", 0x9000, 0), vp::InputError);
  BOOST_CHECK_THROW(router.map("wrapping", ~0ull, 2), vp::InputError);
  BOOST_TEST(router.regions().size() == 3u);
}

namespace {

struct Log : vp::MmObserver {
  std::vector<std::string> lines;
  bool transactions = true;
  bool needs_transactions() const override { return transactions; }
  void before(vp::MmLink&, tlm::tlm_generic_payload& p, sc_core::sc_time&) override {
    lines.push_back("before " + std::to_string(p.get_address()));
  }
  void after(vp::MmLink&, tlm::tlm_generic_payload& p, sc_core::sc_time&) override {
    lines.push_back("after");
    if (inject) p.set_response_status(tlm::TLM_GENERIC_ERROR_RESPONSE);
  }
  void direct(vp::MmLink&, tlm::tlm_command, std::uint64_t address, std::uint64_t bytes) override {
    lines.push_back("direct " + std::to_string(address) + " " + std::to_string(bytes));
  }
  bool inject = false;
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(observers_see_and_change_what_passes, Bench) {
  vp::MmLink& link = *router.find(0x1000)->link;
  Log log;
  first.simulate([&] {
    link.add_observer(log);
    log.inject = true;
    first.write(0x1004, 1);
    BOOST_TEST(first.response() == tlm::TLM_GENERIC_ERROR_RESPONSE);
    BOOST_TEST(link.errors == 1u);
    std::uint32_t word = 0;
    tlm::tlm_dmi dmi;
    first.prepare(tlm::TLM_READ_COMMAND, 0x1000, &word, 4);
    BOOST_TEST(!first.socket->get_direct_mem_ptr(first.payload, dmi), "nothing may bypass it");
    log.transactions = false;
    BOOST_TEST(first.socket->get_direct_mem_ptr(first.payload, dmi));
    link.account(tlm::TLM_READ_COMMAND, 0x20, 128);
    link.remove_observer(log);
    first.write(0x1004, 1);
    BOOST_TEST(first.response() == tlm::TLM_OK_RESPONSE);
  });
  BOOST_TEST(log.lines == (std::vector<std::string>{"before 4", "after", "direct 32 128"}),
             boost::test_tools::per_element());
  BOOST_TEST(link.bytes_read == 128u);
}

BOOST_AUTO_TEST_CASE(latencies_are_cycles_of_the_clock) {
  kit::Simulation simulation;
  vp::Configuration configuration;
  configuration.set("router.read_latency=3 cycles");
  configuration.set("router.write_latency=5 cycles");
  vp::Configuration::Scope scope(configuration);
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 100'000'000);
  vp::Router router("router", &clock);
  configuration.check_unused();
  kit::BusMaster master("master");
  kit::MemoryTarget memory("memory", 0x1000);
  master.socket.bind(router.socket);
  router.map("memory", 0, 0x1000).bind(memory.socket);
  master.simulate([&] {
    master.read(0);
    BOOST_TEST(kit::now_ps() == 30'000u);
    master.write(0, 1);
    BOOST_TEST(kit::now_ps() == 80'000u);
    master.read(0x1000);
    BOOST_TEST(kit::now_ps() == 110'000u, "a decode error takes its time too");
  });
}
