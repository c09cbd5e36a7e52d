// The edges that a DMA runs for beats on the wires of its stream: one for each, and none without
// which anything would be different.
#include <boost/test/unit_test.hpp>
#include <cstring>
#include <map>
#include <random>
#include <tuple>
#include <vector>

#include "dma_bench.h"

using namespace axi_dma;
using kit::DmaBench;
using xilinx::AxiDmaBuild;

namespace {

/// Runs another module on every edge.
struct Nudge : vp::Clocked {
  Nudge(vp::Clock& clock, vp::Clocked& target) : Clocked("nudge", clock), target_(target) {}

 private:
  void edge() override { target_.wake(); }
  vp::Clocked& target_;
};

/// Notes when signals change, and to what.
struct Changes : vp::SignalListener {
  explicit Changes(const vp::Clock& c) : clock(c) {}
  void on_change(vp::SignalBase& signal, std::uint32_t id) override {
    list.emplace_back(clock.cycle(), id, signal.bits());
  }
  const vp::Clock& clock;
  std::vector<std::tuple<std::uint64_t, std::uint32_t, std::uint64_t>> list;
};

AxiDmaBuild small_bursts(bool sg) {
  AxiDmaBuild build;
  build.burst_beats = 4;
  build.include_sg = sg;
  return build;
}

/// Software, stream and memory do what comes from `seed`. Some memory answers with an error.
struct RandomTraffic : DmaBench {
  RandomTraffic(unsigned seed, bool sg) : DmaBench(small_bursts(sg)), random(seed), with_sg(sg) {
    dma.share_memory_path(path);
    s2mm_link.tready.attach(changes, 1);
    dma.s2mm_introut.attach(changes, 2);
  }

  std::uint32_t below(std::uint32_t limit) { return static_cast<std::uint32_t>(random() % limit); }

  void run() {
    software.simulate([&] {
      for (unsigned action = 0; action < 300; ++action) {
        at(clock.cycle() + 1 + below(below(4) == 0 ? 80 : 6));
        scheduler.synchronise();
        act(below(16));
        seen.push_back(s2mm_link.beats.get());
        seen.push_back(s2mm_link.packets.get());
        seen.push_back(dma.s2mm().m_axi.link.bytes_written.get());
      }
      at(clock.cycle() + 500);
      scheduler.synchronise();
    });
  }

  void act(std::uint32_t choice) {
    if (choice < 8) {
      source.send(word++, below(12) == 0);
    } else if (choice < 9) {
      for (unsigned beats = below(50); beats != 0; --beats) source.send(word++, beats == 1);
    } else if (choice < 10) {
      path.write_free = clock.cycle() + below(200);  // another master writes until then
    } else if (choice < 13) {
      start();
    } else {
      const std::uint32_t read_now = read(S2MM_DMASR);
      seen.push_back(read_now);
      write(S2MM_DMASR, dmasr::interrupts);
      if (read_now & dmasr::Err_Irq || below(20) == 0) write(S2MM_DMACR, dmacr::Reset);
    }
  }

  void start() {
    const std::uint32_t buffer = below(12) == 0 ? broken_base : memory_base + 0x4000;
    const std::uint32_t control = dmacr::RS | dmacr::IOC_IrqEn | dmacr::Err_IrqEn |
                                  1u << dmacr::IRQThreshold_shift | 2u << dmacr::IRQDelay_shift;
    if (!with_sg) {
      write(S2MM_DMACR, control);
      write(S2MM_DA, buffer);
      return write(S2MM_LENGTH, 4 + below(120));
    }
    constexpr std::uint32_t ring = memory_base + 0x1000;
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t at = ring + 0x40 * i;
      for (const auto& [offset, value] :
           std::map<std::uint32_t, std::uint32_t>{{descriptor::NXTDESC, at + 0x40},
                                                  {descriptor::BUFFER_ADDRESS, buffer + 0x100 * i},
                                                  {descriptor::CONTROL, 4 * (1 + below(20))},
                                                  {descriptor::STATUS, 0}}) {
        std::memcpy(memory.data() + (at + offset - memory_base), &value, sizeof value);
      }
    }
    write(S2MM_CURDESC, ring);
    write(S2MM_DMACR, control);
    write(S2MM_TAILDESC, ring + 0x40 * below(4));
  }

  std::mt19937 random;
  const bool with_sg;
  xilinx::MemoryPath path;
  std::uint32_t word = 0x1000;
  Changes changes{clock};
  std::vector<std::uint64_t> seen;
};

/// What came of it, with the DMA on every edge or on those that it wants.
auto outcome(unsigned seed, bool sg, bool every_edge) {
  RandomTraffic traffic(seed, sg);
  std::unique_ptr<Nudge> nudge;
  if (every_edge) nudge = std::make_unique<Nudge>(traffic.clock, traffic.dma);
  traffic.run();
  const unsigned char* memory = traffic.memory.data();
  return std::tuple(traffic.changes.list, traffic.seen,
                    std::vector<unsigned char>(memory, memory + DmaBench::memory_size),
                    traffic.text.str());
}

}  // namespace

BOOST_AUTO_TEST_SUITE(s2mm_edges)

BOOST_FIXTURE_TEST_CASE(a_beat_takes_one_edge_of_the_dma, DmaBench) {
  sink.sleep_until = 1'000'000;  // would run on each edge
  software.simulate([&] {
    start_s2mm(memory_base, 4096);
    at(30);
    scheduler.synchronise();
    const std::uint64_t before = clock.edges_run();
    for (unsigned i = 0; i < 20; ++i) {
      source.send(i, false);
      at(clock.cycle() + 4);
    }
    scheduler.synchronise();
    BOOST_TEST(s2mm_link.beats == 20u);
    BOOST_TEST(s2mm_link.stalls == 0u);
    BOOST_TEST(clock.edges_run() - before == 2 * 20u, "the master offers it, and it passes");
  });
}

// As in a reset of the master: the edges after count for nothing.
BOOST_FIXTURE_TEST_CASE(a_beat_that_is_taken_back_waits_no_longer, DmaBench) {
  constexpr std::uint64_t ready = 20 + 11;
  source.send(1, false);  // on offer from the first edge on
  software.simulate([&] {
    at(20);
    start_s2mm(memory_base, 128);
    at(ready);
    scheduler.synchronise();
    BOOST_TEST(s2mm_link.tready.get());
    source.m_axis.withdraw();
    at(ready + 100);
    start_mm2s(memory_base, 128);  // the next edges
    at(ready + 200);
    scheduler.synchronise();
    BOOST_TEST(s2mm_link.stalls == ready - 1);
    BOOST_TEST(s2mm_link.beats == 0u);
  });
}

BOOST_AUTO_TEST_CASE(nothing_happens_on_the_others) {
  for (const bool sg : {false, true}) {
    for (unsigned seed = 1; seed <= 50; ++seed) {
      BOOST_TEST_CONTEXT("seed " << seed << (sg ? ", scatter-gather" : "")) {
        BOOST_TEST((outcome(seed, sg, false) == outcome(seed, sg, true)));
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
