// The DMA with scatter-gather: descriptors in memory, read ahead up to the tail, their statuses
// written back.
#include <boost/test/unit_test.hpp>
#include <random>

#include "sg_bench.h"

using namespace kit;

namespace {

// From the parameters' defaults. TAILDESC written at edge k; the descriptor's first word comes on
// edge k + 10 + 20, its data may move 28 later, the next descriptor is read behind its eight words.
constexpr std::uint64_t first_word = 10 + 20;
constexpr std::uint64_t begins = first_word + 28;
constexpr std::uint64_t read_data = 6 + 20;
constexpr std::uint64_t completion = 5;
constexpr std::uint64_t update = 1 + 20;  // the status on the bus, and the response

}  // namespace

BOOST_AUTO_TEST_SUITE(scatter_gather)

BOOST_FIXTURE_TEST_CASE(registers_of_the_other_mode_are_absent, SgBench) {
  software.simulate([&] {
    for (const std::uint32_t status : {MM2S_DMASR, S2MM_DMASR}) {
      BOOST_TEST(read(status) == 0x00010009u);
    }
    for (const std::uint32_t offset :
         {MM2S_SA, MM2S_LENGTH, S2MM_DA, S2MM_LENGTH, MM2S_CURDESC_MSB, S2MM_TAILDESC_MSB}) {
      write(offset, 0xFFFFFFFF);
      BOOST_TEST(read(offset) == 0u);
    }
    for (const std::uint32_t offset : {MM2S_CURDESC, MM2S_TAILDESC, S2MM_CURDESC, S2MM_TAILDESC}) {
      write(offset, 0xFFFFFFC0);
      BOOST_TEST(read(offset) == 0xFFFFFFC0u);
    }
    write(MM2S_DMACR, dmacr::Reset);
    at(clock.cycle() + 30);
    BOOST_TEST(read(MM2S_CURDESC) == 0u);
    BOOST_TEST(read(S2MM_DMASR) == 0x00010009u);
  });
}

BOOST_FIXTURE_TEST_CASE(one_descriptor_to_the_stream_at_exact_times, SgBench) {
  constexpr std::uint64_t k = 40;
  constexpr std::uint64_t last = k + begins + read_data + 32;  // edge on which the last beat passes
  constexpr std::uint64_t shows = last + completion + update;
  describe(ring, ring, memory_base + 0x80, 128 | sof | eof);
  software.simulate([&] {
    run(mm2s_registers, ring);
    BOOST_TEST(bits(MM2S_DMASR, not_counts) == dmasr::SGIncld, "runs, and is not idle yet");
    at(k);
    write(MM2S_TAILDESC, ring);
    settle_at(last + completion - 1);
    BOOST_TEST(status_of(ring) == 0u);
    settle_at(last + completion);
    BOOST_TEST(status_of(ring) == (descriptor::Cmplt | 128u));
    BOOST_TEST(bits(MM2S_DMASR, not_counts) == dmasr::SGIncld);
    settle_at(shows - 1);
    BOOST_TEST(bits(MM2S_DMASR, not_counts) == dmasr::SGIncld);
    settle_at(shows);
    BOOST_TEST(bits(MM2S_DMASR, not_counts) == (dmasr::SGIncld | dmasr::Idle | dmasr::IOC_Irq));
    BOOST_TEST(!dma.mm2s_introut.get());
    settle_at(shows + 1);
    BOOST_TEST(dma.mm2s_introut.get());
    BOOST_TEST(read(MM2S_CURDESC) == ring);
  });
  BOOST_REQUIRE(sink.beats.size() == 32u);
  for (unsigned i = 0; i < 32; ++i) {
    BOOST_TEST(sink.beats[i].cycle == k + begins + read_data + 1 + i);
    BOOST_TEST(sink.beats[i].data == memory.word(0x80 + 4 * i));
    BOOST_TEST(sink.beats[i].last == (i == 31));
  }
  using Bursts = std::vector<std::pair<std::uint64_t, std::uint64_t>>;
  const Bursts expected{{ring, 32}, {ring + 0x1C, 4}};
  BOOST_TEST((sg_bursts.bursts == expected));
  BOOST_TEST(reports.count(sc_core::SC_WARNING) == 0u);
}

