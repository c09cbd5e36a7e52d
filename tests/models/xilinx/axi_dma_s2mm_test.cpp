#include <boost/test/unit_test.hpp>
#include <cstring>

#include "dma_bench.h"

using namespace axi_dma;
using kit::DmaBench;
using xilinx::AxiDmaBuild;

namespace {

// From the parameters' defaults.
constexpr std::uint64_t to_ready = 11;       // LENGTH to TREADY
constexpr std::uint64_t write_latency = 23;  // last beat of a burst to its address
constexpr std::uint64_t response = 20 + 5;   // last write data to the status register

struct S2mmBench : DmaBench {
  explicit S2mmBench(const AxiDmaBuild& build = {}) : DmaBench(build) {
    std::memset(memory.data(), 0xEE, memory_size);
  }
  void expect_words(std::uint32_t offset, unsigned count, std::uint32_t first = 0x1000) {
    for (unsigned i = 0; i < count; ++i) BOOST_TEST(memory.word(offset + 4 * i) == first + i);
    BOOST_TEST(memory.word(offset + 4 * count) == 0xEEEEEEEEu, "nothing beyond");
  }
  std::uint64_t wait_for(std::uint32_t bits) {
    return first_edge([this, bits] { return status(S2MM_DMASR, bits); });
  }
};

AxiDmaBuild with_dre() {
  AxiDmaBuild build;
  build.s2mm_dre = true;
  return build;
}

struct DreBench : S2mmBench {
  DreBench() : S2mmBench(with_dre()) {}
};

constexpr std::uint32_t failed_status =
    dmasr::DMAIntErr | dmasr::Err_Irq | dmasr::IOC_Irq | dmasr::Halted;

}  // namespace

BOOST_AUTO_TEST_SUITE(s2mm)

BOOST_FIXTURE_TEST_CASE(one_burst_at_exact_times, S2mmBench) {
  constexpr std::uint64_t k = 20;
  constexpr std::uint64_t last = k + to_ready + 32;  // edge on which the last beat passes
  constexpr std::uint64_t written = last + write_latency + 32;
  send_packet(32);
  software.simulate([&] {
    write(S2MM_DMACR, dmacr::RS | dmacr::IOC_IrqEn);
    write(S2MM_DA, memory_base + 0x80);
    at(k);
    write(S2MM_LENGTH, 128);
    at(k + to_ready - 1);
    scheduler.synchronise();
    BOOST_TEST(!s2mm_link.tready.get());
    at(k + to_ready);
    scheduler.synchronise();
    BOOST_TEST(s2mm_link.tready.get());
    BOOST_TEST(s2mm_link.beats == 0u);
    at(last);
    scheduler.synchronise();
    BOOST_TEST(s2mm_link.beats == 32u);
    BOOST_TEST(!s2mm_link.tready.get(), "not a beat of the next packet");
    at(written - 1);
    scheduler.synchronise();
    BOOST_TEST(memory.word(0x80) == 0xEEEEEEEEu);
    at(written);
    scheduler.synchronise();
    BOOST_TEST(memory.word(0x80) == 0x1000u);
    BOOST_TEST(read_at(written + response - 1, S2MM_DMASR) == 0u);
    BOOST_TEST(read_at(written + response, S2MM_DMASR) == (dmasr::Idle | dmasr::IOC_Irq));
    BOOST_TEST(!dma.s2mm_introut.get());
    at(written + response + 1);
    scheduler.synchronise();
    BOOST_TEST(dma.s2mm_introut.get());
    BOOST_TEST(!dma.mm2s_introut.get());
    BOOST_TEST(read(S2MM_LENGTH) == 128u);
  });
  expect_words(0x80, 32);
  BOOST_TEST(reports.count(sc_core::SC_WARNING) == 0u);
}

// The second burst is ready when the first one is written, and keeps the gap.
BOOST_FIXTURE_TEST_CASE(two_bursts_at_exact_times, S2mmBench) {
  constexpr std::uint64_t gap = 10;
  send_packet(64);
  software.simulate([&] {
    start_s2mm(memory_base, 256);
    BOOST_TEST(wait_for(dmasr::IOC_Irq) ==
               to_ready + 32 + write_latency + 32 + gap + 32 + response);
  });
  expect_words(0, 64);
}

