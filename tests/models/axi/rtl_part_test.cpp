// RTL with one interface of each kind as a part of a design.
#include <boost/test/unit_test.hpp>

#include <bus_master.h>
#include <memory_target.h>
#include <simulation.h>

#include <cstdint>
#include <string>
#include <vector>

#include <axi/rtl_part.h>
#include <vp/axi_stream.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/router.h>

namespace {

const std::string everything = MARKERVP_EVERYTHING_RTL;

/// The part with all of its interfaces connected, software and memory.
struct Bench : kit::Simulation {
  static constexpr std::uint64_t period = 10'000;  // ps
  static constexpr unsigned burst_words = 8;       // of 32 bits

  Bench() {
    bus.map("part", 0x4000'0000, 0x1000).bind(part.slave("s_axi_control").socket);
    software.socket.bind(bus.socket);
    for (xilinx::MemoryPort* port :
         {&part.master("m_axi_gmem").read, &part.master("m_axi_gmem").write})
      port->link.socket.bind(memory_bus.socket);
    memory_bus.map("memory", 0, 0x1'0000).bind(memory.socket);
    source.m_axis(in);
    part.stream_in("in")(in);
    part.stream_out("out")(out);
    sink.s_axis(out);
    part.input("ap_rst_n", reset_n);
    part.input("mode", mode);
  }
  void put(std::uint32_t offset, std::uint32_t word) { software.write(0x4000'0000 + offset, word); }
  std::uint32_t get(std::uint32_t offset) { return software.read(0x4000'0000 + offset); }
  void wait_clocks(unsigned clocks) {
    sc_core::wait(sc_core::sc_time::from_value(clocks * period));
  }

  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  vp::Router bus{"bus"}, memory_bus{"memory_bus"};
  kit::BusMaster software{"software"};
  kit::MemoryTarget memory{"memory", 0x1'0000};
  vp::AxiStream in{"in"}, out{"out"};
  vp::StreamSource source{"source", clock};
  vp::StreamSink sink{"sink", clock};
  vp::Signal<bool> reset_n{"reset_n", 1, true};
  vp::Signal<std::uint8_t> mode{"mode"};
  axi::RtlPart part{"part", everything, {{"ap_clk", &clock}}};
  vp::Signal<bool>& interrupt = part.output<bool>("interrupt");
  vp::Signal<std::uint32_t>& leds = part.output<std::uint32_t>("leds");
};

/// `call` is refused, and says each of `words`.
template <class Call>
void refused(Call call, const std::vector<std::string>& words) {
  std::string message;
  try {
    call();
  } catch (const vp::InputError& error) {
    message = error.what();
  }
  for (const std::string& word : words)
    BOOST_TEST(message.find(word) != message.npos, "'" << word << "' in: " << message);
}

}  // namespace

BOOST_FIXTURE_TEST_CASE(interfaces_are_found_by_the_names_of_ports, Bench) {
  std::vector<std::string> found;
  for (const axi::Interface& one : part.interfaces())
    found.push_back(std::string(to_string(one.kind)) + " " + one.name +
                    (one.slave ? " in" : " out"));
  const std::vector<std::string> expected{"clock ap_clk in",
                                          "reset ap_rst_n in",
                                          "interrupt interrupt out",
                                          "AXI4-Lite s_axi_control in",
                                          "AXI4 m_axi_gmem out",
                                          "AXI4-Stream in in",
                                          "AXI4-Stream out out",
                                          "wire mode in",
                                          "wire leds out"};
  BOOST_TEST(found == expected, boost::test_tools::per_element());
}

BOOST_FIXTURE_TEST_CASE(registers_answer_on_exact_clocks, Bench) {
  software.simulate([&] {
    put(0x18, 0x1234'5678);
    BOOST_TEST(kit::now_ps() == 2 * period + period);  // from the first edge on
    BOOST_TEST(get(0x18) == 0x1234'5678u);
    BOOST_TEST(kit::now_ps() == 5 * period);
    put(0x10, 0xFFFF'FFFF);
    std::uint8_t byte = 0x42;
    software.prepare(tlm::TLM_WRITE_COMMAND, 0x4000'0011, &byte, 1);
    software.send();
    BOOST_TEST(get(0x10) == 0xFFFF'42FFu);
    get(0x3C);
    BOOST_TEST(software.response() == tlm::TLM_GENERIC_ERROR_RESPONSE);
    get(0x30);
    BOOST_TEST(software.response() == tlm::TLM_OK_RESPONSE);
  });
}

BOOST_FIXTURE_TEST_CASE(the_master_copies_memory_and_interrupts, Bench) {
  for (unsigned i = 0; i < 0x100; ++i) memory.data()[0x1000 + i] = static_cast<unsigned char>(i);
  software.simulate([&] {
    put(0x10, 0x1000);
    put(0x18, 0x2000);
    put(0x00, 8u << 16 | 1);
    BOOST_TEST(!interrupt);
    wait_clocks(8 * 60);
    BOOST_TEST(interrupt);
    BOOST_TEST(get(0x00) == 2u);  // done, cleared by the reading
    BOOST_TEST(!interrupt);
  });
  BOOST_TEST(std::equal(memory.data() + 0x1000, memory.data() + 0x1100, memory.data() + 0x2000));
  BOOST_TEST(part.master("m_axi_gmem").bursts == 16u);
}

BOOST_FIXTURE_TEST_CASE(a_stream_passes_through_logic_within_the_clock, Bench) {
  sink.ready_on = [](std::uint64_t cycle) { return cycle % 3 != 0; };
  for (std::uint32_t i = 0; i < 20; ++i) source.send(i, i % 5 == 4);
  software.simulate([&] { wait_clocks(60); });
  BOOST_REQUIRE(sink.beats.size() == 20u);
  for (std::uint32_t i = 0; i < 20; ++i) {
    BOOST_TEST(sink.beats[i].data == ~i);
    BOOST_TEST(sink.beats[i].last == (i % 5 == 4));
    BOOST_TEST(sink.beats[i].keep == 0xFu);
  }
  // Both links saw every beat, on the same clocks.
  BOOST_TEST(in.beats == 20u);
  BOOST_TEST(out.beats == 20u);
  BOOST_TEST(in.stalls == out.stalls);
}

BOOST_FIXTURE_TEST_CASE(wires_follow_within_the_instant, Bench) {
  software.simulate([&] {
    wait_clocks(2);
    mode = 41;
    BOOST_TEST(leds == 42u);
  });
}

BOOST_FIXTURE_TEST_CASE(rtl_at_rest_sleeps, Bench) {
  software.simulate([&] { wait_clocks(10'000); });
  BOOST_TEST(clock.edges_run() < 100u);
}

BOOST_FIXTURE_TEST_CASE(an_access_in_reset_ends_the_run, Bench) {
  reset_n = false;
  bool ended = false;
  software.simulate([&] {
    wait_clocks(4);
    try {
      get(0x10);
    } catch (const vp::ProtocolError& error) {
      const std::string message = error.what();
      ended = message.find("RVALID") != message.npos || message.find("ARREADY") != message.npos;
    }
  });
  BOOST_TEST(ended);
}

BOOST_FIXTURE_TEST_CASE(what_does_not_go_together_is_refused, Bench) {
  refused([&] { part.slave("control"); }, {"everything.so", "AXI4-Lite", "s_axi_control"});
  refused([&] { part.slave("m_axi_gmem"); }, {"everything.sv", "master"});
  refused([&] { part.input("mode", mode); }, {"mode", "connected twice"});
  refused([&] { part.tie("leds", 1); }, {"leds", "output"});
  refused([&] { axi::RtlPart other("other", everything, {}); }, {"needs a clock"});
  refused([&] { axi::RtlPart other("other", everything, {{"clk", &clock}}); }, {"clk", "ap_clk"});
}