BOOST_FIXTURE_TEST_CASE(one_descriptor_from_the_stream_at_exact_times, SgBench) {
  constexpr std::uint64_t k = 40, write_latency = 23, response = 20;
  constexpr std::uint64_t last = k + begins + 16;  // TREADY is high from k + begins on
  constexpr std::uint64_t moved = last + write_latency + 16 + response + completion;
  describe(ring, ring, memory_base + 0x8000, 256);
  software.simulate([&] {
    run(s2mm_registers, ring);
    send_packet(16);
    at(k);
    write(S2MM_TAILDESC, ring);
    settle_at(k + begins - 1);
    BOOST_TEST(!s2mm_link.tready.get());
    settle_at(k + begins);
    BOOST_TEST(s2mm_link.tready.get());
    settle_at(moved - 1);
    BOOST_TEST(status_of(ring) == 0u);
    settle_at(moved);
    BOOST_TEST(status_of(ring) == (descriptor::Cmplt | sof | eof | 64u), "what came, not the room");
    BOOST_TEST(get(memory_base + 0x8000 + 60) == 0x100Fu);
    settle_at(moved + update - 1);
    BOOST_TEST(bits(S2MM_DMASR, dmasr::Idle | dmasr::IOC_Irq) == 0u);
    settle_at(moved + update);
    BOOST_TEST(bits(S2MM_DMASR, not_counts) == (dmasr::SGIncld | dmasr::Idle | dmasr::IOC_Irq));
  });
}

// Descriptors are read ahead, so a packet of several leaves without a pause.
BOOST_FIXTURE_TEST_CASE(a_packet_of_several_descriptors_to_the_stream, SgBench) {
  describe_ring(ring, 4, memory_base, 256, 0);
  put(ring + descriptor::CONTROL, 256 | sof);
  put(nth(ring, 3) + descriptor::CONTROL, 256 | eof);
  software.simulate([&] {
    run(mm2s_registers, ring);
    write(MM2S_TAILDESC, nth(ring, 3));
    BOOST_TEST(wait_for(mm2s_registers, dmasr::IOC_Irq) > 0u);
    BOOST_TEST(status(MM2S_DMASR, dmasr::Idle), "one interrupt, with the last of them");
  });
  BOOST_REQUIRE(sink.beats.size() == 256u);
  for (unsigned i = 0; i < 256; ++i) {
    BOOST_TEST(sink.beats[i].data == memory.word(4 * i));
    BOOST_TEST(sink.beats[i].last == (i == 255));
    BOOST_TEST(sink.beats[i].cycle == sink.beats[0].cycle + i);
  }
  for (unsigned i = 0; i < 4; ++i) {
    BOOST_TEST(status_of(nth(ring, i)) == (descriptor::Cmplt | 256u));
  }
  BOOST_TEST(mm2s_link.packets == 1u);
}

BOOST_FIXTURE_TEST_CASE(a_packet_over_several_descriptors_from_the_stream, SgBench) {
  describe_ring(ring, 4, memory_base + 0x8000, 64, 0);
  software.simulate([&] {
    run(s2mm_registers, ring);
    write(S2MM_TAILDESC, nth(ring, 3));
    send_packet(40);
    send_packet(3, 0x2000);
    BOOST_TEST(wait_for(s2mm_registers, dmasr::IOC_Irq) > 0u);
    at(clock.cycle() + 200);
    BOOST_TEST(bits(S2MM_DMASR, dmasr::Idle) == dmasr::Idle);
  });
  BOOST_TEST(status_of(nth(ring, 0)) == (descriptor::Cmplt | sof | 64u));
  BOOST_TEST(status_of(nth(ring, 1)) == (descriptor::Cmplt | 64u));
  BOOST_TEST(status_of(nth(ring, 2)) == (descriptor::Cmplt | eof | 32u));
  BOOST_TEST(status_of(nth(ring, 3)) == (descriptor::Cmplt | sof | eof | 12u));
  for (unsigned i = 0; i < 40; ++i) {
    BOOST_TEST(get(memory_base + 0x8000 + 4 * i) == 0x1000u + i);
  }
  BOOST_TEST(get(memory_base + 0x80C0) == 0x2000u);
  BOOST_TEST(reports.count(sc_core::SC_WARNING) == 0u);
}

