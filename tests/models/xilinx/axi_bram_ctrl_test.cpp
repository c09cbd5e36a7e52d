#include <boost/test/unit_test.hpp>
#include <numeric>
#include <sstream>
#include <vector>

#include <simulation.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/configuration.h>
#include <vp/error.h>
#include <vp/report.h>
#include <xilinx/axi_bram_ctrl/axi_bram_ctrl.h>
#include <xilinx/axi_cdma/axi_cdma.h>
#include "bus_master.h"

using kit::BusMaster;
using xilinx::AxiBramCtrlBuild;

namespace {

constexpr std::uint64_t period = 10'000;  // ps: 100 MHz

struct Bench : kit::Simulation {
  explicit Bench(const AxiBramCtrlBuild& build = {}) : bram("bram", clock, build) {
    reports.redirect(text);
    master.socket.bind(bram.s_axi);
    bram.s_axi_aresetn(aresetn);
  }
  /// Duration of one burst in ps.
  std::uint64_t burst(tlm::tlm_command command, std::uint64_t address, unsigned bytes) {
    std::vector<unsigned char> data(bytes, 0);
    const std::uint64_t start = kit::now_ps();
    master.prepare(command, address, data.data(), bytes);
    master.send();
    return kit::now_ps() - start;
  }
  tlm::tlm_response_status answer(std::uint64_t address, unsigned bytes, unsigned streaming) {
    std::vector<unsigned char> data(bytes, 0);
    master.prepare(tlm::TLM_READ_COMMAND, address, data.data(), bytes);
    master.payload.set_streaming_width(streaming);
    master.send();
    return master.response();
  }

  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  BusMaster master{"master"};
  vp::Signal<bool> aresetn{"aresetn", 1, true};
  xilinx::AxiBramCtrl bram;
  std::ostringstream text;
  vp::ReportRouter reports;
};

AxiBramCtrlBuild with(bool axi4_lite, bool single_port) {
  AxiBramCtrlBuild build;
  build.axi4_lite = axi4_lite;
  build.single_port = single_port;
  return build;
}

constexpr auto a_read = tlm::TLM_READ_COMMAND;
constexpr auto a_write = tlm::TLM_WRITE_COMMAND;

}  // namespace

BOOST_AUTO_TEST_SUITE(axi_bram_ctrl)

BOOST_AUTO_TEST_CASE(a_wider_beat_carries_more) {
  AxiBramCtrlBuild build;
  build.data_bytes = 8;
  Bench b(build);
  b.master.simulate([&] {
    BOOST_TEST(b.burst(a_read, 0, 8) == 3 * period + period, "from 0 to the first edge, then 3");
    BOOST_TEST(b.burst(a_read, 0, 64) == (3 + 7) * period);
    BOOST_TEST(b.burst(a_read, 4, 64) == (3 + 8) * period, "its ends are half a beat each");
    BOOST_TEST(b.answer(0, 2048, 2048) == tlm::TLM_OK_RESPONSE);
  });
}

