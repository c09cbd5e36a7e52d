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

/// Passes beats as StreamSource does, and only tells when.
class LazySource : public vp::BeatSource, private vp::SignalListener {
 public:
  LazySource(vp::AxiStreamMaster& port, const vp::Clock& clock) : port_(port), clock_(clock) {
    port_.set_source(*this);
    port_.link().tready.attach(*this);
  }

  void send(std::uint32_t data, bool last) {
    beats_.push_back({clock_.cycle() + 1, last});
    words_.push_back(data);
    port_.wake_slave();
  }
  void advance(std::uint64_t cycle) {
    for (; ready_ && next_ < beats_.size() && pass(next_, passed_at_) <= cycle; ++next_) {
      passed_at_ = pass(next_, passed_at_);
      port_.count(1, beats_[next_].last, 0);
    }
  }

 private:
  struct Beat {
    std::uint64_t offered;
    bool last;
  };

  std::uint64_t pass(std::size_t beat, std::uint64_t before) const {
    return std::max({beats_[beat].offered, before, ready_since_}) + 1;
  }
  void on_change(vp::SignalBase&, std::uint32_t) override {
    advance(clock_.cycle());
    ready_ = port_.tready;
    ready_since_ = clock_.cycle();
  }
  std::uint64_t earliest_pass(std::uint32_t count) override {
    if (taken_ != next_) return 0;
    std::uint64_t at = passed_at_;
    for (std::size_t i = next_; i < beats_.size(); ++i) {
      at = pass(i, at);
      if (--count == 0 || beats_[i].last) return at;
    }
    return vp::Clock::never;
  }
  Beats take(std::uint64_t cycle) override {
    advance(cycle);
    const std::size_t first = taken_;
    bool last = false;
    while (taken_ != next_ && !last) last = beats_[taken_++].last;
    return {words_.data() + first, static_cast<std::uint32_t>(taken_ - first), last};
  }

  vp::AxiStreamMaster& port_;
  const vp::Clock& clock_;
  std::vector<Beat> beats_;
  std::vector<std::uint32_t> words_;
  std::size_t next_ = 0, taken_ = 0;  ///< beat that passes next, that is taken next
  std::uint64_t passed_at_ = 0, ready_since_ = 0;
  bool ready_ = false;
};

AxiDmaBuild small_bursts(bool sg) {
  AxiDmaBuild build;
  build.mm2s_burst_beats = build.s2mm_burst_beats = 4;
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
        if (lazy) lazy->advance(clock.cycle());
        seen.push_back(s2mm_link.beats.get());
        seen.push_back(s2mm_link.packets.get());
        seen.push_back(dma.s2mm().m_axi.link.bytes_written.get());
      }
      at(clock.cycle() + 500);
      scheduler.synchronise();
    });
  }

  void send(bool last) {
    if (lazy) return lazy->send(word++, last);
    source.send(word++, last);
  }

  void act(std::uint32_t choice) {
    if (choice < 7) {
      send(below(30) == 0);
    } else if (choice < 9) {
      for (unsigned beats = below(200); beats != 0; --beats) send(beats == 1);
    } else if (choice < 10) {
      path.write_free = clock.cycle() + below(200);  // another master writes until then
    } else if (choice < 13) {
      start();
    } else {
      const std::uint32_t read_now = read(S2MM_DMASR);
      seen.push_back(read_now);
      write(S2MM_DMASR, dmasr::interrupts);
      const std::uint32_t control = below(20);
      if (read_now & dmasr::Err_Irq || control == 0) write(S2MM_DMACR, dmacr::Reset);
      if (control == 1) write(S2MM_DMACR, 0);  // stops
    }
  }

  void start() {
    const std::uint32_t buffer =
        (below(6) == 0 ? broken_base : memory_base + 0x4000) + 4 * below(4);
    broken.latency = sc_core::sc_time(10 * below(20), sc_core::SC_NS);
    const std::uint32_t control = dmacr::RS | dmacr::IOC_IrqEn | dmacr::Err_IrqEn |
                                  1u << dmacr::IRQThreshold_shift | 2u << dmacr::IRQDelay_shift;
    if (!with_sg) {
      write(S2MM_DMACR, control);
      write(S2MM_DA, buffer);
      return write(S2MM_LENGTH, 4 + below(400));
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
  std::unique_ptr<LazySource> lazy;
  Changes changes{clock};
  std::vector<std::uint64_t> seen;
};

enum class How { as_usual, dma_on_every_edge, source_tells };

/// What came of it.
auto outcome(unsigned seed, bool sg, How how) {
  RandomTraffic traffic(seed, sg);
  std::unique_ptr<Nudge> nudge;
  if (how == How::dma_on_every_edge) nudge = std::make_unique<Nudge>(traffic.clock, traffic.dma);
  if (how == How::source_tells) {
    traffic.lazy = std::make_unique<LazySource>(traffic.source.m_axis, traffic.clock);
  }
  traffic.run();
  const unsigned char* memory = traffic.memory.data();
  return std::tuple(traffic.changes.list, traffic.seen,
                    std::vector<unsigned char>(memory, memory + DmaBench::memory_size),
                    traffic.text.str());
}

void expect_usual(How how) {
  for (const bool sg : {false, true}) {
    for (unsigned seed = 1; seed <= 50; ++seed) {
      BOOST_TEST_CONTEXT("seed " << seed << (sg ? ", scatter-gather" : "")) {
        BOOST_TEST((outcome(seed, sg, how) == outcome(seed, sg, How::as_usual)));
      }
    }
  }
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
  expect_usual(How::dma_on_every_edge);
}

BOOST_AUTO_TEST_CASE(beats_of_a_source_are_as_those_on_the_wires) {
  expect_usual(How::source_tells);
}

BOOST_AUTO_TEST_SUITE_END()