BOOST_FIXTURE_TEST_CASE(it_pauses_at_the_tail_and_goes_on_from_there, SgBench) {
  describe_ring(ring, 4, memory_base, 64, sof | eof);
  software.simulate([&] {
    run(mm2s_registers, ring);
    write(MM2S_TAILDESC, nth(ring, 1));
    wait_for(mm2s_registers, dmasr::Idle);
    at(clock.cycle() + 300);
    scheduler.synchronise();
    BOOST_TEST(sink.beats.size() == 32u);
    BOOST_TEST(read(MM2S_CURDESC) == nth(ring, 1));
    BOOST_TEST(status_of(nth(ring, 2)) == 0u);
    write(MM2S_TAILDESC, nth(ring, 2));
    BOOST_TEST(bits(MM2S_DMASR, dmasr::Idle) == 0u);
    at(clock.cycle() + 20);
    write(MM2S_TAILDESC, nth(ring, 3));  // the tail moves while it works
    wait_for(mm2s_registers, dmasr::Idle);
    BOOST_TEST(sink.beats.size() == 64u);
    BOOST_TEST(status_of(nth(ring, 3)) == (descriptor::Cmplt | 64u));
  });
  BOOST_TEST(reports.count(sc_core::SC_WARNING) == 0u);
}

BOOST_FIXTURE_TEST_CASE(an_interrupt_for_every_third_packet, SgBench) {
  describe_ring(ring, 8, memory_base, 64, sof | eof);
  constexpr std::uint32_t three = dmacr::RS | dmacr::IOC_IrqEn | 3u << dmacr::IRQThreshold_shift;
  const auto left = [&] {
    return bits(MM2S_DMASR, dmasr::IRQThresholdSts) >> dmasr::IRQThresholdSts_shift;
  };
  software.simulate([&] {
    write(MM2S_CURDESC, ring);
    write(MM2S_DMACR, three);
    BOOST_TEST(left() == 3u);
    write(MM2S_TAILDESC, nth(ring, 1));
    wait_for(mm2s_registers, dmasr::Idle);
    BOOST_TEST(left() == 1u);
    BOOST_TEST(!status(MM2S_DMASR, dmasr::IOC_Irq));
    write(MM2S_DMACR, three);  // the same threshold: the count continues
    BOOST_TEST(left() == 1u);
    write(MM2S_TAILDESC, nth(ring, 2));
    wait_for(mm2s_registers, dmasr::Idle);
    BOOST_TEST(status(MM2S_DMASR, dmasr::IOC_Irq));
    BOOST_TEST(left() == 3u);
    write(MM2S_DMASR, dmasr::IOC_Irq);
    write(MM2S_TAILDESC, nth(ring, 3));
    wait_for(mm2s_registers, dmasr::Idle);
    BOOST_TEST(left() == 2u);
    write(MM2S_DMACR, (three & ~dmacr::IRQThreshold) | 5u << dmacr::IRQThreshold_shift);
    BOOST_TEST(left() == 5u, "another threshold counts anew");
  });
}

