// RTL with one interface of each kind as a part of a design.
#include <bitset>
#include <boost/test/unit_test.hpp>

#include <bus_master.h>
#include <fcntl.h>
#include <memory_target.h>
#include <simulation.h>
#include <temporary_files.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <axi/rtl_part.h>
#include <vp/axi_stream.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/report.h>
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

BOOST_FIXTURE_TEST_CASE(what_describes_registers_lies_beside_the_object, Bench) {
  std::filesystem::path beside = everything;
  BOOST_TEST(part.registers_file() == beside.replace_extension(".registers.rdl").string());
  BOOST_TEST(std::filesystem::exists(beside));
  axi::RtlPart other("other", MARKERVP_TWO_CLOCKS_RTL, {{"a_clk", &clock}, {"b_clk", &clock}});
  BOOST_TEST(other.registers_file() == "");
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

BOOST_FIXTURE_TEST_CASE(pins_are_in_the_trace, Bench) {
  software.simulate([&] { put(0x18, 5); });
  const auto width = [](const char* pin) {
    const auto* signal = dynamic_cast<vp::SignalBase*>(sc_core::sc_find_object(pin));
    return signal ? signal->width() : 0;
  };
  BOOST_TEST(width("part.s_axi_control_AWVALID") == 1u);
  BOOST_TEST(width("part.m_axi_gmem_ARADDR") == 64u);
  BOOST_TEST(width("part.interrupt") == 1u);
}

BOOST_FIXTURE_TEST_CASE(rtl_at_rest_sleeps_and_wakes, kit::Simulation) {
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 100'000'000);
  kit::BusMaster software("software");
  axi::RtlPart part("part", everything, {{"ap_clk", &clock}});
  software.socket.bind(part.slave("s_axi_control").socket);
  for (const char* open : {"m_axi_gmem", "in", "out"}) part.leave_open(open);
  part.tie("mode", 3);
  software.simulate([&] {
    software.wait_until(100'000'000);
    BOOST_TEST(clock.edges_run() < 100u);
    software.write(0x18, 7);
    BOOST_TEST(software.read(0x18) == 7u);
  });
}

// Where the edges of both clocks coincide, each register samples the other as it was before.
BOOST_FIXTURE_TEST_CASE(clocks_that_coincide_rise_together, kit::Simulation) {
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock fast("fast", scheduler, 100'000'000), slow("slow", scheduler, 50'000'000);
  kit::BusMaster script("script");
  kit::MemoryTarget nothing("nothing", 4);
  script.socket.bind(nothing.socket);
  axi::RtlPart part("part", MARKERVP_TWO_CLOCKS_RTL, {{"a_clk", &fast}, {"b_clk", &slow}});
  auto& a = part.output<std::uint8_t>("a");
  auto& b = part.output<std::uint8_t>("b");
  std::string values;
  script.simulate([&] {
    for (unsigned edge = 1; edge <= 6; ++edge) {
      script.wait_until(edge * 10'000 + 1'000);
      values += std::to_string(a.get()) + std::to_string(b.get()) + " ";
    }
  });
  // Both are 16 at the start: so many clocks it was reset for.
  BOOST_TEST(values == "1716 1718 1918 1920 2120 2122 ");
}

BOOST_FIXTURE_TEST_CASE(a_loop_that_does_not_settle_ends_the_run, kit::Simulation) {
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 100'000'000);
  axi::RtlPart part("part", everything, {{"ap_clk", &clock}});
  for (const char* open : {"s_axi_control", "m_axi_gmem", "in", "out"}) part.leave_open(open);
  part.input("mode", part.output<std::uint8_t>("leds"));  // which are mode + 1
  std::string message;
  try {
    sc_core::sc_start(sc_core::sc_time(100, sc_core::SC_NS));
  } catch (const sc_core::sc_report& report) {
    message = report.what();
  }
  BOOST_TEST(message.find("combinational loop") != message.npos, message);
}

namespace {

/// Rules that are broken while `reset_n` is low from `from` to `to` ps.
std::string broken_by_reset(Bench& bench, std::uint64_t from, std::uint64_t to) {
  std::ostringstream text;
  vp::ReportRouter reports;
  reports.redirect(text);
  bench.software.simulate([&] {
    bench.software.wait_until(from);
    bench.reset_n = false;
    bench.software.wait_until(to);
    bench.reset_n = true;
    bench.software.wait_until(to + 100'000);
  });
  std::string names;
  for (const vp::Warning& warning : reports.warnings())
    names += warning.id.substr(warning.id.rfind('/') + 1) + " ";
  return names;
}

/// A value that changes on each edge of a clock.
class Counting final : public vp::Clocked {
 public:
  Counting(sc_core::sc_module_name name, vp::Clock& clock) : Clocked(name, clock) {}
  vp::Signal<std::uint8_t> value{"value"};

 private:
  void edge() override { value = static_cast<std::uint8_t>(value + 1); }
};

/// How often a wire of RTL at 100 MHz that a counter at `hertz` drives did not stay.
std::size_t crossings(std::uint64_t hertz) {
  kit::Simulation simulation;
  std::ostringstream text;
  vp::ReportRouter reports;
  reports.redirect(text);
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 100'000'000), other("other", scheduler, hertz);
  Counting counter("counter", other);
  axi::RtlPart part("part", everything, {{"ap_clk", &clock}});
  for (const char* open : {"s_axi_control", "m_axi_gmem", "in", "out"}) part.leave_open(open);
  part.input("mode", counter.value);
  sc_core::sc_start(sc_core::sc_time(1, sc_core::SC_US));
  return reports.count("/markervp/rule/CLOCK_CROSSING");
}

}  // namespace

