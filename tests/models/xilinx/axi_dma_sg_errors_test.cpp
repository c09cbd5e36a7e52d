// Scatter-gather when descriptors, pointers or buffers are wrong, and a reset in the middle.
#include <boost/test/unit_test.hpp>

#include "sg_bench.h"

#include <vp/configuration.h>
#include <vp/error.h>
#include <vp/ip.h>

using namespace kit;
using xilinx::AxiDmaBuild;

BOOST_AUTO_TEST_SUITE(scatter_gather_errors)

BOOST_FIXTURE_TEST_CASE(a_complete_descriptor_stops_both_channels, SgBench) {
  describe_ring(ring, 4, memory_base, 64, sof | eof);
  put(nth(ring, 1) + descriptor::STATUS, descriptor::Cmplt);
  software.simulate([&] {
    write(S2MM_DMACR, dmacr::RS);
    run(mm2s_registers, ring, dmacr::Err_IrqEn);
    write(MM2S_TAILDESC, nth(ring, 3));
    BOOST_TEST(wait_for(mm2s_registers, dmasr::Err_Irq) > 0u);
    at(clock.cycle() + 50);
    BOOST_TEST(bits(MM2S_DMASR, not_counts) == (dmasr::Halted | dmasr::SGIncld | dmasr::SGIntErr |
                                                dmasr::Err_Irq | dmasr::IOC_Irq));
    BOOST_TEST(bits(S2MM_DMASR, dmasr::Halted) == dmasr::Halted);
    BOOST_TEST(read(MM2S_CURDESC) == nth(ring, 1), "the one at fault");
    BOOST_TEST(dma.mm2s_introut.get());
    BOOST_TEST(sink.beats.size() == 16u, "those before it are done");
    BOOST_TEST(warnings("descriptor_error") == 1u);
    write(MM2S_DMACR, dmacr::Reset);
    at(clock.cycle() + 30);
    describe_ring(ring, 4, memory_base, 64, sof | eof);
    run(mm2s_registers, ring);
    write(MM2S_TAILDESC, nth(ring, 3));
    BOOST_TEST(wait_for(mm2s_registers, dmasr::Idle) > 0u, "recovered");
  });
  BOOST_TEST(sink.beats.size() == 16u + 64u);
}

BOOST_FIXTURE_TEST_CASE(a_ring_that_loops_before_its_tail_ends_with_an_error, SgBench) {
  software.simulate([&] {
    for (const unsigned count : {1u, 2u, 7u}) {
      describe_ring(ring, count, memory_base, 64, sof | eof);
      write(MM2S_DMACR, dmacr::Reset);
      at(clock.cycle() + 50);
      run(mm2s_registers, ring);
      write(MM2S_TAILDESC, nth(ring, 20));
      BOOST_TEST(wait_for(mm2s_registers, dmasr::SGIntErr) > 0u);
    }
  });
  BOOST_TEST(warnings("descriptor_error") == 3u);
}

// Software's order to write is followed to the tail at once: from the third on it goes round.
BOOST_FIXTURE_TEST_CASE(a_chain_that_ends_in_a_loop_orders_each_buffer_once, SgBench) {
  software.simulate([&] {
    describe_ring(ring, 4, memory_base, 64, 0);
    put(nth(ring, 3) + descriptor::NXTDESC, nth(ring, 2));
    run(s2mm_registers, ring);
    write(S2MM_TAILDESC, nth(ring, 20));
    BOOST_TEST(vp::all_below<xilinx::MemoryPort>(dma).size() == 3u);
    std::size_t open = 0;
    for (const auto* port : vp::all_below<xilinx::MemoryPort>(dma))
      open += port->orders.open().size();
    BOOST_TEST(open == 4u);
  });
}

BOOST_FIXTURE_TEST_CASE(a_misaligned_descriptor_is_told_of, SgBench) {
  describe_ring(ring, 2, memory_base, 64, sof | eof);
  put(ring + descriptor::NXTDESC, nth(ring, 1) + 0x20);
  software.simulate([&] {
    run(mm2s_registers, ring + 4);
    BOOST_TEST(warnings("descriptor_unaligned") == 1u);
    BOOST_TEST(read(MM2S_CURDESC) == ring);
    write(MM2S_TAILDESC, nth(ring, 1) + 8);
    BOOST_TEST(warnings("descriptor_unaligned") == 2u);
    BOOST_TEST(wait_for(mm2s_registers, dmasr::Idle) > 0u, "the low bits are dropped");
    BOOST_TEST(warnings("descriptor_unaligned") == 3u);
  });
  BOOST_TEST(sink.beats.size() == 32u);
}

BOOST_FIXTURE_TEST_CASE(pointers_written_at_the_wrong_time, SgBench) {
  describe_ring(ring, 2, memory_base, 64, sof | eof);
  software.simulate([&] {
    write(MM2S_CURDESC, ring);
    write(MM2S_TAILDESC, nth(ring, 1));
    at(clock.cycle() + 500);
    BOOST_TEST(warnings("taildesc_while_halted") == 1u);
    run(mm2s_registers, ring);
    at(clock.cycle() + 500);
    BOOST_TEST(sink.beats.empty(), "RS alone starts nothing");
    write(MM2S_CURDESC, nth(ring, 1));
    BOOST_TEST(warnings("curdesc_while_running") == 1u);
    BOOST_TEST(read(MM2S_CURDESC) == ring);
  });
}

