// RTL with streams of other widths than 32 bits, and with TSTRB, TUSER, TID and TDEST.
#include <boost/test/unit_test.hpp>

#include <bus_master.h>
#include <input_error.h>
#include <memory_target.h>
#include <simulation.h>

#include <cstdint>
#include <iterator>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include <axi/rtl_part.h>
#include <pl/common/rtl_object.h>
#include <vp/axi_stream.h>
#include <vp/clock_scheduler.h>
#include <vp/configuration.h>
#include <vp/report.h>
#include <vp/rule_reports.h>
#include <xilinx/axis_buffer/axis_buffer.h>

namespace {

/// Words of 32 bits become beats of 1024, pass RTL with what goes along, a FIFO and RTL again.
struct Bench : kit::Simulation {
  Bench() {
    part.input("rst_n", reset_n);
    source.m_axis(words);
    widen.s_axis(words);
    widen.m_axis(wide);
    part.stream_in("wide_in")(wide);
    part.stream_out("wide_out")(out);
  }
  void run(unsigned clocks) { sc_core::sc_start(sc_core::sc_time(10 * clocks, sc_core::SC_NS)); }

  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  vp::Signal<bool> reset_n{"reset_n", 1, true};
  vp::AxiStream words{"words"}, wide{"wide"}, out{"out"};
  vp::StreamSource source{"source", clock};
  xilinx::AxisBuffer widen{"widen", clock, {4, 128, 4, 1}};
  axi::RtlPart part{"part", MARKERVP_STREAMS_RTL, {{"clk", &clock}}};
};

void leave_narrow_open(axi::RtlPart& part) {
  for (const char* open : {"narrow_in", "narrow_out"}) part.leave_open(open);
}

}  // namespace

