#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include "dma_bench.h"

#include <vp/configuration.h>
#include <vp/error.h>

using namespace axi_dma;
using kit::DmaBench;
using xilinx::AxiDmaBuild;

namespace {

struct Channel {
  std::uint32_t control, status, address, address_msb, length;
};
constexpr Channel channels[] = {{MM2S_DMACR, MM2S_DMASR, MM2S_SA, MM2S_SA_MSB, MM2S_LENGTH},
                                {S2MM_DMACR, S2MM_DMASR, S2MM_DA, S2MM_DA_MSB, S2MM_LENGTH}};

AxiDmaBuild only(bool mm2s) {
  AxiDmaBuild build;
  build.include_mm2s = mm2s;
  build.include_s2mm = !mm2s;
  return build;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(dma_registers)

BOOST_FIXTURE_TEST_CASE(reset_values, DmaBench) {
  software.simulate([&] {
    for (const vp::RegisterInfo& info : registers) {
      BOOST_TEST(read(info.offset) == info.reset, info.name);
    }
    for (const std::uint32_t pointer : {0x08u, 0x0Cu, 0x10u, 0x14u, 0x38u, 0x3Cu, 0x40u, 0x44u}) {
      write(pointer, 0xFFFFFFFF);
      BOOST_TEST(software.response() == tlm::TLM_OK_RESPONSE);
      BOOST_TEST(read(pointer) == 0u, "no scatter-gather engine");
    }
    BOOST_TEST(read(0x400) == 0x00010002u, "ten address bits are decoded");
    read(0x6);
    BOOST_TEST(software.response() == tlm::TLM_BURST_ERROR_RESPONSE);
  });
}

BOOST_FIXTURE_TEST_CASE(control_bit_by_bit, DmaBench) {
  software.simulate([&] {
    for (const Channel& c : channels) {
      for (unsigned bit = 0; bit < 32; ++bit) {
        const std::uint32_t mask = 1u << bit;
        if (mask == dmacr::Reset) continue;
        write(c.control, mask);
        std::uint32_t expected = (mask & 0xFFFF7019u) | dmacr::Reserved_1;
        if ((mask & dmacr::IRQThreshold) == 0) expected |= 1u << dmacr::IRQThreshold_shift;
        BOOST_TEST(read(c.control) == expected, "bit " << bit);
      }
      write(c.control, 0);
      BOOST_TEST(read(c.control) == 0x00010002u, "threshold 0 stores 1");
    }
  });
}

BOOST_FIXTURE_TEST_CASE(status_is_not_writable, DmaBench) {
  software.simulate([&] {
    for (const Channel& c : channels) {
      write(c.status, 0xFFFFFFFF);
      BOOST_TEST(read(c.status) == dmasr::Halted);
    }
  });
}

BOOST_FIXTURE_TEST_CASE(address_and_length_bit_by_bit, DmaBench) {
  software.simulate([&] {
    for (const Channel& c : channels) {
      for (unsigned bit = 0; bit < 32; ++bit) {
        write(c.address, 1u << bit);
        BOOST_TEST(read(c.address) == 1u << bit);
        write(c.address_msb, 1u << bit);
        BOOST_TEST(read(c.address_msb) == 0u, "32-bit addresses");
        write(c.length, 1u << bit);
        BOOST_TEST(read(c.length) == (bit < 14 ? 1u << bit : 0u));
      }
    }
    BOOST_TEST(warnings("length_too_wide") == 2u * 18);
    BOOST_TEST(warnings("length_while_halted") == 2u * 14);
    BOOST_TEST(reports.count("/markervp/register_bank/ignored_write") == 64u);
  });
}

BOOST_AUTO_TEST_CASE(length_width_is_a_build_option) {
  for (const unsigned width : {8u, 26u}) {
    AxiDmaBuild build;
    build.length_width = width;
    DmaBench bench(build);
    bench.software.simulate([&] {
      bench.write(MM2S_LENGTH, 0xFFFFFFFF);
      BOOST_TEST(bench.read(MM2S_LENGTH) == (1u << width) - 1);
    });
  }
}

BOOST_FIXTURE_TEST_CASE(halted_follows_run_two_clocks_later, DmaBench) {
  software.simulate([&] {
    for (const Channel& c : channels) {
      const std::uint64_t start = clock.cycle() + 10;
      at(start);
      write(c.control, dmacr::RS);
      BOOST_TEST(read_at(start + 1, c.status) == dmasr::Halted);
      BOOST_TEST(read_at(start + 2, c.status) == 0u, "running, but not Idle before a transfer");
      BOOST_TEST(read_at(start + 500, c.status) == 0u);
      write(c.control, 0);
      BOOST_TEST(read_at(start + 501, c.status) == 0u);
      BOOST_TEST(read_at(start + 502, c.status) == dmasr::Halted);
      at(start + 600);
      write(c.control, dmacr::RS);
      write(c.control, 0);
      BOOST_TEST(read_at(start + 610, c.status) == dmasr::Halted, "run taken back in time");
    }
    BOOST_TEST(!dma.mm2s_introut.get());
    BOOST_TEST(!dma.s2mm_introut.get());
  });
}

// RS written once more moves nothing, and RS written again in time takes the halt back.
BOOST_FIXTURE_TEST_CASE(run_written_again, DmaBench) {
  software.simulate([&] {
    for (const Channel& c : channels) {
      const std::uint64_t start = clock.cycle() + 10;
      at(start);
      write(c.control, dmacr::RS);
      at(start + 1);
      write(c.control, dmacr::RS);
      BOOST_TEST(read(c.status) == dmasr::Halted);
      BOOST_TEST(read_at(start + 2, c.status) == 0u);
      at(start + 10);
      write(c.control, 0);
      at(start + 11);
      write(c.control, dmacr::RS);
      BOOST_TEST(read_at(start + 12, c.status) == 0u);
      BOOST_TEST(read_at(start + 20, c.status) == 0u);
    }
  });
}

// The pin drops the burst on the bus: nothing of it delays what comes.
BOOST_FIXTURE_TEST_CASE(after_the_reset_pin_a_soft_reset_has_nothing_to_wait_for, DmaBench) {
  software.simulate([&] {
    start_mm2s(memory_base, 128);
    at(40);  // the burst's data is on the bus until 69
    resetn = false;
    at(42);
    resetn = true;
    const std::uint64_t now = clock.cycle();
    write(MM2S_DMACR, dmacr::Reset);
    BOOST_TEST(first_edge([&] { return !status(MM2S_DMACR, dmacr::Reset); }) == now + 1 + 8);
  });
}

// MM2S runs before S2MM on an edge, and learns of its error on the next.
BOOST_FIXTURE_TEST_CASE(an_error_of_s2mm_halts_mm2s_at_an_exact_time, DmaBench) {
  send_packet(4);
  software.simulate([&] {
    write(MM2S_DMACR, dmacr::RS);
    start_s2mm(memory_base, 8);
    const std::uint64_t failed = first_edge([&] { return status(S2MM_DMASR, dmasr::Err_Irq); });
    BOOST_TEST(read_at(failed + 2, MM2S_DMASR) == 0u);
    BOOST_TEST(read_at(failed + 3, MM2S_DMASR) == dmasr::Halted);
  });
}

BOOST_FIXTURE_TEST_CASE(a_halt_takes_idle_away, DmaBench) {
  send_packet(4);
  software.simulate([&] {
    start_mm2s(memory_base, 16);
    start_s2mm(memory_base + 0x100, 16);
    at(300);
    for (const Channel& c : channels) {
      BOOST_TEST(read(c.status) == (dmasr::Idle | dmasr::IOC_Irq));
      write(c.status, dmasr::IOC_Irq);
      const std::uint64_t halt = clock.cycle();
      write(c.control, 0);
      BOOST_TEST(read_at(halt + 1, c.status) == dmasr::Idle);
      BOOST_TEST(read_at(halt + 2, c.status) == dmasr::Halted);
      write(c.control, dmacr::RS);
      BOOST_TEST(read_at(halt + 10, c.status) == 0u, "no transfer since it runs again");
    }
  });
}

BOOST_AUTO_TEST_CASE(a_channel_that_is_not_built_reads_0) {
  for (const bool mm2s : {true, false}) {
    DmaBench bench(only(mm2s));
    const Channel& built = channels[mm2s ? 0 : 1];
    const Channel& missing = channels[mm2s ? 1 : 0];
    bench.software.simulate([&] {
      BOOST_TEST(bench.read(built.control) == 0x00010002u);
      for (const std::uint32_t offset : {missing.control, missing.status, missing.address,
                                         missing.address_msb, missing.length}) {
        bench.write(offset, 0xFFFFFFFF);
        BOOST_TEST(bench.software.response() == tlm::TLM_OK_RESPONSE);
        BOOST_TEST(bench.read(offset) == 0u);
      }
      bench.at(100);
      BOOST_TEST(bench.read(built.control) == 0x00010002u, "no reset through the missing channel");
    });
    if (mm2s) {
      BOOST_CHECK_THROW(bench.dma.s2mm(), std::logic_error);
    } else {
      BOOST_CHECK_THROW(bench.dma.mm2s(), std::logic_error);
    }
  }
}

BOOST_AUTO_TEST_CASE(impossible_builds_are_refused) {
  kit::Simulation simulation;
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 100'000'000);
  AxiDmaBuild none;
  none.include_mm2s = none.include_s2mm = false;
  BOOST_CHECK_THROW(xilinx::AxiDma("none", clock, none), vp::InputError);
  for (const auto burst_beats : {&AxiDmaBuild::mm2s_burst_beats, &AxiDmaBuild::s2mm_burst_beats}) {
    AxiDmaBuild odd;
    odd.*burst_beats = 24;
    BOOST_CHECK_THROW(xilinx::AxiDma("odd", clock, odd), vp::InputError);
  }
  vp::Configuration configuration;
  configuration.set("narrow.length_width=7");
  vp::Configuration::Scope scope(configuration);
  BOOST_CHECK_THROW(xilinx::AxiDma("narrow", clock), vp::InputError);
}

BOOST_AUTO_TEST_CASE(each_channel_has_bursts_of_its_own_length) {
  AxiDmaBuild build;
  build.mm2s_burst_beats = 16;
  build.s2mm_burst_beats = 4;
  DmaBench bench(build);
  constexpr std::uint32_t to = DmaBench::memory_base + 0x1000;
  bench.software.simulate([&] {
    bench.start_s2mm(to, 64);
    bench.start_mm2s(DmaBench::memory_base, 64);
    bench.send_packet(16);
    bench.at(400);
  });
  const std::vector<std::pair<std::uint64_t, std::uint64_t>> written{
      {to, 16}, {to + 16, 16}, {to + 32, 16}, {to + 48, 16}};
  BOOST_TEST_REQUIRE(bench.mm2s_bursts.bursts.size() == 1u);
  BOOST_TEST(bench.mm2s_bursts.bursts.front().second == 64u);
  BOOST_TEST((bench.s2mm_bursts.bursts == written));
}

BOOST_AUTO_TEST_CASE(a_channel_without_stream_is_an_error) {
  kit::Simulation simulation;
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 100'000'000);
  xilinx::AxiDma dma("dma", clock);
  BOOST_CHECK_THROW(sc_core::sc_start(sc_core::SC_ZERO_TIME), sc_core::sc_report);
}

