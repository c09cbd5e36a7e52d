// Block memory: what its ports read and when, and that it is one with its BRAM controllers.
#include <simulation.h>
#include <vp/clock_scheduler.h>
#include <vp/report.h>
#include <xilinx/axi_bram_ctrl/axi_bram_ctrl.h>
#include <xilinx/blk_mem_gen/blk_mem_gen.h>
#include <boost/test/unit_test.hpp>

#include <cstdint>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "bus_master.h"
#include "input_error.h"

using xilinx::BlkMemGen;
using xilinx::BlkMemGenBuild;
using xilinx::BlkMemPortBuild;
using WriteMode = BlkMemPortBuild::WriteMode;

namespace {

/// A memory whose ports a test drives: 10 ns a clock, inputs change between edges.
struct MemoryBench : kit::Simulation {
  explicit MemoryBench(const BlkMemGenBuild& build) {
    reports.redirect(text);
    std::vector<vp::Clock*> clocks(std::max<std::size_t>(build.ports.size(), 1), &clock);
    memory = std::make_unique<BlkMemGen>("memory", clocks, build);
    for (std::size_t i = 0; i < build.ports.size(); ++i) {
      Pins& pin = *pins.emplace_back(std::make_unique<Pins>(i));
      BlkMemGen::Port& port = memory->port(i);
      if (build.ports[i].has_enable) port.en(pin.en);
      port.we(pin.we);
      port.addr(pin.addr);
      port.din(pin.din);
      port.rst(pin.rst);
    }
  }
  static void run_ns(unsigned ns) { sc_core::sc_start(sc_core::sc_time(ns, sc_core::SC_NS)); }
  std::uint64_t out(std::size_t port) { return memory->port(port).dout.get(); }
  void put(std::size_t port, std::uint64_t addr, std::uint64_t word, std::uint64_t we = 1) {
    pins[port]->addr = addr;
    pins[port]->din = word;
    pins[port]->we = we;
    pins[port]->en = true;
  }

