// A DMA whose output stream is its input stream. It takes the same words on the same edges as two
// cores in line: all registers of a core sample what stood before the edge, whatever drives them.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstring>
#include <memory>
#include <numeric>
#include <vector>

#include <axi_dma_registers.h>
#include <simulation.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/router.h>
#include <xilinx/axi_dma/axi_dma.h>
#include "bus_master.h"
#include "memory_target.h"

using namespace axi_dma;

namespace {

// From the parameters' defaults.
constexpr std::uint64_t first_beat = 11 + 6 + 20 + 1;  // LENGTH of MM2S to its first beat
constexpr std::uint64_t completion = 5;                // last beat to the status of MM2S
constexpr std::uint64_t write_latency = 23;            // last beat of a burst to its address
constexpr std::uint64_t response = 20 + 5;             // last write data to the status of S2MM

constexpr std::uint32_t memory_base = 0x10000000;
constexpr std::uint32_t memory_size = 0x10000;
constexpr std::uint32_t destination = memory_size / 2;
constexpr std::uint32_t sender_base = 0x40400000, receiver_base = 0x40410000;
constexpr unsigned char untouched = 0xEE;

xilinx::AxiDmaBuild build(bool mm2s, bool s2mm, std::uint32_t beat_bytes) {
  xilinx::AxiDmaBuild build;
  build.mm2s = build.s2mm = {beat_bytes, beat_bytes};
  build.include_mm2s = mm2s;
  build.include_s2mm = s2mm;
  return build;
}

/// Sees every edge, as a tracer does.
struct Watcher : vp::InstantObserver {
  void end_of_instant(std::uint64_t) override {}
};

struct How {
  bool one_core = true;  ///< else MM2S and S2MM belong to two
  bool batch = false;    ///< many edges in one activation
  bool watched = false;
  bool direct = true;  ///< the memory grants direct access
  std::uint32_t beat_bytes = 4;
};

/// When the bits of one transfer showed, in clock edges after LENGTH of MM2S was written; 0: never.
struct Times {
  std::uint64_t sent = 0, received = 0;                      ///< Idle and IOC_Irq
  std::uint64_t sent_interrupt = 0, received_interrupt = 0;  ///< the outputs
  bool operator==(const Times& other) const {
    return sent == other.sent && received == other.received &&
           sent_interrupt == other.sent_interrupt && received_interrupt == other.received_interrupt;
  }
};

std::ostream& operator<<(std::ostream& out, const Times& times) {
  return out << "sent " << times.sent << " (" << times.sent_interrupt << "), received "
             << times.received << " (" << times.received_interrupt << ")";
}

struct Loop : kit::Simulation {
  explicit Loop(How how = {})
      : sender("sender", clock, build(true, how.one_core, how.beat_bytes)),
        second(how.one_core ? nullptr
                            : std::make_unique<xilinx::AxiDma>("receiver", clock,
                                                               build(false, true, how.beat_bytes))),
        receiver(how.one_core ? sender : *second),
        s2mm_base(how.one_core ? sender_base : receiver_base) {
    software.socket.bind(axi.socket);
    axi.map("sender", sender_base, 0x10000).bind(sender.s_axi_lite.socket);
    if (second) axi.map("receiver", receiver_base, 0x10000).bind(second->s_axi_lite.socket);
    axi.map("memory", memory_base, memory_size).bind(memory.socket);
    sender.mm2s().m_axi.link.socket.bind(axi.socket);
    receiver.s2mm().m_axi.link.socket.bind(axi.socket);
    sender.mm2s().m_axis(loop);
    receiver.s2mm().s_axis(loop);
    scheduler.set_batch(how.batch);
    if (how.watched) scheduler.add_observer(watcher);
    memory.allow_dmi = how.direct;
    memory.latency = sc_core::sc_time(how.direct ? 0 : 333, sc_core::SC_NS);
    std::iota(memory.data(), memory.data() + destination, 1);
    std::memset(memory.data() + destination, untouched, destination);
  }

  void wait_for_edge(std::uint64_t cycle) {
    kit::BusMaster::wait_until(clock.time_of(cycle));
    scheduler.synchronise();
  }
  void write_mm2s(std::uint32_t offset, std::uint32_t word) {
    software.write(sender_base + offset, word);
  }
  void write_s2mm(std::uint32_t offset, std::uint32_t word) {
    software.write(s2mm_base + offset, word);
  }
  std::uint32_t mm2s_status() { return software.read(sender_base + MM2S_DMASR); }
  std::uint32_t s2mm_status() { return software.read(s2mm_base + S2MM_DMASR); }