BOOST_FIXTURE_TEST_CASE(soft_reset_of_either_channel_resets_both, DmaBench) {
  software.simulate([&] {
    std::uint64_t start = 0;
    for (const Channel& c : channels) {
      start += 100;
      at(start);
      for (const Channel& each : channels) {
        write(each.control, 0x12347018 | dmacr::RS);
        write(each.address, 0x12345678);
      }
      at(start + 10);
      write(c.control, 0x12347018 | dmacr::RS | dmacr::Reset);
      // It shows in both channels, and a write does not take it back (HDL of v7.1).
      for (const Channel& each : channels) {
        BOOST_TEST((read(each.control) & dmacr::Reset) != 0u);
        write(each.control, 0);
        BOOST_TEST((read(each.control) & dmacr::Reset) != 0u);
      }
      // Quiet on the next edge, then 8 clocks.
      BOOST_TEST((read_at(start + 10 + 8, c.control) & dmacr::Reset) != 0u);
      BOOST_TEST((read_at(start + 10 + 9, c.control) & dmacr::Reset) == 0u);
      for (const vp::RegisterInfo& info : registers) {
        BOOST_TEST(read(info.offset) == info.reset, info.name);
      }
    }
  });
}

// From the edge on which it is quiet until the reset is over.
BOOST_FIXTURE_TEST_CASE(what_is_at_its_streams_is_reset_with_it, DmaBench) {
  vp::Signal<bool> resetn("resetn");
  dma.drive_reset_out(resetn);
  software.simulate([&] {
    at(10);
    BOOST_TEST(resetn.get());
    write(MM2S_DMACR, dmacr::Reset);
    at(15);
    BOOST_TEST(!resetn.get());
    at(20);
    BOOST_TEST(resetn.get());
  });
}