  struct Pins : sc_core::sc_module {
    explicit Pins(std::size_t n) : sc_module(("pins_" + std::to_string(n)).c_str()) {}
    vp::Signal<bool> en{"en"}, rst{"rst"};
    vp::Signal<std::uint64_t> we{"we", 8}, addr{"addr", 32}, din{"din", 64};
  };
  std::ostringstream text;
  vp::ReportRouter reports;
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  std::vector<std::unique_ptr<Pins>> pins;
  std::unique_ptr<BlkMemGen> memory;
};

BlkMemGenBuild words(std::uint32_t width, unsigned ports = 1) {
  BlkMemGenBuild build;
  build.ports.assign(ports, {});
  for (BlkMemPortBuild& port : build.ports) {
    port.width = width;
    port.depth = 16;
  }
  build.word_bits = width;
  build.words = 16;
  return build;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(block_memory)

BOOST_AUTO_TEST_CASE(a_word_comes_a_clock_after_its_address) {
  for (const unsigned latency : {1u, 2u, 3u}) {
    BlkMemGenBuild build = words(32);
    build.contents = {5, 6, 7};
    build.ports[0].latency = latency;
    MemoryBench bench(build);
    bench.put(0, 2, 0, 0);
    bench.run_ns(10 * latency - 1);
    BOOST_TEST(bench.out(0) == 0u);
    bench.run_ns(2);
    BOOST_TEST(bench.out(0) == 7u);
    bench.pins[0]->en = false;
    bench.pins[0]->addr = 1;
    bench.run_ns(50);
    BOOST_TEST(bench.out(0) == 7u, "it is not enabled");
  }
}

BOOST_AUTO_TEST_CASE(what_a_write_reads_is_the_mode_of_the_port) {
  for (const auto& [mode, read] : {std::pair{WriteMode::write_first, 9u},
                                   {WriteMode::read_first, 6u},
                                   {WriteMode::no_change, 0u}}) {
    BlkMemGenBuild build = words(32);
    build.contents = {5, 6};
    build.ports[0].write_mode = mode;
    MemoryBench bench(build);
    bench.put(0, 1, 9);
    bench.run_ns(11);
    BOOST_TEST(bench.out(0) == read);
    bench.pins[0]->we = 0;
    bench.run_ns(10);
    BOOST_TEST(bench.out(0) == 9u);
    bench.pins[0]->rst = true;
    bench.run_ns(10);
    BOOST_TEST(bench.out(0) == 0u);
  }
}

BOOST_AUTO_TEST_CASE(bytes_are_written_alone) {
  BlkMemGenBuild build = words(32);
  build.contents = {0x11223344};
  build.ports[0].lane_bits = 8;
  build.ports[0].byte_addresses = true;
  MemoryBench bench(build);
  bench.put(0, 0, 0xAABBCCDD, 0b0101);
  bench.run_ns(11);
  BOOST_TEST(bench.out(0) == 0x11BB33DDu);
  bench.put(0, 16 * 4 + 3, 0, 0);
  bench.run_ns(10);
  BOOST_TEST(bench.out(0) == 0x11BB33DDu, "the addresses that it looks at begin again");
}

BOOST_AUTO_TEST_CASE(one_port_sees_what_the_other_wrote_in_other_widths) {
  BlkMemGenBuild build = words(32, 2);
  build.ports[1].width = 8;
  build.ports[1].depth = 64;
  build.ports[1].writes = false;
  MemoryBench bench(build);
  bench.put(1, 5, 0, 0);
  bench.run_ns(50);
  BOOST_TEST(bench.out(1) == 0u);
  bench.put(0, 1, 0x11223344);
  bench.run_ns(20);
  BOOST_TEST(bench.out(1) == 0x33u);
  BOOST_TEST(input_error([] {
               BlkMemGenBuild odd = words(12, 2);
               odd.ports[1].width = 8;
               MemoryBench refused(odd);
             }) == "memory: ports of different widths are modelled in whole bytes");
}

BOOST_AUTO_TEST_CASE(a_word_beyond_the_memory_is_lost) {
  MemoryBench bench(words(32));
  bench.put(0, 16, 3);
  bench.run_ns(30);
  BOOST_TEST(bench.text.str().find("a write to byte 0x00000040 of 64 is lost") != std::string::npos,
             bench.text.str());
  BOOST_TEST(bench.out(0) == 3u, "what it writes it shows");
  bench.pins[0]->we = 0;
  bench.run_ns(10);
  BOOST_TEST(bench.out(0) == 0u);
}

BOOST_AUTO_TEST_CASE(controllers_and_a_port_have_one_memory) {
  BlkMemGenBuild build = words(32);
  build.contents = {1, 2};
  build.words = 1024;
  build.ports[0].depth = 1024;
  MemoryBench bench(build);
  xilinx::AxiBramCtrlBuild small, large;
  small.memory_size = 2048;
  large.memory_size = 8192;
  xilinx::AxiBramCtrl first("first", bench.clock, small), second("second", bench.clock, large);
  bench.memory->share(first);
  bench.memory->share(second);
  kit::BusMaster at_first("at_first"), at_second("at_second");
  at_first.socket.bind(first.s_axi);
  at_second.socket.bind(second.s_axi);
  const auto read = [](kit::BusMaster& master, std::uint64_t address) {
    unsigned char byte = 0xFF;
    const bool is_there = master.debug(tlm::TLM_READ_COMMAND, address, &byte, 1) == 1;
    return is_there ? static_cast<int>(byte) : -1;
  };
  BOOST_TEST(read(at_first, 4) == 2, "what it was loaded with");
  BOOST_TEST(read(at_second, 4) == 2);
  BOOST_TEST(read(at_first, 2048) == -1, "software reaches the controller's segment");
  bench.put(0, 600, 0x77);
  bench.run_ns(11);
  BOOST_TEST(read(at_second, 2400) == 0x77);
  first.contents()[8] = 0x55;
  bench.put(0, 2, 0, 0);
  bench.run_ns(10);
  BOOST_TEST(bench.out(0) == 0x55u);
}

BOOST_AUTO_TEST_SUITE_END()