BOOST_AUTO_TEST_CASE(words_and_bursts_keep_their_bytes) {
  Bench b;
  b.master.simulate([&] {
    b.master.write(0, 0x1122'3344);
    b.master.write(8188, 0x5566'7788);
    BOOST_TEST(b.master.read(0) == 0x1122'3344u);
    BOOST_TEST(b.master.read(8188) == 0x5566'7788u);
    std::vector<unsigned char> out(1024), in(1024, 0);
    std::iota(out.begin(), out.end(), static_cast<unsigned char>(1));
    b.master.prepare(a_write, 1024, out.data(), 1024);
    b.master.send();
    b.master.prepare(a_read, 1024, in.data(), 1024);
    b.master.send();
    BOOST_TEST(in == out, boost::test_tools::per_element());
    BOOST_TEST(b.bram.contents()[1024] == 1);
    BOOST_TEST(b.bram.writes == 3u);
    BOOST_TEST(b.bram.reads == 3u);
    BOOST_TEST(b.bram.beats == 4u + 512u);
  });
  BOOST_TEST(b.reports.count(sc_core::SC_WARNING) == 0u);
}

BOOST_AUTO_TEST_CASE(a_burst_takes_its_latency_and_a_clock_a_beat) {
  Bench b;
  b.master.simulate([&] {
    BOOST_TEST(b.burst(a_read, 0, 4) == 3 * period + period, "from 0 to the first edge, then 3");
    BOOST_TEST(b.burst(a_write, 0, 4) == 2 * period);
    BOOST_TEST(b.burst(a_read, 0, 64) == (3 + 15) * period);
    BOOST_TEST(b.burst(a_write, 0, 64) == (2 + 15) * period);
    BOOST_TEST(b.burst(a_read, 0, 1024) == (3 + 255) * period);
    BOOST_TEST(b.burst(a_read, 2, 4) == (3 + 1) * period, "two beats");
    sc_core::wait(1, sc_core::SC_NS);
    BOOST_TEST(b.burst(a_read, 0, 4) == 4 * period - 1000, "starts with an edge");
  });
}

BOOST_AUTO_TEST_CASE(latencies_are_parameters) {
  vp::Configuration configuration;
  configuration.set("bram.read_latency=5 cycles");
  configuration.set("bram.write_latency=7 cycles");
  const vp::Configuration::Scope scope(configuration);
  Bench b;
  b.master.simulate([&] {
    sc_core::wait(10, sc_core::SC_NS);
    BOOST_TEST(b.burst(a_read, 0, 4) == 5 * period);
    BOOST_TEST(b.burst(a_write, 0, 4) == 7 * period);
  });
}

namespace {

/// A second burst sent one clock after a first of 16 beats: when it ends, from the first's start.
std::uint64_t second_ends(bool single_port, tlm::tlm_command first, tlm::tlm_command second) {
  Bench b(with(false, single_port));
  std::uint64_t end = 0;
  sc_core::sc_spawn([&] {
    sc_core::wait(10, sc_core::SC_NS);
    b.burst(first, 0, 64);
  });
  b.master.set_script([&] {});
  // A payload of its own: the master's is in use.
  sc_core::sc_spawn([&] {
    sc_core::wait(20, sc_core::SC_NS);
    std::uint32_t word = 0;
    tlm::tlm_generic_payload payload;
    payload.set_command(second);
    payload.set_data_ptr(reinterpret_cast<unsigned char*>(&word));
    payload.set_data_length(4);
    payload.set_streaming_width(4);
    sc_core::sc_time delay;
    b.master.socket->b_transport(payload, delay);
    sc_core::wait(delay);
    end = kit::now_ps() - period;
  });
  sc_core::sc_start();
  return end;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_burst_waits_for_the_one_before) {
  BOOST_TEST(second_ends(false, a_read, a_read) == (18 + 3) * period);
  BOOST_TEST(second_ends(false, a_write, a_write) == (17 + 2) * period);
  BOOST_TEST(second_ends(false, a_read, a_write) == (1 + 2) * period, "two ports: side by side");
  BOOST_TEST(second_ends(true, a_read, a_write) == (18 + 2) * period, "one port: in turn");
}

BOOST_AUTO_TEST_CASE(byte_enables_and_fixed_bursts) {
  Bench b;
  b.master.simulate([&] {
    b.master.write(0, 0);
    std::uint32_t word = 0xAABB'CCDD;
    unsigned char enables[] = {0, 0, TLM_BYTE_ENABLED, 0};
    b.master.prepare(a_write, 0, &word, 4);
    b.master.payload.set_byte_enable_ptr(enables);
    b.master.payload.set_byte_enable_length(4);
    b.master.send();
    BOOST_TEST(b.master.read(0) == 0x00BB'0000u);
    std::uint32_t words[] = {1, 2, 3};
    b.master.prepare(a_write, 16, words, 12);
    b.master.payload.set_streaming_width(4);
    b.master.send();
    BOOST_TEST(b.master.read(16) == 3u, "the last one stays");
    BOOST_TEST(b.master.read(20) == 0u);
    b.master.prepare(a_write, 0, &word, 4);
    b.master.payload.set_byte_enable_ptr(enables);
    b.master.send();
    BOOST_TEST(b.master.response() == tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
  });
}

BOOST_AUTO_TEST_CASE(what_axi_does_not_allow) {
  Bench b;
  b.master.simulate([&] {
    BOOST_TEST(b.answer(8192, 4, 4) == tlm::TLM_ADDRESS_ERROR_RESPONSE);
    BOOST_TEST(b.answer(8188, 8, 8) == tlm::TLM_ADDRESS_ERROR_RESPONSE);
    BOOST_TEST(b.answer(0, 1024, 1024) == tlm::TLM_OK_RESPONSE, "256 beats");
    BOOST_TEST(b.answer(0, 1028, 1028) == tlm::TLM_BURST_ERROR_RESPONSE, "257 beats");
    BOOST_TEST(b.answer(4092, 4, 4) == tlm::TLM_OK_RESPONSE);
    BOOST_TEST(b.answer(4092, 8, 8) == tlm::TLM_BURST_ERROR_RESPONSE, "across 4 KiB");
    BOOST_TEST(b.answer(4092, 8, 4) == tlm::TLM_OK_RESPONSE, "a FIXED burst stays below");
    BOOST_TEST(b.answer(0, 4, 0) == tlm::TLM_BURST_ERROR_RESPONSE);
    std::uint32_t word = 0;
    b.master.access(tlm::TLM_IGNORE_COMMAND, 0, &word);
    BOOST_TEST(b.master.response() == tlm::TLM_COMMAND_ERROR_RESPONSE);
  });
}

BOOST_AUTO_TEST_CASE(axi4_lite_takes_single_words) {
  Bench b(with(true, false));
  b.master.simulate([&] {
    BOOST_TEST(b.answer(0, 4, 4) == tlm::TLM_OK_RESPONSE);
    BOOST_TEST(b.answer(0, 8, 8) == tlm::TLM_BURST_ERROR_RESPONSE);
  });
}

BOOST_AUTO_TEST_CASE(a_size_that_is_no_power_of_two_is_refused) {
  AxiBramCtrlBuild build;
  build.memory_size = 5000;
  BOOST_CHECK_THROW(Bench{build}, vp::InputError);
}

BOOST_AUTO_TEST_CASE(in_reset_or_without_clock_it_cannot_answer) {
  Bench b;
  b.master.simulate([&] {
    b.master.write(0, 77);
    b.aresetn = false;
    b.master.read(0);
    BOOST_TEST(b.master.response() == tlm::TLM_GENERIC_ERROR_RESPONSE);
    b.aresetn = true;
    BOOST_TEST(b.master.read(0) == 77u, "the memory has no reset");
    b.clock.set_frequency(0);
    b.master.read(0);
    BOOST_TEST(b.master.response() == tlm::TLM_GENERIC_ERROR_RESPONSE);
  });
  BOOST_TEST(b.reports.count("/markervp/axi_bram_ctrl/in_reset") == 2u);
}

BOOST_AUTO_TEST_CASE(debug_and_direct_access) {
  Bench b;
  b.master.simulate([&] {
    std::uint64_t word = 0x0102'0304'0506'0708;
    BOOST_TEST(b.master.debug(a_write, 8188, &word, 8) == 4u);
    BOOST_TEST(b.master.debug(a_read, 8192, &word, 8) == 0u);
    BOOST_TEST(b.bram.contents()[8188] == 8);
    tlm::tlm_dmi dmi;
    b.master.prepare(a_read, 0, &word, 4);
    BOOST_TEST(b.master.socket->get_direct_mem_ptr(b.master.payload, dmi));
    BOOST_TEST(dmi.get_end_address() == 8191u);
    BOOST_TEST(dmi.get_read_latency() == sc_core::sc_time(30, sc_core::SC_NS));
    BOOST_TEST(dmi.get_write_latency() == sc_core::sc_time(20, sc_core::SC_NS));
    bool taken_back = false;
    b.master.invalidated = [&](std::uint64_t, std::uint64_t) { taken_back = true; };
    b.aresetn = false;
    BOOST_TEST(taken_back, "a reset takes it back");
    b.master.prepare(a_read, 0, &word, 4);
    BOOST_TEST(!b.master.socket->get_direct_mem_ptr(b.master.payload, dmi));
    BOOST_TEST(kit::now_ps() == 0u);
  });
}

// The memory has 8 KiB: what lies behind answers DECERR.
BOOST_AUTO_TEST_CASE(a_central_dma_says_which_of_its_addresses_nothing_answers_at) {
  using namespace axi_cdma;
  for (const bool reads : {true, false}) {
    Bench b;
    xilinx::AxiCdma cdma("axi_cdma_0", b.clock);
    BusMaster software{"software"};
    xilinx::AxiBramCtrl memory("memory", b.clock, AxiBramCtrlBuild{});
    memory.s_axi_aresetn(b.aresetn);
    software.socket.bind(cdma.s_axi_lite.socket);
    cdma.m_axi.link.socket.bind(memory.s_axi);
    software.simulate([&] {
      software.write(SA, reads ? 0x2000 : 0x1FC0);
      software.write(DA, reads ? 0x40 : 0x1FC0 + 0x20);
      software.write(BTT, 0x40);
      BusMaster::wait_until(100 * period);
      BOOST_TEST(software.read(CDMASR) == (cdmasr::DMADecErr | cdmasr::Err_Irq | cdmasr::Idle));
    });
    const std::string said = b.text.str();
    BOOST_TEST(
        said.find(reads ? "the source, 0x00002000, is out of reach of M_AXI (DECERR)"
                        : "the destination, 0x00002000, is out of reach of M_AXI (DECERR)") !=
            std::string::npos,
        said);
  }
}

BOOST_AUTO_TEST_SUITE_END()
