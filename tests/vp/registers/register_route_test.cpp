// Accesses by a route do what those through the sockets do, at the same times.
#include <boost/test/unit_test.hpp>
#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <memory_target.h>
#include <simulation.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/configuration.h>
#include <vp/counter.h>
#include <vp/error.h>
#include <vp/mm_link.h>
#include <vp/register_bank.h>
#include <vp/register_route.h>
#include <vp/report.h>
#include <vp/router.h>

namespace {

using vp::Access;

constexpr vp::RegisterInfo registers[] = {
    {"PLAIN", 0x0, 0x11, Access::read_write, 0xFFFF, ""},
    {"STATUS", 0x4, 0xF0, Access::write_1_to_clear, 0xFF, ""},
    {"FIXED", 0x8, 0x22, Access::read_only, 0, ""},
    {"EFFECT", 0x10, 0, Access::read_write, 0xFFFFFFFF, ""},
};

/// An initiator that uses routes where there are any, or never.
struct Initiator : sc_core::sc_module {
  SC_HAS_PROCESS(Initiator);
  Initiator(sc_core::sc_module_name name, vp::ClockScheduler& scheduler, bool by_route)
      : sc_module(name), scheduler(scheduler), by_route(by_route) {
    SC_THREAD(run);
  }
  void run() {
    script();
    scheduler.rejoin();
    sc_core::sc_stop();
  }

  void access(bool read, std::uint64_t address, std::uint32_t word = 0) {
    vp::RegisterRoute* route = by_route ? routes.find(address) : nullptr;
    tlm::tlm_response_status status = tlm::TLM_INCOMPLETE_RESPONSE;
    std::uint64_t end = 0;
    if (route) {
      ++used;
      const auto answer = route->transfer(scheduler.now_ps(), read, word);
      status = answer.status;
      end = answer.ps;
    } else {
      status = by_socket(read, address, word, end);
    }
    std::ostringstream line;
    line << (read ? "read " : "write ") << address << " " << word << " status " << status << " at "
         << scheduler.now_ps() << " until " << end;
    lines.push_back(line.str());
    scheduler.pass_until(end);
  }
  tlm::tlm_response_status by_socket(bool read, std::uint64_t address, std::uint32_t& word,
                                     std::uint64_t& end) {
    tlm::tlm_generic_payload payload;
    payload.set_command(read ? tlm::TLM_READ_COMMAND : tlm::TLM_WRITE_COMMAND);
    payload.set_address(address);
    payload.set_data_ptr(reinterpret_cast<unsigned char*>(&word));
    payload.set_data_length(sizeof word);
    payload.set_streaming_width(sizeof word);
    sc_core::sc_time delay;
    link.transport(payload, delay);
    end = scheduler.now_ps() + vp::to_ps(delay);
    return payload.get_response_status();
  }