  void run_channels() {
    write_s2mm(S2MM_DMACR, dmacr::RS | dmacr::IOC_IrqEn);
    write_mm2s(MM2S_DMACR, dmacr::RS | dmacr::IOC_IrqEn);
    wait_for_edge(clock.cycle() + 20);
  }
  void start(std::uint32_t bytes, std::uint32_t room) {
    write_s2mm(S2MM_DA, memory_base + destination);
    write_s2mm(S2MM_LENGTH, room);
    write_mm2s(MM2S_SA, memory_base);
    write_mm2s(MM2S_LENGTH, bytes);
  }
  /// Copies, looking at every edge until both directions are done or `limit` edges are over.
  Times copy(std::uint32_t bytes, std::uint64_t limit = 40'000) {
    start(bytes, bytes);
    const std::uint64_t begin = clock.cycle();
    Times times;
    const auto note = [&](std::uint64_t& when, bool shows) {
      if (shows && when == 0) when = clock.cycle() - begin;
    };
    constexpr std::uint32_t done = dmasr::Idle | dmasr::IOC_Irq;
    while (times.sent_interrupt == 0 || times.received_interrupt == 0) {
      if (clock.cycle() - begin == limit) break;
      wait_for_edge(clock.cycle() + 1);
      note(times.sent_interrupt, sender.mm2s_introut.get());
      note(times.received_interrupt, receiver.s2mm_introut.get());
      note(times.sent, mm2s_status() == done);
      note(times.received, s2mm_status() == done);
    }
    return times;
  }
  /// Takes the interrupts back; both outputs fall with the next edge, and Idle stays.
  void acknowledge() {
    write_mm2s(MM2S_DMASR, dmasr::IOC_Irq);
    write_s2mm(S2MM_DMASR, dmasr::IOC_Irq);
    wait_for_edge(clock.cycle() + 1);
    BOOST_TEST(!sender.mm2s_introut.get());
    BOOST_TEST(!receiver.s2mm_introut.get());
    BOOST_TEST(mm2s_status() == dmasr::Idle);
    BOOST_TEST(s2mm_status() == dmasr::Idle);
  }
  bool copied(std::uint32_t bytes) {
    const unsigned char* to = memory.data() + destination;
    return std::memcmp(memory.data(), to, bytes) == 0 && to[bytes] == untouched;
  }

  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  kit::BusMaster software{"software"};
  vp::Router axi{"axi"};
  kit::MemoryTarget memory{"memory", memory_size};
  vp::AxiStream loop{"loop"};
  xilinx::AxiDma sender;
  std::unique_ptr<xilinx::AxiDma> second;
  xilinx::AxiDma& receiver;
  const std::uint32_t s2mm_base;
  Watcher watcher;
};

/// The times of copies of these lengths, one after the other.
std::vector<Times> copies(const How& how, const std::vector<std::uint32_t>& lengths) {
  Loop bench(how);
  std::vector<Times> times;
  bench.software.simulate([&] {
    bench.run_channels();
    for (const std::uint32_t bytes : lengths) {
      std::memset(bench.memory.data() + destination, untouched, destination);
      times.push_back(bench.copy(bytes));
      if (times.back().sent_interrupt == 0) break;  // nor would it for the other lengths
      BOOST_TEST(bench.copied(bytes), bytes << " bytes");
      BOOST_TEST(bench.software.read(bench.s2mm_base + S2MM_LENGTH) == bytes);
      BOOST_TEST(!bench.loop.tvalid.get());
      BOOST_TEST(!bench.loop.tready.get());
      bench.acknowledge();
    }
  });
  BOOST_TEST(bench.loop.packets == lengths.size());
  return times;
}

/// All lengths up to more than a burst, those around multiples of a burst, of the FIFOs and of
/// 4 KiB, and the longest.
std::vector<std::uint32_t> lengths() {
  std::vector<std::uint32_t> result(140);
  std::iota(result.begin(), result.end(), 1);
  for (const std::uint32_t middle : {256, 512, 1024, 1152, 4096, 8192}) {
    for (const std::uint32_t bytes : {middle - 4, middle - 1, middle, middle + 1, middle + 4}) {
      result.push_back(bytes);
    }
  }
  result.push_back(10'000);
  result.push_back((1u << 14) - 1);
  return result;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(loopback)

BOOST_AUTO_TEST_CASE(every_length_up_to_a_burst_at_exact_times) {
  const std::vector<Times> times = copies({}, lengths());
  BOOST_TEST_REQUIRE(times.size() == lengths().size(), "MM2S never completes");
  for (std::uint32_t bytes = 1; bytes <= 128; ++bytes) {
    const std::uint64_t beats = (bytes + 3) / 4;
    const std::uint64_t last = first_beat + beats - 1;
    Times expected;
    expected.sent = last + completion;
    expected.received = last + write_latency + beats + response;
    expected.sent_interrupt = expected.sent + 1;
    expected.received_interrupt = expected.received + 1;
    BOOST_TEST(times[bytes - 1] == expected, bytes << " bytes");
  }
}

BOOST_AUTO_TEST_CASE(one_core_keeps_the_times_of_two) {
  for (const bool direct : {true, false}) {
    How how;
    how.direct = direct;
    how.one_core = false;
    const std::vector<Times> two = copies(how, lengths());
    how.one_core = true;
    BOOST_TEST(copies(how, lengths()) == two, boost::test_tools::per_element());
    how.batch = true;
    BOOST_TEST(copies(how, lengths()) == two, boost::test_tools::per_element());
    how.watched = true;
    BOOST_TEST(copies(how, lengths()) == two, boost::test_tools::per_element());
  }
}

// The port of the PS takes a beat of more than 8 bytes for several clocks, on either side.
BOOST_AUTO_TEST_CASE(wide_streams_at_exact_times) {
  for (const std::uint32_t width : {8, 16, 64, 128}) {
    How how;
    how.beat_bytes = width;
    const std::uint32_t clocks = std::max(width / 8, 1u), burst = std::min(32 * width, 4096u);
    const std::vector<std::uint32_t> lengths{1, width - 1, width, width + 1, 3 * width + 5, burst};
    const std::vector<Times> times = copies(how, lengths);
    BOOST_TEST_REQUIRE(times.size() == lengths.size(), "MM2S never completes");
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      const std::uint64_t beats = (lengths[i] + width - 1) / width;
      const std::uint64_t last = first_beat + beats * clocks - 1;
      Times expected;
      expected.sent = last + completion;
      expected.received = last + write_latency + beats * clocks + response;
      expected.sent_interrupt = expected.sent + 1;
      expected.received_interrupt = expected.received + 1;
      BOOST_TEST(times[i] == expected, width << " bytes wide, " << lengths[i] << " bytes");
    }
    const std::vector<std::uint32_t> longer{burst + 1, 10'000, (1u << 14) - 1};
    const std::vector<Times> one = copies(how, longer);
    how.one_core = false;
    how.watched = true;
    BOOST_TEST(copies(how, longer) == one, boost::test_tools::per_element());
  }
}

BOOST_FIXTURE_TEST_CASE(widths_that_no_core_has, kit::Simulation) {
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 100'000'000);
  for (const xilinx::DmaWidths widths : {xilinx::DmaWidths{8, 12}, {4, 8}, {256, 128}, {4, 2}}) {
    xilinx::AxiDmaBuild build;
    build.s2mm = widths;
    BOOST_CHECK_THROW(xilinx::AxiDma("dma", clock, build), vp::InputError);
  }
}

// TREADY is low until S2MM has a transfer: MM2S waits with its first beat, and ends when it may.
BOOST_FIXTURE_TEST_CASE(mm2s_waits_for_s2mm, Loop) {
  software.simulate([&] {
    run_channels();
    write_mm2s(MM2S_SA, memory_base);
    write_mm2s(MM2S_LENGTH, 64);
    wait_for_edge(clock.cycle() + 500);
    BOOST_TEST(mm2s_status() == 0u);
    BOOST_TEST(loop.tvalid.get());
    BOOST_TEST(loop.beats == 0u);
    write_s2mm(S2MM_DA, memory_base + destination);
    write_s2mm(S2MM_LENGTH, 64);
    const std::uint64_t last = clock.cycle() + 11 + 16;  // TREADY after 11, then a beat an edge
    wait_for_edge(last + completion - 1);
    BOOST_TEST(mm2s_status() == 0u);
    wait_for_edge(last + completion);
    BOOST_TEST(mm2s_status() == (dmasr::Idle | dmasr::IOC_Irq));
    wait_for_edge(last + write_latency + 16 + response);
    BOOST_TEST(s2mm_status() == (dmasr::Idle | dmasr::IOC_Irq));
  });
  BOOST_TEST(copied(64));
}

// The packet is longer than S2MM's LENGTH: the error of one channel halts the other.
BOOST_FIXTURE_TEST_CASE(a_packet_too_long_halts_both, Loop) {
  software.simulate([&] {
    run_channels();
    start(64, 32);
    wait_for_edge(clock.cycle() + 500);
    BOOST_TEST(s2mm_status() ==
               (dmasr::DMAIntErr | dmasr::Err_Irq | dmasr::IOC_Irq | dmasr::Halted));
    BOOST_TEST((mm2s_status() & (dmasr::Halted | dmasr::Idle)) == dmasr::Halted);
    write_s2mm(S2MM_DMACR, dmacr::Reset);
    wait_for_edge(clock.cycle() + 50);
    BOOST_TEST(mm2s_status() == dmasr::Halted);
    BOOST_TEST(s2mm_status() == dmasr::Halted);
    BOOST_TEST(!loop.tvalid.get());
    std::memset(memory.data() + destination, untouched, destination);
    run_channels();
    BOOST_TEST(copy(64).sent == first_beat + 15 + completion, "recovered");
  });
  BOOST_TEST(copied(64));
}

BOOST_FIXTURE_TEST_CASE(a_reset_in_the_middle_leaves_nothing_behind, Loop) {
  software.simulate([&] {
    run_channels();
    start(4096, 4096);
    wait_for_edge(clock.cycle() + 100);
    write_mm2s(MM2S_DMACR, dmacr::Reset);
    wait_for_edge(clock.cycle() + 200);
    BOOST_TEST(mm2s_status() == dmasr::Halted);
    BOOST_TEST(s2mm_status() == dmasr::Halted);
    BOOST_TEST(!loop.tvalid.get());
    BOOST_TEST(!loop.tready.get());
    std::memset(memory.data() + destination, untouched, destination);
    run_channels();
    BOOST_TEST(copy(128).sent == first_beat + 31 + completion);
  });
  BOOST_TEST(copied(128));
}

BOOST_AUTO_TEST_SUITE_END()