BOOST_FIXTURE_TEST_CASE(commands_during_a_soft_reset_are_lost, DmaBench) {
  software.simulate([&] {
    write(MM2S_DMACR, dmacr::RS | dmacr::Reset);
    write(MM2S_SA, memory_base);
    write(MM2S_LENGTH, 64);
    BOOST_TEST(warnings("length_in_reset") == 1u);
    at(300);
    BOOST_TEST(sink.beats.empty());
    BOOST_TEST(read(MM2S_DMACR) == 0x00010002u);
    BOOST_TEST(read(MM2S_LENGTH) == 0u);
  });
}

BOOST_FIXTURE_TEST_CASE(reset_pin, DmaBench) {
  software.simulate([&] {
    start_mm2s(memory_base, 4096);
    at(80);
    resetn = false;
    scheduler.synchronise();
    read(MM2S_DMASR);
    BOOST_TEST(software.response() == tlm::TLM_GENERIC_ERROR_RESPONSE);
    at(100);
    resetn = true;
    for (const vp::RegisterInfo& info : registers) {
      BOOST_TEST(read(info.offset) == info.reset, info.name);
    }
    BOOST_TEST(!mm2s_link.tvalid.get());
    const std::size_t beats = sink.beats.size();
    start_mm2s(memory_base, 128);
    at(300);
    BOOST_TEST(sink.beats.size() == beats + 32, "works again");
  });
}

BOOST_AUTO_TEST_SUITE_END()