  vp::MmLink link{"link"};
  vp::RegisterRoutes routes{link};
  vp::ClockScheduler& scheduler;
  bool by_route;
  unsigned used = 0;
  std::vector<std::string> lines;
  std::function<void()> script;
};

struct Observer : vp::MmObserver {
  void before(vp::MmLink&, tlm::tlm_generic_payload&, sc_core::sc_time&) override { ++seen; }
  unsigned seen = 0;
};

/// A request is on its way for 13 ns and leaves at an edge; the answer takes 6 ns, a read at least
/// 100 periods of a GHz, a write none.
struct Port : vp::Bridge {
  Port(sc_core::sc_module_name name, const vp::Clock& clock)
      : Bridge(name, clock, Leaves::on_an_edge) {}
  Times times(bool read) const override { return {13'000, read ? 100'000u : 0u, 6'000}; }
};

struct Bench : kit::Simulation {
  explicit Bench(bool by_route, std::vector<std::string> settings = {})
      : scope(with(std::move(settings))), initiator("initiator", scheduler, by_route) {
    configuration.check_unused();
    reports.redirect(text);
    scheduler.set_lookahead(1'000'000);
    initiator.link.socket.bind(outer.socket);
    outer.map("inner", 0x4000'0000, 0x1000'0000, vp::Router::Addresses::absolute)
        .bind(inner.socket);
    inner.map("bank", 0x4120'0000, 0x1'0000).bind(bank.socket);
    inner.map("memory", 0x4130'0000, 0x100).bind(memory.socket);
    outer.map("port", 0x6000'0000, 0x1'0000).bind(port.socket);
    port.link.socket.bind(behind_port.socket);
    behind_port.map("far_bank", 0x0, 0x1'0000).bind(far_bank.socket);
    bank[0x10].after_write([this](std::uint32_t word) {
      effects.push_back(std::to_string(word) + " at " + std::to_string(scheduler.now_ps()));
    });
    bank[0x10].computed_by([this] { return static_cast<std::uint32_t>(clock.cycle()); });
  }
  vp::Configuration& with(std::vector<std::string> settings) {
    for (const std::string& setting : settings) configuration.set(setting);
    return configuration;
  }
  /// Everything that can be seen after the script.
  std::vector<std::string> run(std::function<void(Bench&)> script) {
    initiator.script = [this, script] { script(*this); };
    sc_core::sc_start();
    std::vector<std::string> all = initiator.lines;
    all.insert(all.end(), effects.begin(), effects.end());
    for (const vp::Counter* counter : vp::all_counters()) {
      all.push_back(std::string(counter->name()) + " " + std::to_string(counter->get()));
    }
    for (const vp::Register& r : bank.registers()) {
      const vp::Register::Use& use = r.use();
      std::ostringstream line;
      line << r.info().name << " " << r.value() << " " << use.reads << " " << use.writes << " "
           << use.read_ones << " " << use.read_zeros << " " << use.written_ones << " "
           << use.written_zeros;
      all.push_back(line.str());
    }
    all.push_back("warnings " + std::to_string(reports.count(sc_core::SC_WARNING)));
    return all;
  }

  vp::Configuration configuration;
  vp::Configuration::Scope scope;
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  Initiator initiator;
  vp::Router outer{"outer"};
  vp::Router inner{"inner", &clock};
  vp::RegisterBank bank{"bank", registers, {}, &scheduler};
  kit::MemoryTarget memory{"memory", 0x100};
  vp::Clock port_clock{"port_clock", scheduler, 125'000'000};
  Port port{"port", port_clock};
  vp::Router behind_port{"behind_port"};
  vp::RegisterBank far_bank{"far_bank", registers, {}, &scheduler};
  std::ostringstream text;
  vp::ReportRouter reports;
  std::vector<std::string> effects;
};

constexpr std::uint64_t base = 0x4120'0000;
constexpr std::uint64_t port_base = 0x6000'0000;

/// Runs a script both ways and compares. Returns how many accesses went by a route.
unsigned compare(const std::function<void(Bench&)>& script,
                 const std::vector<std::string>& settings = {}) {
  Bench by_socket(false, settings);
  const auto expected = by_socket.run(script);
  Bench by_route(true, settings);
  const auto seen = by_route.run(script);
  BOOST_TEST(seen == expected, boost::test_tools::per_element());
  BOOST_TEST(by_socket.initiator.used == 0u);
  return by_route.initiator.used;
}

void everything(Bench& b) {
  for (const std::uint64_t offset : {0x0, 0x4, 0x8, 0x10}) {
    b.initiator.access(true, base + offset);
    b.initiator.access(false, base + offset, 0x1234'56F1);
    b.initiator.access(true, base + offset);
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(register_routes)

BOOST_AUTO_TEST_CASE(every_kind_of_register) {
  BOOST_TEST(compare(everything) == 12u);
}

BOOST_AUTO_TEST_CASE(latencies_on_the_way) {
  BOOST_TEST(compare(everything, {"inner.read_latency=3 cycles"}) == 12u);
  BOOST_TEST(
      compare(everything, {"inner.read_latency=7 cycles", "inner.write_latency=11 cycles"}) == 12u);
}

BOOST_AUTO_TEST_CASE(a_bridge_is_passed_in_the_same_time) {
  const unsigned used = compare([](Bench& b) {
    b.initiator.access(true, port_base);
    b.initiator.access(false, port_base, 5);
    b.initiator.access(true, port_base + 0x4);
    b.scheduler.pass_until(b.scheduler.now_ps() + 3'333);
    b.initiator.access(false, port_base + 0x8, 1);
    b.port_clock.set_frequency(40'000'000);
    b.initiator.access(true, port_base);
    b.initiator.access(true, port_base + 0xC);  // a hole
  });
  BOOST_TEST(used == 5u);
}

BOOST_AUTO_TEST_CASE(the_times_of_a_bridge) {
  for (const bool by_route : {false, true}) {
    Bench bench(by_route);
    bench.run([](Bench& b) {
      b.initiator.access(true, port_base);      // leaves at 16 ns, the second edge after 13
      b.initiator.access(false, port_base, 5);  // leaves at 113, so at 120 ns
    });
    const std::vector<std::string> expected{"read 1610612736 17 status 1 at 16000 until 100000",
                                            "write 1610612736 5 status 1 at 120000 until 126000"};
    BOOST_TEST(bench.initiator.lines == expected, boost::test_tools::per_element());
  }
}

BOOST_AUTO_TEST_CASE(a_clock_that_changes_while_a_bridge_holds_a_request) {
  const unsigned used = compare([](Bench& b) {
    sc_core::sc_spawn([&b] {
      sc_core::wait(5, sc_core::SC_NS);
      b.port_clock.set_frequency(10'000'000);  // edges at 105 ns, 205 ns …
    });
    b.initiator.access(true, port_base);
    BOOST_TEST(b.initiator.lines.back() == "read 1610612736 17 status 1 at 105000 until 111000");
  });
  BOOST_TEST(used == 1u);
}

BOOST_AUTO_TEST_CASE(a_bridge_whose_clock_stands_is_a_bus_that_hangs) {
  for (const bool by_route : {false, true}) {
    Bench bench(by_route);
    std::string message;
    bench.run([&](Bench& b) {
      b.port_clock.set_frequency(0);
      try {
        b.initiator.access(true, port_base + 4);
      } catch (const vp::ProtocolError& error) {
        message = error.what();
      }
    });
    BOOST_TEST(message ==
               "bus hang: read of 0x00000004 through port, but the clock port_clock is stopped");
  }
}

BOOST_AUTO_TEST_CASE(direct_memory_behind_a_bridge_is_refused) {
  Bench bench(true);
  bench.run([](Bench& b) {
    tlm::tlm_generic_payload payload;
    payload.set_address(port_base);
    payload.set_read();
    payload.set_data_length(4);
    tlm::tlm_dmi dmi;
    BOOST_TEST(!b.initiator.link.direct_memory(payload, dmi));
    std::uint32_t word = 0;
    payload.set_data_ptr(reinterpret_cast<unsigned char*>(&word));
    BOOST_TEST(b.initiator.link.transport_debug(payload) == 4u, "but a debugger may look");
    BOOST_TEST(word == 0x11u);
  });
}

BOOST_AUTO_TEST_CASE(errors_are_answered_and_counted_the_same) {
  const unsigned used = compare([](Bench& b) {
    b.initiator.access(true, base + 0xC);       // a hole
    b.initiator.access(true, base + 0x2);       // unaligned
    b.initiator.access(true, 0x4140'0000);      // nothing there
    b.initiator.access(false, 0x1000'0000, 1);  // nor there
    b.bank.hold_in_reset(true);
    b.initiator.access(true, base);
    b.initiator.access(false, base, 1);
    b.bank.hold_in_reset(false);
    b.initiator.access(true, base);
  });
  BOOST_TEST(used == 3u, "only where there is a register");
}

BOOST_AUTO_TEST_CASE(what_is_no_register_has_no_route) {
  const unsigned used = compare([](Bench& b) {
    b.initiator.access(false, 0x4130'0010, 77);
    b.initiator.access(true, 0x4130'0010);
  });
  BOOST_TEST(used == 0u);
}

BOOST_AUTO_TEST_CASE(observers_anywhere_take_routes_away) {
  const std::vector<std::function<vp::MmLink&(Bench&)>> links{
      [](Bench& b) -> vp::MmLink& { return b.initiator.link; },
      [](Bench& b) -> vp::MmLink& { return *b.outer.find(base)->link; },
      [](Bench& b) -> vp::MmLink& { return *b.inner.find(base)->link; }};
  for (const auto& link : links) {
    unsigned seen = 0;
    const unsigned used = compare([&](Bench& b) {
      Observer observer;
      b.initiator.access(true, base);
      link(b).add_observer(observer);
      b.initiator.access(true, base);
      b.initiator.access(false, base, 3);
      link(b).remove_observer(observer);
      b.initiator.access(true, base);
      seen = observer.seen;
    });
    BOOST_TEST(used == 2u, "before and after");
    BOOST_TEST(seen == 2u);
  }
}

BOOST_AUTO_TEST_CASE(an_observer_that_is_there_from_the_start) {
  Observer observer;
  Bench b(true);
  b.inner.find(base)->link->add_observer(observer);
  b.run([](Bench& bench) { bench.initiator.access(true, base); });
  BOOST_TEST(b.initiator.used == 0u);
  BOOST_TEST(observer.seen == 1u);
}

BOOST_AUTO_TEST_CASE(ordinary_direct_memory_is_refused_by_registers) {
  Bench b(true);
  b.run([](Bench& bench) {
    tlm::tlm_generic_payload payload;
    payload.set_address(base);
    payload.set_read();
    payload.set_data_length(4);
    tlm::tlm_dmi dmi;
    BOOST_TEST(!bench.initiator.link.direct_memory(payload, dmi));
    BOOST_TEST(vp::RegisterRoute::asked_for(payload) == nullptr);
  });
}

BOOST_AUTO_TEST_CASE(the_time_of_a_read) {
  Bench direct(true);
  direct.run([](Bench& b) {
    vp::RegisterRoute* route = b.initiator.routes.find(base);
    BOOST_TEST_REQUIRE(route);
    BOOST_TEST((route->read_time_ps() == std::optional<std::uint64_t>(0)));
    BOOST_TEST(route->arrival_ps(77) == 77u);
    BOOST_TEST(route->stable_until_ps() == 0u, "it does not tell");
    BOOST_TEST(route->peek() == 0x11u);
  });
  Bench slow(true, {"inner.read_latency=3 cycles"});
  slow.run([](Bench& b) {
    vp::RegisterRoute* route = b.initiator.routes.find(base);
    BOOST_TEST_REQUIRE(route);
    BOOST_TEST(!route->read_time_ps(), "nothing holds its answer back");
    BOOST_TEST(route->arrival_ps(77) == 30'077u);
  });
}

BOOST_AUTO_TEST_SUITE_END()
