#include <boost/test/unit_test.hpp>
#include <cstring>

#include "dma_bench.h"

using namespace axi_dma;
using kit::DmaBench;
using xilinx::AxiDmaBuild;

namespace {

// From the parameters' defaults: LENGTH written at edge k, first TVALID after edge k + first_data.
constexpr std::uint64_t first_data = 11 + 6 + 20;
constexpr std::uint64_t completion = 5;

struct Mm2sBench : DmaBench {
  explicit Mm2sBench(const AxiDmaBuild& build = {}) : DmaBench(build) {}
  std::uint32_t word(std::uint32_t offset) const { return memory.word(offset); }
  void expect_words(std::uint32_t offset, unsigned count) {
    BOOST_REQUIRE(sink.beats.size() == count);
    for (unsigned i = 0; i < count; ++i) {
      BOOST_TEST(sink.beats[i].data == word(offset + 4 * i));
      BOOST_TEST(sink.beats[i].last == (i + 1 == count));
      BOOST_TEST(sink.beats[i].keep == 0xF);
    }
  }
};

AxiDmaBuild with_dre() {
  AxiDmaBuild build;
  build.mm2s_dre = true;
  return build;
}

struct DreBench : Mm2sBench {
  DreBench() : Mm2sBench(with_dre()) {}
};

}  // namespace

BOOST_AUTO_TEST_SUITE(mm2s)

BOOST_FIXTURE_TEST_CASE(one_burst_at_exact_times, Mm2sBench) {
  constexpr std::uint64_t k = 20;
  constexpr std::uint64_t last = k + first_data + 32;  // edge on which the last beat passes
  software.simulate([&] {
    write(MM2S_DMACR, dmacr::RS | dmacr::IOC_IrqEn);
    write(MM2S_SA, memory_base + 0x80);
    at(k);
    write(MM2S_LENGTH, 128);
    BOOST_TEST(read_at(last + completion - 1, MM2S_DMASR) == 0u);
    BOOST_TEST(!dma.mm2s_introut.get());
    BOOST_TEST(read_at(last + completion, MM2S_DMASR) == (dmasr::Idle | dmasr::IOC_Irq));
    BOOST_TEST(!dma.mm2s_introut.get(), "a register behind the status");
    at(last + completion + 1);
    scheduler.synchronise();
    BOOST_TEST(dma.mm2s_introut.get());
    BOOST_TEST(!dma.s2mm_introut.get());
    BOOST_TEST(read(MM2S_LENGTH) == 128u, "keeps what was written");
    BOOST_TEST(read(S2MM_DMASR) == dmasr::Halted);
    write(MM2S_DMASR, dmasr::IOC_Irq);
    BOOST_TEST(read(MM2S_DMASR) == dmasr::Idle);
    at(last + completion + 2);
    scheduler.synchronise();
    BOOST_TEST(!dma.mm2s_introut.get());
  });
  expect_words(0x80, 32);
  for (unsigned i = 0; i < 32; ++i) BOOST_TEST(sink.beats[i].cycle == k + first_data + 1 + i);
  BOOST_TEST(mm2s_link.packets == 1u);
  BOOST_TEST(dma.mm2s().m_axi.link.bytes_read == 128u);
  BOOST_TEST(reports.count(sc_core::SC_WARNING) == 0u);
}

BOOST_FIXTURE_TEST_CASE(second_transfer_needs_length_only, Mm2sBench) {
  software.simulate([&] {
    start_mm2s(memory_base, 64);
    first_edge([&] { return status(MM2S_DMASR, dmasr::IOC_Irq); });
    write(MM2S_LENGTH, 64);
    BOOST_TEST((read(MM2S_DMASR) & dmasr::Idle) == 0u, "accepted");
    at(clock.cycle() + 200);
    BOOST_TEST((read(MM2S_DMASR) & dmasr::Idle) != 0u);
  });
  BOOST_TEST(sink.beats.size() == 32u);
  BOOST_TEST(mm2s_link.packets == 2u);
}