// The timer runs from TLAST; a delay of 2 takes three counts of 125 clocks.
BOOST_FIXTURE_TEST_CASE(the_delay_timer_at_exact_times, SgBench) {
  describe_ring(ring, 4, memory_base, 64, sof | eof);
  software.simulate([&] {
    write(MM2S_CURDESC, ring);
    write(MM2S_DMACR, dmacr::RS | dmacr::Dly_IrqEn | dmacr::IOC_IrqEn |
                          9u << dmacr::IRQThreshold_shift | 2u << dmacr::IRQDelay_shift);
    write(MM2S_TAILDESC, ring);
    wait_for(mm2s_registers, dmasr::Idle);
    const std::uint64_t last = sink.beats.back().cycle;
    const auto counted = [&](std::uint64_t after) {
      settle_at(last + after);
      return bits(MM2S_DMASR, dmasr::IRQDelaySts) >> dmasr::IRQDelaySts_shift;
    };
    BOOST_TEST(counted(125) == 0u);
    BOOST_TEST(counted(126) == 1u);
    BOOST_TEST(counted(251) == 2u);
    settle_at(last + 3 * 125 + 1);
    BOOST_TEST(!status(MM2S_DMASR, dmasr::Dly_Irq));
    settle_at(last + 3 * 125 + 2);
    BOOST_TEST(status(MM2S_DMASR, dmasr::Dly_Irq));
    BOOST_TEST(!status(MM2S_DMASR, dmasr::IOC_Irq));
    BOOST_TEST(bits(MM2S_DMASR, dmasr::IRQThresholdSts) == 9u << dmasr::IRQThresholdSts_shift,
               "packets count anew");
    settle_at(last + 3 * 125 + 3);
    BOOST_TEST(dma.mm2s_introut.get());
    write(MM2S_DMASR, dmasr::Dly_Irq);
    at(clock.cycle() + 2000);
    BOOST_TEST(!status(MM2S_DMASR, dmasr::Dly_Irq), "once a pause");
  });
}

BOOST_FIXTURE_TEST_CASE(a_packet_stops_the_delay_timer, SgBench) {
  describe_ring(ring, 4, memory_base + 0x8000, 64, 0);
  software.simulate([&] {
    run(s2mm_registers, ring,
        dmacr::Dly_IrqEn | 1u << dmacr::IRQDelay_shift | 8u << dmacr::IRQThreshold_shift);
    write(S2MM_TAILDESC, nth(ring, 3));
    send_packet(4);
    at(clock.cycle() + 200);
    source.send(1, false);  // the next packet begins, and does not end
    at(clock.cycle() + 1000);
    BOOST_TEST(!status(S2MM_DMASR, dmasr::Dly_Irq));
    source.send(2, true);
    BOOST_TEST(wait_for(s2mm_registers, dmasr::Dly_Irq) > 0u);
  });
}

BOOST_FIXTURE_TEST_CASE(a_cyclic_chain_goes_round_until_it_is_stopped, SgBench) {
  describe_ring(ring, 2, memory_base, 64, sof | eof);
  software.simulate([&] {
    run(mm2s_registers, ring, dmacr::Cyclic_BD_Enable);
    write(MM2S_TAILDESC, 0x50);  // PG021: any value
    at(clock.cycle() + 3000);
    scheduler.synchronise();
    const std::size_t beats = sink.beats.size();
    BOOST_TEST(beats > 200u);
    BOOST_TEST(bits(MM2S_DMASR, dmasr::errors | dmasr::Idle) == 0u);
    write(MM2S_DMACR, dmacr::Cyclic_BD_Enable);
    BOOST_TEST(wait_for(mm2s_registers, dmasr::Halted) > 0u);
    BOOST_TEST(!status(MM2S_DMASR, dmasr::Idle));
    BOOST_TEST(sink.beats.back().last, "what has begun ends");
    const std::size_t stopped = sink.beats.size();
    at(clock.cycle() + 1000);
    scheduler.synchronise();
    BOOST_TEST(sink.beats.size() == stopped);
  });
  for (std::size_t i = 0; i < sink.beats.size(); ++i) {
    BOOST_TEST(sink.beats[i].data == memory.word(4 * (i % 32)));
  }
  BOOST_TEST(reports.count(sc_core::SC_WARNING) == 0u);
}