AxiDmaBuild wide_memory() {
  AxiDmaBuild build;
  build.s2mm.memory_bytes = 8;
  return build;
}

struct WideBench : S2mmBench {
  WideBench() : S2mmBench(wide_memory()) {}
};

// Two words a clock: the first burst is written, and the gap is over, before the second is there.
BOOST_FIXTURE_TEST_CASE(bursts_to_memory_of_64_bits_at_exact_times, WideBench) {
  send_packet(64);
  software.simulate([&] {
    start_s2mm(memory_base, 256);
    BOOST_TEST(wait_for(dmasr::IOC_Irq) == to_ready + 64 + write_latency + 16 + response);
  });
  expect_words(0, 64);
}

// An odd word takes a clock of its own.
BOOST_FIXTURE_TEST_CASE(an_odd_word_to_memory_of_64_bits, WideBench) {
  send_packet(5);
  software.simulate([&] {
    start_s2mm(memory_base, 20);
    BOOST_TEST(wait_for(dmasr::IOC_Irq) == to_ready + 5 + write_latency + 3 + response);
  });
  expect_words(0, 5);
}

BOOST_FIXTURE_TEST_CASE(memory_of_64_bits_wants_addresses_of_8_bytes, WideBench) {
  send_packet(32);
  software.simulate([&] {
    start_s2mm(memory_base + 0x84, 128);
    wait_for(dmasr::IOC_Irq);
  });
  expect_words(0x80, 32);
  BOOST_TEST(reports.count(sc_core::SC_WARNING) == 1u);
}