BOOST_FIXTURE_TEST_CASE(throughput_of_10000_bytes, Mm2sBench) {
  software.simulate([&] {
    start_mm2s(memory_base, 10'000);
    BOOST_TEST(first_edge([&] { return status(MM2S_DMASR, dmasr::IOC_Irq); }) > 0u);
  });
  expect_words(0, 2500);
  const double seconds =
      static_cast<double>(sink.beats.back().cycle - sink.beats.front().cycle + 1) * 10e-9;
  const double megabytes_per_second = 10'000 / seconds / 1e6;
  BOOST_TEST(megabytes_per_second > 0.95 * 399.0);
  BOOST_TEST(megabytes_per_second < 1.05 * 399.0);
}

BOOST_FIXTURE_TEST_CASE(bursts_end_at_multiples_of_their_size, Mm2sBench) {
  software.simulate([&] {
    start_mm2s(memory_base + 0xFC0, 256);
    first_edge([&] { return status(MM2S_DMASR, dmasr::IOC_Irq); });
  });
  using Bursts = std::vector<std::pair<std::uint64_t, std::uint64_t>>;
  const Bursts expected{{0x10000FC0, 64}, {0x10001000, 128}, {0x10001080, 64}};
  BOOST_TEST((mm2s_bursts.bursts == expected), "none crosses 4 KiB");
  expect_words(0xFC0, 64);
}

BOOST_FIXTURE_TEST_CASE(last_beat_is_partial, Mm2sBench) {
  software.simulate([&] {
    start_mm2s(memory_base, 7);
    first_edge([&] { return status(MM2S_DMASR, dmasr::IOC_Irq); });
  });
  BOOST_REQUIRE(sink.beats.size() == 2u);
  BOOST_TEST(sink.beats[0].keep == 0xF);
  BOOST_TEST(!sink.beats[0].last);
  BOOST_TEST(sink.beats[1].keep == 0x7);
  BOOST_TEST(sink.beats[1].last);
  BOOST_TEST(sink.beats[1].data == (word(4) & 0x00FFFFFFu));
}

BOOST_FIXTURE_TEST_CASE(unaligned_address_without_realignment, Mm2sBench) {
  software.simulate([&] {
    start_mm2s(memory_base + 0x102, 8);
    first_edge([&] { return status(MM2S_DMASR, dmasr::IOC_Irq); });
    BOOST_TEST(warnings("unaligned") == 1u);
  });
  expect_words(0x100, 2);
}

BOOST_FIXTURE_TEST_CASE(unaligned_address_with_realignment, DreBench) {
  software.simulate([&] {
    start_mm2s(memory_base + 0x7B, 140);
    first_edge([&] { return status(MM2S_DMASR, dmasr::IOC_Irq); });
    BOOST_TEST(warnings("unaligned") == 0u);
  });
  BOOST_REQUIRE(sink.beats.size() == 35u);
  for (unsigned i = 0; i < 35; ++i) {
    std::uint32_t expected = 0;
    std::memcpy(&expected, memory.data() + 0x7B + 4 * i, 4);
    BOOST_TEST(sink.beats[i].data == expected);
  }
}

// A beat needs the word in which its last byte lies: the first one waits for two of three words.
BOOST_FIXTURE_TEST_CASE(an_unaligned_burst_takes_a_beat_for_each_word_it_touches, DreBench) {
  xilinx::MemoryPath path;
  dma.share_memory_path(path);
  software.simulate([&] {
    start_mm2s(memory_base + 3, 8);
    first_edge([&] { return status(MM2S_DMASR, dmasr::IOC_Irq); });
  });
  BOOST_REQUIRE(sink.beats.size() == 2u);
  BOOST_TEST(sink.beats[0].cycle == first_data + 2);
  BOOST_TEST(sink.beats[1].cycle == first_data + 3);
  BOOST_TEST(path.read_free == first_data + 3);
}

BOOST_FIXTURE_TEST_CASE(back_pressure_loses_nothing, Mm2sBench) {
  sink.ready_on = [](std::uint64_t cycle) { return cycle % 5 == 0; };
  software.simulate([&] {
    start_mm2s(memory_base, 4096);
    BOOST_TEST(first_edge([&] { return status(MM2S_DMASR, dmasr::IOC_Irq); }) > 0u);
  });
  expect_words(0, 1024);
  for (unsigned i = 1; i < 1024; ++i) {
    BOOST_TEST(sink.beats[i].cycle == sink.beats[i - 1].cycle + 5);
  }
}

BOOST_FIXTURE_TEST_CASE(a_stalled_stream_waits_for_ever, Mm2sBench) {
  sink.ready_on = [](std::uint64_t cycle) { return cycle > 5000; };
  software.simulate([&] {
    start_mm2s(memory_base, 4096);
    at(4000);
    BOOST_TEST(read(MM2S_DMASR) == 0u);
    BOOST_TEST(dma.mm2s().m_axi.link.bytes_read == 8u * 128, "the FIFO's worth");
    at(7000);
    BOOST_TEST((read(MM2S_DMASR) & dmasr::IOC_Irq) != 0u);
  });
  expect_words(0, 1024);
  BOOST_TEST(sink.beats.front().cycle == 5002u);
}

BOOST_FIXTURE_TEST_CASE(length_written_while_halted_is_lost, Mm2sBench) {
  software.simulate([&] {
    write(MM2S_SA, memory_base);
    write(MM2S_LENGTH, 64);
    BOOST_TEST(warnings("length_while_halted") == 1u);
    BOOST_TEST(read(MM2S_LENGTH) == 64u, "stored");
    write(MM2S_DMACR, dmacr::RS);
    at(300);
    BOOST_TEST(read(MM2S_DMASR) == 0u, "setting RS later does not start it");
    BOOST_TEST(sink.beats.empty());
  });
}

BOOST_FIXTURE_TEST_CASE(length_written_right_after_run_starts, Mm2sBench) {
  software.simulate([&] {
    write(MM2S_SA, memory_base);
    at(10);
    write(MM2S_DMACR, dmacr::RS);
    BOOST_TEST(read(MM2S_DMASR) == dmasr::Halted);
    write(MM2S_LENGTH, 4);
    at(100);
    BOOST_TEST(read(MM2S_DMASR) == (dmasr::Idle | dmasr::IOC_Irq));
  });
  expect_words(0, 1);
}

BOOST_FIXTURE_TEST_CASE(length_written_while_busy_is_lost, Mm2sBench) {
  software.simulate([&] {
    start_mm2s(memory_base, 64);
    at(30);
    write(MM2S_LENGTH, 128);
    BOOST_TEST(warnings("length_while_busy") == 1u);
    BOOST_TEST(read(MM2S_LENGTH) == 128u, "stored");
    at(300);
    BOOST_TEST(read(MM2S_DMASR) == (dmasr::Idle | dmasr::IOC_Irq));
  });
  expect_words(0, 16);
}

BOOST_FIXTURE_TEST_CASE(length_0_never_starts, Mm2sBench) {
  software.simulate([&] {
    start_mm2s(memory_base, 0);
    BOOST_TEST(warnings("length_zero") == 1u);
    at(300);
    BOOST_TEST(read(MM2S_DMASR) == 0u);
    write(MM2S_LENGTH, 0x4000);
    at(600);
    BOOST_TEST(read(MM2S_DMASR) == 0u, "no bit of it fits into 14");
    BOOST_TEST(warnings("length_too_wide") == 1u);
  });
}

BOOST_FIXTURE_TEST_CASE(address_is_sampled_two_clocks_after_length, Mm2sBench) {
  software.simulate([&] {
    start_mm2s(memory_base, 4);
    at(1);
    write(MM2S_SA, memory_base + 0x10);
    at(2);
    write(MM2S_SA, memory_base + 0x20);
    at(200);
  });
  expect_words(0x10, 1);
}

BOOST_FIXTURE_TEST_CASE(clearing_run_lets_the_transfer_complete, Mm2sBench) {
  software.simulate([&] {
    start_mm2s(memory_base, 64);
    at(30);
    write(MM2S_DMACR, dmacr::IOC_IrqEn);
    BOOST_TEST(read_at(40, MM2S_DMASR) == 0u, "not halted yet");
    const std::uint64_t done = first_edge([&] { return status(MM2S_DMASR, dmasr::IOC_Irq); });
    BOOST_TEST(read(MM2S_DMASR) == dmasr::IOC_Irq, "not Idle: RS is 0");
    BOOST_TEST(read_at(done + 1, MM2S_DMASR) == dmasr::IOC_Irq);
    BOOST_TEST(read_at(done + 2, MM2S_DMASR) == (dmasr::IOC_Irq | dmasr::Halted));
    BOOST_TEST(dma.mm2s_introut.get());
  });
  expect_words(0, 16);
}

BOOST_FIXTURE_TEST_CASE(set_wins_over_a_simultaneous_clear, Mm2sBench) {
  constexpr std::uint64_t done = first_data + 1 + completion;
  software.simulate([&] {
    start_mm2s(memory_base, 4);
    at(done);
    write(MM2S_DMASR, dmasr::IOC_Irq);
    BOOST_TEST(read(MM2S_DMASR) == (dmasr::Idle | dmasr::IOC_Irq));
    at(done + 1);
    write(MM2S_DMASR, dmasr::IOC_Irq);
    BOOST_TEST(read(MM2S_DMASR) == dmasr::Idle);
  });
}

BOOST_FIXTURE_TEST_CASE(enabling_a_pending_interrupt_fires, Mm2sBench) {
  software.simulate([&] {
    start_mm2s(memory_base, 4);
    at(200);
    BOOST_TEST(!dma.mm2s_introut.get(), "not enabled");
    write(MM2S_DMACR, dmacr::RS | dmacr::Err_IrqEn | dmacr::Dly_IrqEn);
    at(210);
    BOOST_TEST(!dma.mm2s_introut.get(), "the other enables do not matter");
    write(MM2S_DMACR, dmacr::RS | dmacr::IOC_IrqEn);
    at(211);
    scheduler.synchronise();
    BOOST_TEST(dma.mm2s_introut.get());
    write(MM2S_DMACR, dmacr::RS);
    at(212);
    scheduler.synchronise();
    BOOST_TEST(!dma.mm2s_introut.get());
    BOOST_TEST((read(MM2S_DMASR) & dmasr::IOC_Irq) != 0u);
  });
}

BOOST_FIXTURE_TEST_CASE(decode_error_stops_both_channels, Mm2sBench) {
  software.simulate([&] {
    write(S2MM_DMACR, dmacr::RS);
    write(MM2S_DMACR, dmacr::RS | dmacr::Err_IrqEn);
    write(MM2S_SA, nothing_base);
    write(MM2S_LENGTH, 64);
    const std::uint64_t failed = first_edge([&] { return status(MM2S_DMASR, dmasr::Err_Irq); });
    BOOST_TEST(failed == first_data + completion);
    BOOST_TEST(read(MM2S_DMASR) == (dmasr::DMADecErr | dmasr::Err_Irq));
    BOOST_TEST((read(MM2S_DMACR) & dmacr::RS) == 0u);
    BOOST_TEST((read(S2MM_DMACR) & dmacr::RS) == 0u, "both");
    at(first_data + 16 + 2);  // the burst of 16 beats is over
    BOOST_TEST(read(MM2S_DMASR) ==
               (dmasr::DMADecErr | dmasr::Err_Irq | dmasr::IOC_Irq | dmasr::Halted));
    BOOST_TEST(read(S2MM_DMASR) == dmasr::Halted);
    BOOST_TEST(dma.mm2s_introut.get());
    BOOST_TEST(!dma.s2mm_introut.get());

    at(first_data + 16 + 3);
    write(MM2S_DMASR, 0xFFFFFFFF);
    BOOST_TEST(read(MM2S_DMASR) == (dmasr::DMADecErr | dmasr::Halted), "sticky until reset");
    write(MM2S_DMACR, dmacr::RS);
    BOOST_TEST((read(MM2S_DMACR) & dmacr::RS) == 0u, "no run before a reset");
    write(MM2S_LENGTH, 64);
    at(failed + 300);
    BOOST_TEST(sink.beats.empty());

    write(MM2S_DMACR, dmacr::Reset);
    at(failed + 320);
    BOOST_TEST(read(MM2S_DMASR) == dmasr::Halted);
    start_mm2s(memory_base, 64);
    at(failed + 500);
    BOOST_TEST(read(MM2S_DMASR) == (dmasr::Idle | dmasr::IOC_Irq), "recovered");
  });
  expect_words(0, 16);
  BOOST_TEST(router.decode_errors == 1u);
}

BOOST_FIXTURE_TEST_CASE(slave_error_in_a_later_burst, Mm2sBench) {
  software.simulate([&] {
    start_mm2s(memory_base + memory_size - 128, 256);
    first_edge([&] { return status(MM2S_DMASR, dmasr::Err_Irq); });
    at(clock.cycle() + 40);
    BOOST_TEST(read(MM2S_DMASR) ==
               (dmasr::DMASlvErr | dmasr::Err_Irq | dmasr::IOC_Irq | dmasr::Halted));
  });
  BOOST_TEST(sink.beats.size() == 32u, "what came before the error");
  BOOST_TEST(mm2s_link.packets == 0u);
}

BOOST_FIXTURE_TEST_CASE(soft_reset_in_the_middle_of_a_transfer, Mm2sBench) {
  software.simulate([&] {
    start_mm2s(memory_base, 4096);
    at(100);
    write(MM2S_DMACR, dmacr::Reset);
    const std::uint64_t done = first_edge([&] { return !status(MM2S_DMACR, dmacr::Reset); });
    BOOST_TEST(done > 108u);
    BOOST_TEST(done < 100u + 500 * 5, "the driver polls 500 times");
    BOOST_TEST(read(MM2S_DMASR) == dmasr::Halted);
    const std::size_t before = sink.beats.size();
    BOOST_TEST(before < 100u);
    at(done + 1000);
    BOOST_TEST(sink.beats.size() == before, "nothing of it comes later");
    sink.beats.clear();
    start_mm2s(memory_base + 0x200, 64);
    at(done + 1200);
    BOOST_TEST((read(MM2S_DMASR) & dmasr::IOC_Irq) != 0u);
  });
  expect_words(0x200, 16);
}

BOOST_FIXTURE_TEST_CASE(memory_without_direct_access_is_reached_by_transactions, Mm2sBench) {
  memory.allow_dmi = false;
  memory.latency = sc_core::sc_time(1, sc_core::SC_US);
  xilinx::MemoryPath path;
  dma.share_memory_path(path);
  software.simulate([&] {
    start_mm2s(memory_base, 256);
    at(11 + 100 + 1);
    scheduler.synchronise();
    BOOST_TEST(path.read_free == 11u + 100 + 1 + 32, "from when the data was there");
    BOOST_TEST(first_edge([&] { return status(MM2S_DMASR, dmasr::IOC_Irq); }) > 0u);
  });
  expect_words(0, 64);
  BOOST_TEST(memory.transactions == 2u);
  // Requested on edge 11, there 1 us = 100 clocks later, offered on the next edge, passed on the
  // one after.
  BOOST_TEST(sink.beats[0].cycle == 11u + 100 + 1 + 1);
  BOOST_TEST(mm2s_bursts.bursts.empty());
  BOOST_TEST(dma.mm2s().m_axi.link.reads == 2u);
}

// Four bursts are requested on four edges; the fifth when the data of the first arrives.
BOOST_FIXTURE_TEST_CASE(four_bursts_are_requested_ahead, Mm2sBench) {
  const auto requested = [&](std::uint64_t edge) {
    at(edge);
    scheduler.synchronise();
    return mm2s_bursts.bursts.size();
  };
  software.simulate([&] {
    start_mm2s(memory_base, 1024);
    for (std::uint64_t n = 0; n < 4; ++n) BOOST_TEST(requested(11 + n) == n + 1);
    BOOST_TEST(requested(first_data - 1) == 4u);
    BOOST_TEST(requested(first_data) == 5u);
  });
}

BOOST_FIXTURE_TEST_CASE(a_soft_reset_waits_for_the_burst_on_the_bus, Mm2sBench) {
  software.simulate([&] {
    start_mm2s(memory_base, 128);
    at(first_data + 3);
    write(MM2S_DMACR, dmacr::Reset);
    BOOST_TEST(first_edge([&] { return !status(MM2S_DMACR, dmacr::Reset); }) ==
               first_data + 32 + 8);
  });
}

BOOST_FIXTURE_TEST_CASE(keyhole_reads_every_burst_from_one_address, Mm2sBench) {
  software.simulate([&] {
    write(MM2S_DMACR, dmacr::RS | dmacr::Keyhole);
    write(MM2S_SA, memory_base + 0x40);
    write(MM2S_LENGTH, 192);
    at(300);
  });
  BOOST_REQUIRE(mm2s_bursts.bursts.size() > 1u);
  for (const auto& burst : mm2s_bursts.bursts) BOOST_TEST(burst.first == memory_base + 0x40);
}

BOOST_FIXTURE_TEST_CASE(keyhole_reads_one_address, Mm2sBench) {
  software.simulate([&] {
    write(MM2S_DMACR, dmacr::RS | dmacr::Keyhole);
    write(MM2S_SA, memory_base + 0x40);
    write(MM2S_LENGTH, 32);
    at(200);
  });
  BOOST_REQUIRE(sink.beats.size() == 8u);
  for (const auto& beat : sink.beats) BOOST_TEST(beat.data == word(0x40));
}

BOOST_FIXTURE_TEST_CASE(asleep_without_a_transfer, Mm2sBench) {
  sink.sleep_until = 100'000;
  software.simulate([&] {
    at(50'000);
    scheduler.synchronise();
    BOOST_TEST(clock.edges_run() < 10u);
  });
}

BOOST_AUTO_TEST_CASE(running_many_edges_at_once_changes_nothing) {
  std::vector<std::uint64_t> edges[2];
  for (const bool batch : {false, true}) {
    for (const bool direct : {false, true}) {
      Mm2sBench bench;
      bench.scheduler.set_batch(batch);
      bench.memory.allow_dmi = direct;
      bench.memory.latency = sc_core::sc_time(333, sc_core::SC_NS);
      bench.sink.ready_on = [](std::uint64_t cycle) { return cycle % 3 != 0; };
      bench.software.simulate([&] {
        bench.start_mm2s(DmaBench::memory_base, 1000);
        bench.at(3000);
        edges[batch].push_back(bench.read(MM2S_DMASR));
      });
      for (const auto& beat : bench.sink.beats) edges[batch].push_back(beat.cycle);
    }
  }
  BOOST_TEST(edges[0].size() == 502u);
  BOOST_TEST(edges[0] == edges[1], boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(masters_on_one_path_share_it) {
  DmaBench bench;
  xilinx::MemoryPath path;
  bench.dma.share_memory_path(path);
  path.read_free = 1000;  // another master reads until then
  bench.software.simulate([&] {
    bench.start_mm2s(DmaBench::memory_base, 64);
    bench.at(1100);
  });
  BOOST_REQUIRE(bench.sink.beats.size() == 16u);
  BOOST_TEST(bench.sink.beats[0].cycle == 1001u);
  BOOST_TEST(path.read_free == 1016u);
}

BOOST_AUTO_TEST_SUITE_END()