BOOST_FIXTURE_TEST_CASE(a_reset_of_16_clocks_that_ends_on_an_edge_is_silent, Bench) {
  BOOST_TEST(broken_by_reset(*this, 50'000, 210'000) == "");
}
BOOST_FIXTURE_TEST_CASE(a_reset_of_three_clocks_is_too_short, Bench) {
  BOOST_TEST(broken_by_reset(*this, 50'000, 80'000) == "RESET_WIDTH ");
}
BOOST_FIXTURE_TEST_CASE(a_reset_that_ends_between_edges_belongs_to_another_clock, Bench) {
  BOOST_TEST(broken_by_reset(*this, 50'000, 213'000) == "RESET_DOMAIN ");
}
BOOST_AUTO_TEST_CASE(a_wire_that_comes_from_another_clock_and_stays_is_silent) {
  BOOST_TEST(crossings(40'000'000) == 0u);
}
BOOST_AUTO_TEST_CASE(a_wire_that_comes_from_another_clock_and_does_not_stay) {
  BOOST_TEST(crossings(70'000'000) == 1u);
}

// It follows at the end of each instant, two of them in a row, and no wire of it crosses clocks.
BOOST_AUTO_TEST_CASE(logic_without_a_clock_follows_its_inputs) {
  kit::Simulation simulation;
  std::ostringstream text;
  vp::ReportRouter reports;
  reports.redirect(text);
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 100'000'000), other("other", scheduler, 70'000'000);
  Counting counter("counter", other);
  refused([&] { axi::RtlPart("none", MARKERVP_GATES_RTL, {}); }, {"needs a clock", "no port, ''"});
  refused(
      [&] {
        axi::RtlPart("clocked", everything, {{"", &clock}});
      },
      {"clock 'ap_clk' is not connected"});
  axi::RtlPart first("first", MARKERVP_GATES_RTL, {{"", &clock}});
  axi::RtlPart second("second", MARKERVP_GATES_RTL, {{"", &clock}});
  first.input("a", counter.value);
  auto& inverted = first.output<std::uint8_t>("inverted");
  second.input("a", inverted);
  auto& twice = second.output<std::uint8_t>("inverted");
  auto& parity = second.output<bool>("parity");
  for (unsigned n = 1; n < 20; ++n) {
    sc_core::sc_start(sc_core::sc_time(15, sc_core::SC_NS));
    BOOST_TEST(twice.get() == counter.value.get());
    BOOST_TEST(inverted.get() == static_cast<std::uint8_t>(~counter.value.get()));
    BOOST_TEST(parity.get() == (std::bitset<8>(inverted.get()).count() % 2 == 1));
  }
  BOOST_TEST(counter.value.get() >= 19);
  BOOST_TEST(reports.warnings().empty());
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
  axi::RtlPart held("held", everything, {{"ap_clk", &clock}});
  refused([&] { held.tie("ap_rst_n", 0); }, {"ap_rst_n", "leave it open"});
  for (const char* open : {"s_axi_control", "m_axi_gmem", "in", "out", "mode"})
    held.leave_open(open);
  refused([&] { axi::RtlPart other("other", everything, {{"clk", &clock}}); }, {"clk", "ap_clk"});
}

// RTL that ignores its responses would go on with what it did not read.
BOOST_FIXTURE_TEST_CASE(addresses_without_memory_are_told_of_once, Bench) {
  std::ostringstream text;
  vp::ReportRouter reports;
  reports.redirect(text);
  software.simulate([&] {
    wait_clocks(20);
    put(0x10, 0x3'0000);
    put(0x18, 0x100);
    put(0x00, 2u << 16 | 1);
    wait_clocks(300);
  });
  BOOST_TEST(reports.count("/markervp/rtl/decode") == 1u);
  BOOST_TEST(text.str().find("part.m_axi_gmem: it reads 0x00030000, where nothing answers") !=
                 std::string::npos,
             text.str());
}

BOOST_AUTO_TEST_CASE(a_master_that_reaches_no_memory_is_refused) {
  kit::Simulation simulation;
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 100'000'000);
  kit::MemoryTarget memory("memory", 0x1'0000);
  axi::RtlPart part("part", everything, {{"ap_clk", &clock}});
  for (const char* open : {"s_axi_control", "in", "out"}) part.leave_open(open);
  part.tie("mode", 0);
  part.master("m_axi_gmem").read.link.socket.bind(memory.socket);
  refused([] { sc_core::sc_start(sc_core::SC_ZERO_TIME); },
          {"everything.sv:", "master 'm_axi_gmem' reaches no memory", "read and write"});
}

// What a command prints may go into a file.
BOOST_FIXTURE_TEST_CASE(what_rtl_prints_is_no_output_of_a_command, kit::Simulation) {
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 100'000'000);
  const kit::TemporaryFolder folder;
  const auto printed = [&](std::FILE* stream) {
    const std::string file = folder / "printed";
    std::fflush(stream);
    const int kept = ::dup(::fileno(stream)), other = ::creat(file.c_str(), 0600);
    ::dup2(other, ::fileno(stream));
    axi::RtlPart part(sc_core::sc_gen_unique_name("part"), MARKERVP_GATES_RTL, {{"", &clock}});
    part.tie("a", 0);
    std::fflush(stream);
    ::dup2(kept, ::fileno(stream));
    ::close(kept);
    ::close(other);
    return kit::read_file(file);
  };
  BOOST_TEST(printed(stdout) == "");
  BOOST_TEST(printed(stderr) == "gates are made\n");
}
