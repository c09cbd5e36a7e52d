#pragma once

#include <pl/stream_crossing/stream_crossing.h>
#include <simulation.h>
#include <vp/clock_scheduler.h>
#include <vp/gated_clock.h>

#include <cstdint>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "change_log.h"
#include "frames.h"
#include "pipeline.h"
#include "stream.h"

namespace harness {

struct TwoClocks {
  std::uint64_t pixels_hz, bus_hz;
  bool gated;  ///< that of the pixels is the bus' clock behind a gate
};
inline const TwoClocks several_clocks[] = {
    {25'175'000, 100'000'000, false},  {100'000'000, 100'000'000, false},
    {130'000'000, 100'000'000, false}, {50'000'000, 100'000'000, false},
    {200'000'000, 66'666'667, false},  {100'000'000, 100'000'000, true}};

/// Packets of all lengths on their way from the clock of pixels to that of the buses, with a taker
/// that lets them wait, resets, pauses, and a gate in front of the clock of pixels.
struct StreamBench : kit::Simulation {
  StreamBench(const std::vector<std::string>& more, const TwoClocks& with)
      : settings(with_depth(more)), clocks(with) {
    crossing->entry().rst(rst);
    source.m(before);
    crossing->entry().s(before);
    crossing->m(behind);
    sink.s(behind);
  }
  static std::vector<std::string> with_depth(std::vector<std::string> more) {
    more.push_back("pixel_crossing.depth=8");
    return more;
  }

  void pass(std::uint64_t bus_clocks) {
    sc_core::sc_start(vp::from_ps(bus.duration_ps(static_cast<double>(bus_clocks)) + 1));
    scheduler.synchronise();
  }
  void play() {
    pass(10);
    for (std::uint32_t round = 0; round < 30; ++round) {
      std::vector<std::uint32_t> words(1 + random.below(120));
      for (std::uint32_t& word : words) word = random.below(~0u);
      source.send(words, 1 + random.below(round % 3 == 0 ? 3 : 40));
      const unsigned waits = 1 + round % 4;
      for (int step = 0; step < 40; ++step) {
        pass(1 + random.below(20));
        sink.accept(random.below(waits) == 0);
        if (clocks.gated) gate.open(random.below(3) != 0);
      }
      gate.open(true);
      if (round % 5 == 4) reset();
      sink.accept(true);
      pass(round % 7 == 6 ? 5'000 : 200);
    }
  }
  void reset() {
    rst = true;
    source.send({}, 1);
    pass(60);
    rst = false;
    pass(60);
  }
  std::string seen() {
    const ChangeLog ready(before.tready, scheduler), valid(behind.tvalid, scheduler);
    play();
    std::ostringstream text;
    for (const auto& beat : sink.beats) text << beat.ps << " " << beat.data << beat.last << "\n";
    for (const ChangeLog* log : {&ready, &valid}) {
      for (const Change& change : log->changes) text << change << "\n";
    }
    for (const vp::AxiStream* link : {&before, &behind})
      text << link->beats.get() << " " << link->packets.get() << " " << link->stalls.get() << "\n";
    return text.str();
  }

  struct Fidelity : sc_core::sc_module {
    explicit Fidelity(sc_core::sc_module_name name) : sc_module(name) {}
    pl::Choice<pl::StreamCrossing> pixel_crossing{"pixel_crossing", pl::StreamCrossing::models(),
                                                  pl::Fidelity::clocked};
  };

  Settings settings;
  const TwoClocks clocks;
  Random random{11};
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock bus{"bus", scheduler, clocks.bus_hz}, camera{"camera", scheduler, clocks.pixels_hz};
  vp::GatedClock gate{"gate", bus};
  vp::Clock& pixels = clocks.gated ? gate : camera;
  Fidelity fidelity{"fidelity"};
  std::unique_ptr<pl::StreamCrossing> crossing =
      fidelity.pixel_crossing.make({pixels, pl::Geometry{64, 32, 32}, &bus});
  vp::Signal<bool> rst{"rst"};
  StreamSource source{"source", pixels};
  vp::AxiStream before{"before"}, behind{"behind"};
  StreamSink sink{"sink", bus};
};

}  // namespace harness