BOOST_AUTO_TEST_CASE(descriptors_where_no_memory_is) {
  struct Case {
    std::uint32_t at, error;
  };
  for (const Case& c : {Case{DmaBench::broken_base, dmasr::SGSlvErr},
                        Case{DmaBench::nothing_base, dmasr::SGDecErr}}) {
    SgBench bench;
    bench.software.simulate([&] {
      bench.run(s2mm_registers, c.at);
      bench.write(S2MM_TAILDESC, c.at);
      BOOST_TEST(bench.wait_for(s2mm_registers, c.error) > 0u);
      bench.at(bench.clock.cycle() + 50);
      BOOST_TEST(bench.bits(S2MM_DMASR, dmasr::Halted | dmasr::errors) ==
                 (dmasr::Halted | c.error));
      BOOST_TEST(bench.read(S2MM_CURDESC) == c.at);
    });
    BOOST_TEST(bench.warnings("descriptor_error") == 1u);
  }
}

BOOST_AUTO_TEST_CASE(buffers_that_cannot_be_moved) {
  struct Case {
    std::uint32_t buffer, control, error, in_descriptor;
    const char* warning;
  };
  const Case cases[] = {
      {DmaBench::broken_base, 64 | eof, dmasr::DMASlvErr, descriptor::DMASlvErr, "bus_error"},
      {DmaBench::nothing_base, 64 | eof, dmasr::DMADecErr, descriptor::DMADecErr, "bus_error"},
      {DmaBench::memory_base, 0 | eof, dmasr::DMAIntErr, descriptor::DMAIntErr, "length_zero"},
  };
  for (const Case& c : cases) {
    for (const Pointers& channel : {mm2s_registers, s2mm_registers}) {
      SgBench bench;
      bench.describe(ring, SgBench::nth(ring, 1), DmaBench::memory_base + 0x8000, 64 | sof | eof);
      bench.describe(SgBench::nth(ring, 1), ring, c.buffer, c.control);
      bench.software.simulate([&] {
        bench.run(channel, ring);
        bench.write(channel.tail, SgBench::nth(ring, 1));
        bench.send_packet(16);
        bench.send_packet(16);
        BOOST_TEST(bench.wait_for(channel, c.error) > 0u);
        bench.at(bench.clock.cycle() + 100);
        BOOST_TEST(bench.status(channel.status, dmasr::Halted));
      });
      BOOST_TEST((bench.status_of(ring) & 0xF0000000u) == descriptor::Cmplt);
      BOOST_TEST(bench.status_of(SgBench::nth(ring, 1)) == (descriptor::Cmplt | c.in_descriptor));
      BOOST_TEST(bench.warnings(c.warning) == 1u);
    }
  }
}

BOOST_AUTO_TEST_CASE(lengths_that_do_not_fit_the_build) {
  AxiDmaBuild build = with_sg();
  build.length_width = 8;
  SgBench bench(build);
  bench.describe(ring, ring, DmaBench::memory_base, 0x140 | sof | eof);
  bench.software.simulate([&] {
    bench.run(mm2s_registers, ring);
    bench.write(MM2S_TAILDESC, ring);
    bench.wait_for(mm2s_registers, dmasr::Idle);
  });
  BOOST_TEST(bench.warnings("length_too_wide") == 1u);
  BOOST_TEST(bench.sink.beats.size() == 16u);
}

BOOST_FIXTURE_TEST_CASE(a_reset_in_the_middle_leaves_nothing_behind, SgBench) {
  software.simulate([&] {
    for (const std::uint64_t after : {5u, 25u, 45u, 80u, 130u, 400u, 700u}) {
      describe_ring(ring, 16, memory_base, 1024, sof | eof);
      run(mm2s_registers, ring);
      write(MM2S_TAILDESC, nth(ring, 15));
      at(clock.cycle() + after);
      write(S2MM_DMACR, dmacr::Reset);
      at(clock.cycle() + 200);
      BOOST_TEST(read(MM2S_DMASR) == 0x00010009u);
      BOOST_TEST(!mm2s_link.tvalid.get());
      scheduler.synchronise();
      sink.beats.clear();
      describe_ring(ring, 16, memory_base, 1024, sof | eof);
      run(mm2s_registers, nth(ring, 3));
      write(MM2S_TAILDESC, nth(ring, 3));
      BOOST_TEST(wait_for(mm2s_registers, dmasr::Idle) > 0u);
      BOOST_TEST(sink.beats.size() == 256u);
      BOOST_TEST(sink.beats.front().data == memory.word(3 * 1024));
      write(MM2S_DMACR, dmacr::Reset);
      at(clock.cycle() + 50);
    }
  });
}

BOOST_AUTO_TEST_CASE(the_engine_is_there_only_if_it_was_built) {
  DmaBench bench;
  BOOST_CHECK_THROW(bench.dma.scatter_gather(), std::logic_error);
}

BOOST_AUTO_TEST_SUITE_END()