BOOST_FIXTURE_TEST_CASE(throughput_of_10000_bytes, S2mmBench) {
  std::uint64_t done = 0;
  send_packet(2500);
  software.simulate([&] {
    start_s2mm(memory_base, 10'000);
    done = wait_for(dmasr::IOC_Irq);
    BOOST_TEST(read(S2MM_LENGTH) == 10'000u);
  });
  expect_words(0, 2500);
  const double seconds = static_cast<double>(done - to_ready) * 10e-9;  // from the first beat on
  const double megabytes_per_second = 10'000 / seconds / 1e6;
  BOOST_TEST(megabytes_per_second > 0.95 * 298.6);
  BOOST_TEST(megabytes_per_second < 1.05 * 298.6);
}

BOOST_FIXTURE_TEST_CASE(short_packet_sets_length, S2mmBench) {
  send_packet(3);
  send_packet(2, 0x2000);
  software.simulate([&] {
    start_s2mm(memory_base, 128);
    wait_for(dmasr::IOC_Irq);
    BOOST_TEST(read(S2MM_LENGTH) == 12u);
    BOOST_TEST(read(S2MM_DMASR) == (dmasr::Idle | dmasr::IOC_Irq));
    BOOST_TEST(s2mm_link.beats == 3u);
    at(clock.cycle() + 1);
    write(S2MM_DMASR, dmasr::IOC_Irq);
    write(S2MM_DA, memory_base + 0x100);
    write(S2MM_LENGTH, 128);
    wait_for(dmasr::IOC_Irq);
    BOOST_TEST(read(S2MM_LENGTH) == 8u);
  });
  expect_words(0, 3);
  expect_words(0x100, 2, 0x2000);
  BOOST_TEST(source.sent == 5u, "the second packet waited");
}

BOOST_FIXTURE_TEST_CASE(partial_last_beat, S2mmBench) {
  source.send(0x44332211, false);
  source.send(0x88776655, true, 0x3);
  software.simulate([&] {
    start_s2mm(memory_base, 6);
    wait_for(dmasr::IOC_Irq);
    BOOST_TEST(read(S2MM_DMASR) == (dmasr::Idle | dmasr::IOC_Irq));
    BOOST_TEST(read(S2MM_LENGTH) == 6u);
  });
  BOOST_TEST(memory.word(0) == 0x44332211u);
  BOOST_TEST(memory.word(4) == 0xEEEE6655u);
}

BOOST_FIXTURE_TEST_CASE(data_before_length_waits_and_is_not_lost, S2mmBench) {
  send_packet(32);
  software.simulate([&] {
    at(1000);
    BOOST_TEST(s2mm_link.beats == 0u);
    start_s2mm(memory_base, 128);
    wait_for(dmasr::IOC_Irq);
  });
  expect_words(0, 32);
  BOOST_TEST(s2mm_link.stalls >= 1000u);
}

BOOST_FIXTURE_TEST_CASE(slow_stream, S2mmBench) {
  software.simulate([&] {
    start_s2mm(memory_base, 128);
    for (unsigned i = 0; i < 32; ++i) {
      at(100 + 64 * i);
      source.send(0x1000 + i, i == 31);
    }
    const std::uint64_t done = wait_for(dmasr::IOC_Irq);
    // Offered on the edge after, passed on the next one.
    BOOST_TEST(done == 100u + 64 * 31 + 2 + write_latency + 32 + response);
  });
  expect_words(0, 32);
}

BOOST_FIXTURE_TEST_CASE(exact_length_without_tlast_is_an_overflow, S2mmBench) {
  for (unsigned i = 0; i < 40; ++i) source.send(0x1000 + i, false);
  software.simulate([&] {
    write(MM2S_DMACR, dmacr::RS);
    write(S2MM_DMACR, dmacr::RS | dmacr::Err_IrqEn);
    write(S2MM_DA, memory_base);
    write(S2MM_LENGTH, 128);
    const std::uint64_t failed = wait_for(dmasr::Err_Irq);
    BOOST_TEST(failed == to_ready + 32 + write_latency + 32 + response);
    BOOST_TEST(read(S2MM_DMASR) == (dmasr::DMAIntErr | dmasr::Err_Irq));
    BOOST_TEST((read(S2MM_DMACR) & dmacr::RS) == 0u);
    BOOST_TEST((read(MM2S_DMACR) & dmacr::RS) == 0u);
    at(failed + 5);
    BOOST_TEST(read(S2MM_DMASR) == failed_status);
    BOOST_TEST(read(MM2S_DMASR) == dmasr::Halted);
    BOOST_TEST(dma.s2mm_introut.get());
    BOOST_TEST(s2mm_link.beats == 32u);
  });
  expect_words(0, 32);
}

BOOST_FIXTURE_TEST_CASE(packet_longer_than_length_is_an_overflow, S2mmBench) {
  send_packet(10);
  software.simulate([&] {
    start_s2mm(memory_base, 18);
    at(wait_for(dmasr::Err_Irq) + 5);
    BOOST_TEST(read(S2MM_DMASR) == failed_status);
    BOOST_TEST(s2mm_link.beats == 5u);
    write(S2MM_DMACR, dmacr::Reset);
    at(clock.cycle() + 20);
    BOOST_TEST(read(S2MM_DMASR) == dmasr::Halted);
    write(S2MM_DMACR, dmacr::RS);
    write(S2MM_DA, memory_base + 0x100);
    write(S2MM_LENGTH, 64);
    wait_for(dmasr::IOC_Irq);
    BOOST_TEST(read(S2MM_LENGTH) == 20u, "the packet's rest");
  });
  BOOST_TEST(memory.word(12) == 0x1003u);
  BOOST_TEST(memory.word(16) == 0xEEEE1004u, "18 bytes");
  expect_words(0x100, 5, 0x1005);
}

BOOST_FIXTURE_TEST_CASE(last_beat_wider_than_length_is_an_overflow, S2mmBench) {
  send_packet(2);
  software.simulate([&] {
    start_s2mm(memory_base, 6);
    at(wait_for(dmasr::Err_Irq) + 5);
    BOOST_TEST(read(S2MM_DMASR) == failed_status);
  });
  BOOST_TEST(memory.word(4) == 0xEEEE1001u);
}

BOOST_FIXTURE_TEST_CASE(bursts_end_at_multiples_of_their_size, S2mmBench) {
  send_packet(64);
  software.simulate([&] {
    start_s2mm(memory_base + 0xFC0, 256);
    wait_for(dmasr::IOC_Irq);
  });
  using Bursts = std::vector<std::pair<std::uint64_t, std::uint64_t>>;
  const Bursts expected{{0x10000FC0, 64}, {0x10001000, 128}, {0x10001080, 64}};
  BOOST_TEST((s2mm_bursts.bursts == expected), "none crosses 4 KiB");
  expect_words(0xFC0, 64);
}

BOOST_FIXTURE_TEST_CASE(unaligned_address_with_realignment, DreBench) {
  source.send(0x44332211, false);
  source.send(0x88776655, true);
  software.simulate([&] {
    start_s2mm(memory_base + 0x7D, 64);
    wait_for(dmasr::IOC_Irq);
    BOOST_TEST(read(S2MM_LENGTH) == 8u);
  });
  const unsigned char expected[] = {0xEE, 0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88, 0xEE};
  BOOST_TEST(std::memcmp(memory.data() + 0x7C, expected, sizeof expected) == 0);
  BOOST_TEST(s2mm_bursts.bursts.size() == 2u, "a burst boundary lies inside");
}

// Eight bytes from the last one of a word on touch three words: so many beats are on the bus.
BOOST_FIXTURE_TEST_CASE(an_unaligned_burst_takes_a_beat_for_each_word_it_touches, DreBench) {
  xilinx::MemoryPath path;
  dma.share_memory_path(path);
  send_packet(2);
  software.simulate([&] {
    start_s2mm(memory_base + 3, 8);
    const std::uint64_t address = to_ready + 2 + write_latency;
    BOOST_TEST(wait_for(dmasr::IOC_Irq) == address + 3 + response);
    BOOST_TEST(path.write_free == address + 3);
  });
}

BOOST_FIXTURE_TEST_CASE(unaligned_address_without_realignment, S2mmBench) {
  send_packet(2);
  software.simulate([&] {
    start_s2mm(memory_base + 3, 64);
    wait_for(dmasr::IOC_Irq);
    BOOST_TEST(warnings("unaligned") == 1u);
  });
  expect_words(0, 2);
}

BOOST_FIXTURE_TEST_CASE(decode_and_slave_errors, S2mmBench) {
  software.simulate([&] {
    for (const auto& [address, error] :
         {std::pair{nothing_base, dmasr::DMADecErr}, std::pair{broken_base, dmasr::DMASlvErr}}) {
      send_packet(32);
      start_s2mm(address, 128);
      at(wait_for(dmasr::Err_Irq) + 5);
      BOOST_TEST(read(S2MM_DMASR) == (error | dmasr::Err_Irq | dmasr::IOC_Irq | dmasr::Halted));
      write(S2MM_DMACR, dmacr::Reset);
      at(clock.cycle() + 20);
      BOOST_TEST(read(S2MM_DMASR) == dmasr::Halted);
    }
  });
  BOOST_TEST(warnings("bus_error") == 2u);
  for (const char* part :
       {"S2MM transfer of 128 bytes at 0x30000000 leaves the memory that the DMA reaches "
        "(DECERR): ",
        "S2MM transfer of 128 bytes at 0x20000000 is refused by the memory (SLVERR): take DMA "
        "buffers from hal_dma_allocate and use their bus_address"}) {
    BOOST_TEST(text.str().find(part) != std::string::npos, text.str());
  }
}

BOOST_FIXTURE_TEST_CASE(length_is_not_queued, S2mmBench) {
  send_packet(32);
  send_packet(32);
  software.simulate([&] {
    start_s2mm(memory_base, 128);
    at(5);
    write(S2MM_LENGTH, 64);
    BOOST_TEST(warnings("length_while_busy") == 1u);
    BOOST_TEST(read(S2MM_LENGTH) == 64u);
    wait_for(dmasr::IOC_Irq);
    BOOST_TEST(read(S2MM_LENGTH) == 128u, "bytes received");
    at(clock.cycle() + 500);
    BOOST_TEST(s2mm_link.beats == 32u);
  });
}

BOOST_FIXTURE_TEST_CASE(clearing_run_lets_the_transfer_complete, S2mmBench) {
  send_packet(32);
  software.simulate([&] {
    start_s2mm(memory_base, 128);
    at(20);
    write(S2MM_DMACR, 0);
    const std::uint64_t done = wait_for(dmasr::IOC_Irq);
    BOOST_TEST(read(S2MM_DMASR) == dmasr::IOC_Irq);
    BOOST_TEST(read_at(done + 2, S2MM_DMASR) == (dmasr::IOC_Irq | dmasr::Halted));
    write(S2MM_LENGTH, 128);
    BOOST_TEST(warnings("length_while_halted") == 1u);
  });
  expect_words(0, 32);
}

BOOST_FIXTURE_TEST_CASE(soft_reset_in_the_middle_of_a_transfer, S2mmBench) {
  send_packet(64);
  software.simulate([&] {
    start_s2mm(memory_base, 256);
    // The first burst is on the bus from edge 11 + 32 + 23 on, for 32 clocks.
    at(80);
    write(S2MM_DMACR, dmacr::Reset);
    scheduler.synchronise();
    BOOST_TEST(!s2mm_link.tready.get());
    const std::uint64_t done = first_edge([&] { return !status(S2MM_DMACR, dmacr::Reset); });
    BOOST_TEST(done == to_ready + 32 + write_latency + 32 + 8, "the burst on the bus, then 8");
    BOOST_TEST(read(S2MM_DMASR) == dmasr::Halted);
    BOOST_TEST(memory.word(0) == 0x1000u);
    BOOST_TEST(memory.word(128) == 0xEEEEEEEEu, "what was in the FIFO is gone");
    at(done + 300);
    BOOST_TEST(read(S2MM_DMASR) == dmasr::Halted);
    source.drop();
  });
}

BOOST_FIXTURE_TEST_CASE(full_fifo_stalls_the_stream, S2mmBench) {
  xilinx::MemoryPath path;
  dma.share_memory_path(path);
  path.write_free = 2000;  // another master writes until then
  send_packet(1000);
  software.simulate([&] {
    start_s2mm(memory_base, 4000);
    at(1990);
    scheduler.synchronise();
    BOOST_TEST(s2mm_link.beats == 256u);
    BOOST_TEST(!s2mm_link.tready.get());
    BOOST_TEST(wait_for(dmasr::IOC_Irq) > 0u);
    BOOST_TEST(read(S2MM_LENGTH) == 4000u);
  });
  expect_words(0, 1000);
}

BOOST_FIXTURE_TEST_CASE(memory_without_direct_access_is_reached_by_transactions, S2mmBench) {
  memory.allow_dmi = false;
  memory.latency = sc_core::sc_time(1, sc_core::SC_US);
  send_packet(64);
  software.simulate([&] {
    start_s2mm(memory_base, 256);
    BOOST_TEST(wait_for(dmasr::IOC_Irq) > 200u);
  });
  expect_words(0, 64);
  BOOST_TEST(memory.transactions == 2u);
}

BOOST_FIXTURE_TEST_CASE(keyhole_writes_one_address, S2mmBench) {
  send_packet(8);
  software.simulate([&] {
    write(S2MM_DMACR, dmacr::RS | dmacr::Keyhole);
    write(S2MM_DA, memory_base + 0x40);
    write(S2MM_LENGTH, 64);
    wait_for(dmasr::IOC_Irq);
    BOOST_TEST(read(S2MM_LENGTH) == 32u);
  });
  BOOST_TEST(memory.word(0x40) == 0x1007u);
  BOOST_TEST(memory.word(0x44) == 0xEEEEEEEEu);
}

BOOST_FIXTURE_TEST_CASE(keyhole_writes_in_bursts_of_the_usual_size, S2mmBench) {
  send_packet(80);
  software.simulate([&] {
    write(S2MM_DMACR, dmacr::RS | dmacr::Keyhole);
    write(S2MM_DA, memory_base + 0x40);
    write(S2MM_LENGTH, 320);
    wait_for(dmasr::IOC_Irq);
  });
  using Bursts = std::vector<std::pair<std::uint64_t, std::uint64_t>>;
  const Bursts expected{{0x10000040, 128}, {0x10000040, 128}, {0x10000040, 64}};
  BOOST_TEST((s2mm_bursts.bursts == expected));
}

BOOST_FIXTURE_TEST_CASE(both_channels_at_once, S2mmBench) {
  send_packet(256, 0x5000);
  software.simulate([&] {
    start_s2mm(memory_base, 1024);
    start_mm2s(memory_base + 0x8000, 1024);
    wait_for(dmasr::IOC_Irq);
    BOOST_TEST(status(MM2S_DMASR, dmasr::IOC_Irq));
  });
  expect_words(0, 256, 0x5000);
  BOOST_TEST(sink.beats.size() == 256u);
}

BOOST_AUTO_TEST_SUITE_END()