// S2MM stopped before anything came halts; the descriptor stays as it was and can be used again.
BOOST_FIXTURE_TEST_CASE(a_stopped_channel_starts_again_at_curdesc, SgBench) {
  describe_ring(ring, 2, memory_base + 0x8000, 64, 0);
  software.simulate([&] {
    run(s2mm_registers, ring);
    write(S2MM_TAILDESC, nth(ring, 1));
    at(clock.cycle() + 200);
    BOOST_TEST(s2mm_link.tready.get());
    write(S2MM_DMACR, 0);
    BOOST_TEST(wait_for(s2mm_registers, dmasr::Halted) > 0u);
    BOOST_TEST(!s2mm_link.tready.get());
    BOOST_TEST(status_of(ring) == 0u);
    run(s2mm_registers, nth(ring, 1));
    write(S2MM_TAILDESC, nth(ring, 1));
    send_packet(4);
    BOOST_TEST(wait_for(s2mm_registers, dmasr::IOC_Irq) > 0u);
  });
  BOOST_TEST(status_of(ring) == 0u);
  BOOST_TEST(status_of(nth(ring, 1)) == (descriptor::Cmplt | sof | eof | 16u));
}

// ---- many packets

namespace {

/// Sends packets of random lengths from one ring and takes them in another.
void random_packets(bool direct, bool batch, std::vector<std::uint64_t>& times) {
  SgBench bench;
  bench.memory.allow_dmi = direct;
  bench.memory.latency = sc_core::sc_time(direct ? 0 : 150, sc_core::SC_NS);
  bench.scheduler.set_batch(batch);
  std::mt19937 random(19);
  constexpr unsigned count = 32;
  std::vector<std::uint32_t> words;
  std::uint32_t buffer = DmaBench::memory_base + 0x10000;
  for (unsigned i = 0; i < count; ++i) {
    const bool ends = random() % 3 != 0 || i + 1 == count;
    const std::uint32_t bytes = 4 * (1 + random() % 200);
    bench.describe(SgBench::nth(ring, i), SgBench::nth(ring, (i + 1) % count), buffer,
                   bytes | (ends ? eof : 0));
    for (std::uint32_t at = 0; at < bytes; at += 4) words.push_back(bench.get(buffer + at));
    buffer += bytes;
  }
  bench.describe_ring(other_ring, 40, DmaBench::memory_base + 0x40000, 256 * 4, 0);
  bench.sink.ready_on = [](std::uint64_t cycle) { return cycle % 7 != 0; };
  bench.software.simulate([&] {
    bench.run(s2mm_registers, other_ring);
    bench.run(mm2s_registers, ring);
    bench.write(S2MM_TAILDESC, SgBench::nth(other_ring, 39));
    for (unsigned packet = 0; packet < 20; ++packet)
      bench.send_packet(1 + random() % 300, packet << 16);
    bench.write(MM2S_TAILDESC, SgBench::nth(ring, count - 1));
    times.push_back(bench.wait_for(mm2s_registers, dmasr::Idle));
    bench.at(bench.clock.cycle() + 20'000);
    bench.scheduler.synchronise();
  });
  BOOST_REQUIRE(bench.sink.beats.size() == words.size());
  bool last = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (bench.sink.beats[i].data != words[i]) BOOST_FAIL("beat " << i);
    last = bench.sink.beats[i].last;
    times.push_back(bench.sink.beats[i].cycle);
  }
  BOOST_TEST(last);
  unsigned packets = 0;
  std::uint32_t expected = 0;
  for (unsigned i = 0; i < 40; ++i) {
    const std::uint32_t status = bench.status_of(SgBench::nth(other_ring, i));
    if ((status & descriptor::Cmplt) == 0) break;
    if (status & sof) expected = packets << 16;
    for (std::uint32_t at = 0; at < (status & descriptor::length); at += 4) {
      const std::uint32_t word = bench.get(DmaBench::memory_base + 0x40000 + i * 1024 + at);
      if (word != expected++) BOOST_FAIL("packet " << packets << " byte " << at);
    }
    packets += (status & eof) != 0 ? 1 : 0;
  }
  BOOST_TEST(packets == 20u);
  BOOST_TEST(bench.reports.count(sc_core::SC_WARNING) == 0u);
}

}  // namespace

BOOST_AUTO_TEST_CASE(random_packets_arrive_whole) {
  for (const bool direct : {true, false}) {
    std::vector<std::uint64_t> single, batch;
    random_packets(direct, false, single);
    random_packets(direct, true, batch);
    BOOST_TEST((single == batch), "the scheduler's batches change no time");
  }
}

BOOST_AUTO_TEST_SUITE_END()