BOOST_FIXTURE_TEST_CASE(beats_of_1024_bits_pass_with_all_their_bytes, Bench) {
  leave_narrow_open(part);
  part.leave_open("seen");
  xilinx::AxisBuffer narrow("narrow", clock, {128, 4, 64, 1});
  vp::AxiStream back("back");
  vp::StreamSink sink("sink", clock);
  narrow.s_axis(out);
  narrow.m_axis(back);
  sink.s_axis(back);
  constexpr std::uint32_t count = 70;  // the last beat has six words
  for (std::uint32_t i = 0; i < count; ++i) source.send(i * 0x0101'0101u, i + 1 == count);
  run(400);
  BOOST_REQUIRE(sink.beats.size() == count);
  for (std::uint32_t i = 0; i < count; ++i) {
    BOOST_TEST(sink.beats[i].data == ~(i * 0x0101'0101u));
    BOOST_TEST(sink.beats[i].last == (i + 1 == count));
    BOOST_TEST(sink.beats[i].keep == 0xFu);
  }
  BOOST_TEST(wide.beats == 3u);
  BOOST_TEST(out.bytes() == 128u);
}

BOOST_FIXTURE_TEST_CASE(what_goes_along_reaches_other_rtl_through_a_fifo, Bench) {
  leave_narrow_open(part);
  xilinx::AxisBuffer fifo("fifo", clock, {128, 128, 16, 3, 128, 40, 4, 3});
  vp::AxiStream seen("seen");
  fifo.s_axis(out);
  fifo.m_axis(seen);
  part.stream_in("seen")(seen);
  auto& user = part.output<std::uint64_t>("user");
  auto& id = part.output<std::uint8_t>("id");
  auto& dest = part.output<std::uint8_t>("dest");
  auto& strobes = part.output<std::uint8_t>("strobes");
  auto& top = part.output<bool>("top_byte_is_set");
  for (std::uint32_t i = 0; i < 96; ++i) source.send(0, i == 95);
  run(300);
  BOOST_TEST(out.beats == 3u);
  BOOST_TEST(user == 0x3'0000'0003u);
  BOOST_TEST(id == 3u);
  BOOST_TEST(dest == 5u);
  BOOST_TEST(strobes == 0xFDu);
  BOOST_TEST(top);
}

BOOST_FIXTURE_TEST_CASE(a_narrow_stream_takes_its_width_from_the_rtl, kit::Simulation) {
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 100'000'000);
  axi::RtlPart part("part", MARKERVP_STREAMS_RTL, {{"clk", &clock}});
  vp::StreamSource source("source", clock);
  vp::StreamSink sink("sink", clock);
  vp::AxiStream in("in"), out("out");
  source.m_axis(in);
  part.stream_in("narrow_in")(in);
  part.stream_out("narrow_out")(out);
  sink.s_axis(out);
  for (const char* open : {"wide_in", "wide_out", "seen"}) part.leave_open(open);
  for (std::uint32_t i = 0; i < 9; ++i) source.send(i, i == 8, 1);
  sc_core::sc_start(sc_core::sc_time(200, sc_core::SC_NS));
  BOOST_REQUIRE(sink.beats.size() == 9u);
  for (std::uint32_t i = 0; i < 9; ++i) {
    BOOST_TEST(sink.beats[i].data == (~i & 0xFF));
    BOOST_TEST(sink.beats[i].keep == 1u);
    BOOST_TEST(sink.beats[i].last == (i == 8));
  }
  BOOST_TEST(out.bytes() == 1u);
}

namespace {

/// Words that went wrong between a clock of `from` and one of `to` Hz, with a sink that pauses, and
/// the edge of the latter that passes the first one.
struct Crossed {
  unsigned wrong = 0;
  std::uint64_t first = 0;
  std::uint64_t rules_broken = 0;
};
Crossed cross(std::uint64_t from, std::uint64_t to) {
  constexpr std::uint32_t count = 1000;
  const kit::Simulation simulation;
  vp::ReportRouter reports;
  std::ostringstream text;
  reports.redirect(text);
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock s_clk("s_clk", scheduler, from), m_clk("m_clk", scheduler, to);
  axi::RtlPart part("part", MARKERVP_CROSSING_RTL,
                    {{"s_axis_aclk", &s_clk}, {"m_axis_aclk", &m_clk}});
  vp::StreamSource source("source", s_clk);
  vp::StreamSink sink("sink", m_clk);
  vp::AxiStream in("in"), out("out");
  source.m_axis(in);
  part.stream_in("s_axis")(in);
  part.stream_out("m_axis")(out);
  sink.s_axis(out);
  sink.ready_on = [](std::uint64_t cycle) { return cycle % 5 != 0; };
  for (std::uint32_t i = 0; i < count; ++i) source.send(i * 0x0101'0101u, i % 7 == 6);
  sc_core::sc_start(sc_core::sc_time(60, sc_core::SC_US));
  Crossed crossed;
  BOOST_REQUIRE(sink.beats.size() == count);
  for (std::uint32_t i = 0; i < count; ++i)
    crossed.wrong += sink.beats[i].data != i * 0x0101'0101u || sink.beats[i].last != (i % 7 == 6);
  crossed.first = sink.beats.front().cycle;
  crossed.rules_broken = reports.warnings().size();
  BOOST_TEST(text.str().find("rule") == std::string::npos, text.str());
  return crossed;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_fifo_has_a_stream_on_each_of_its_two_clocks) {
  for (const auto& [from, to, first] : {std::tuple{100'000'000u, 77'000'000u, 4u},
                                        {77'000'000u, 100'000'000u, 5u},
                                        {100'000'000u, 100'000'000u, 5u}}) {
    const Crossed crossed = cross(from, to);
    BOOST_TEST(crossed.wrong == 0u);
    BOOST_TEST(crossed.rules_broken == 0u);
    BOOST_TEST(crossed.first == first);
  }
}

BOOST_FIXTURE_TEST_CASE(ends_of_other_widths_are_refused_and_both_named, Bench) {
  xilinx::AxisBuffer words_only("words_only", clock, {4, 4, 4, 1});
  BOOST_TEST(input_error([&] { words_only.s_axis(out); }) ==
             "part.wide_out sends 1024 bits of TDATA, and words_only.s_axis takes 32 bits: put a "
             "width converter between");
}

BOOST_FIXTURE_TEST_CASE(bits_of_tuser_that_would_be_lost_are_refused, Bench) {
  xilinx::AxisBuffer fifo("fifo", clock, {128, 128, 16, 3, 0, 8});
  BOOST_TEST(input_error([&] { fifo.s_axis(out); }) ==
             "part.wide_out sends 40 bits of TUSER, and fifo.s_axis takes 8 bits: the upper ones "
             "would be lost; make both alike");
}

BOOST_FIXTURE_TEST_CASE(of_bits_that_say_nothing_to_it_a_receiver_takes_its_own, Bench) {
  vp::StreamSink sink("sink", clock);
  vp::StreamShape shape{"sink", 128};
  shape.user = 1;
  shape.ignores_upper_bits = true;
  sink.s_axis.set_shape(shape);
  BOOST_TEST(input_error([&] { sink.s_axis(out); }) == "nothing thrown");
}

namespace {

/// The rules that RTL breaks, which a receiver lets wait and then takes, and a reset ends.
std::string broken_by(unsigned fault, vp::Configuration& configuration) {
  const vp::Configuration::Scope scope(configuration);
  kit::Simulation simulation;
  const vp::ProtocolChecks checks("checks");
  std::ostringstream text;
  vp::ReportRouter reports;
  reports.redirect(text);
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 100'000'000);
  vp::Signal<bool> reset_n("reset_n", 1, true);
  axi::RtlPart part("part", MARKERVP_FAULTY_STREAM_RTL, {{"clk", &clock}});
  vp::AxiStream link("link");
  vp::StreamSink sink("sink", clock);
  kit::BusMaster script("script");
  kit::MemoryTarget nothing("nothing", 4);
  script.socket.bind(nothing.socket);
  sink.ready_on = [](std::uint64_t cycle) { return cycle % 10 == 9; };
  part.input("rst_n", reset_n);
  part.tie("fault", fault);
  part.stream_out("m_axis")(link);
  sink.s_axis(link);
  script.simulate([&] {
    script.wait_until(500'000);
    reset_n = false;
    script.wait_until(700'000);
    reset_n = true;
    script.wait_until(800'000);
  });
  std::string names;
  for (const vp::Warning& warning : reports.warnings())
    names += warning.id.substr(warning.id.rfind('_', warning.id.rfind('_') - 1) + 1) + " ";
  return names;
}

}  // namespace

BOOST_AUTO_TEST_CASE(each_violation_of_a_stream_at_the_pins_is_seen) {
  const char* const rules[] = {"",
                               "TVALID_STABLE ",
                               "TDATA_STABLE ",
                               "TLAST_STABLE ",
                               "TKEEP_STABLE ",
                               "TUSER_STABLE ",
                               "TKEEP_GAP ",
                               "TVALID_RESET "};
  vp::Configuration none;
  for (unsigned fault = 0; fault < std::size(rules); ++fault)
    BOOST_TEST(broken_by(fault, none) == rules[fault]);
}

BOOST_AUTO_TEST_CASE(links_are_not_watched_where_the_configuration_says_so) {
  vp::Configuration configuration;
  configuration.set("checks.watch", "false");
  for (const unsigned fault : {1u, 4u, 7u}) BOOST_TEST(broken_by(fault, configuration) == "");
  configuration.check_unused();
}

// Without a path from an input to an output, an edge is one evaluation: that must be found where it
// is true, and only there.
BOOST_AUTO_TEST_CASE(outputs_that_are_registers_are_known_as_such) {
  const auto notes = [](const char* file) {
    const RtlDescriptor& rtl = pl::open_rtl(file);
    std::string found;
    for (std::uint32_t i = 0; i < rtl.note_count; ++i) {
      const std::string what = rtl.notes[i].what;
      if (what == "registered" || what == "edge") found += what + ' ' + rtl.notes[i].port + ' ';
    }
    return found;
  };
  BOOST_TEST(notes(MARKERVP_REGISTERED_RTL) == "registered  edge rst_n ");
  BOOST_TEST(notes(MARKERVP_STREAMS_RTL) == "");        // TREADY follows TREADY
  BOOST_TEST(notes(MARKERVP_FAULTY_STREAM_RTL) == "");  // TVALID follows rst_n
}

BOOST_FIXTURE_TEST_CASE(a_reset_without_a_clock_works_between_edges_and_on_them, kit::Simulation) {
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 100'000'000);
  vp::Signal<bool> reset_n("reset_n", 1, true);
  vp::AxiStream in("in"), out("out");
  vp::StreamSource source("source", clock);
  vp::StreamSink sink("sink", clock);
  axi::RtlPart part("part", MARKERVP_REGISTERED_RTL, {{"clk", &clock}});
  part.input("rst_n", reset_n);
  source.m_axis(in);
  part.stream_in("in")(in);
  part.stream_out("out")(out);
  sink.s_axis(out);
  vp::Signal<std::uint8_t>& words = part.output<std::uint8_t>("words");
  kit::BusMaster software("software");
  kit::MemoryTarget memory("memory", 64);
  software.socket.bind(memory.socket);
  for (std::uint32_t i = 0; i < 40; ++i) source.send(i, i % 4 == 3);
  std::string seen;
  software.simulate([&] {
    for (const std::uint64_t at : {103'000u, 200'000u}) {  // between two edges, and on one
      software.wait_until(at);
      scheduler.synchronise();
      seen += std::to_string(words.get()) + ' ';
      reset_n = false;
      seen += std::to_string(words.get()) + (out.tvalid.get() ? " valid " : " low ");
      software.wait_until(at + 21'000);
      scheduler.synchronise();
      reset_n = true;
    }
    software.wait_until(400'000);
  });
  BOOST_TEST(seen == "3 0 low 3 0 low ");
  // Every third clock a word; those that were under way are lost.
  std::string data;
  for (const auto& beat : sink.beats)
    data += std::to_string(beat.cycle) + ':' + std::to_string(beat.data) + (beat.last ? "! " : " ");
  BOOST_TEST(data == "3:1 6:2 9:3 15:4! 18:5 25:7 28:8! 31:9 34:10 37:11 40:12! ");
}
