// The components of a FAST module: equations 4.1 and 4.2, C.2 contiguity, C.3 direction, C.4
// strength. Each takes its inputs on one edge and shows the result from that edge on.
#include "fast_examples.h"

#include "bench.h"
#include "worked_corner.h"

namespace appendix_c {

namespace {

constexpr std::uint64_t last_edge = 8;

struct ThresholdBench : sc_core::sc_module {
  ThresholdBench(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
      : sc_module(name), clk("clk", scheduler, clock_hz) {
    stimuli.writes(poi);
    circle.written_by(stimuli);
    component.reads(poi);
    circle.read_by(component);
    component.writes(bright);
    difference.written_by(component);
  }

  /// The worked corner, then a circle whose pixels lie around the limit 40 + 30.
  void play() {
    pl::fast::Circle levels{};
    if (clk.cycle() == 2) levels = worked_circle();
    if (clk.cycle() == 4) {
      for (unsigned n = 0; n < 16; ++n) levels[n] = static_cast<std::uint8_t>(66 + n);
    }
    poi = clk.cycle() == 2 || clk.cycle() == 4 ? point_level : 0;
    for (unsigned n = 0; n < 16; ++n) circle[n] = levels[n];
  }
  void evaluate() {
    pl::fast::Circle levels;
    for (unsigned n = 0; n < 16; ++n) levels[n] = circle[n];
    const pl::fast::Thresholded result = pl::fast::threshold(levels, poi, corner_threshold);
    bright = result.bright;
    for (unsigned n = 0; n < 16; ++n) difference[n] = result.difference[n];
  }

  vp::Clock clk;
  vp::Signal<std::uint8_t> poi{"poi"};
  vp::Probe<std::uint32_t> t{"t", corner_threshold, 8};
  SignalArray<std::uint8_t> circle{"circle", 16};
  vp::Signal<std::uint16_t> bright{"bright"};
  SignalArray<std::uint8_t> difference{"difference", 16};
  Stage stimuli{"stimuli", clk, [this] { play(); }};
  Stage component{"component", clk, [this] { evaluate(); }};
};

/// Bright arrays in, one result out.
struct BrightBench : sc_core::sc_module {
  BrightBench(sc_core::sc_module_name name, vp::ClockScheduler& scheduler,
              std::vector<std::uint16_t> arrays)
      : sc_module(name), clk("clk", scheduler, clock_hz), arrays_(std::move(arrays)) {
    stimuli.writes(bright);
  }
  void play() {
    const std::uint64_t i = clk.cycle() - 2;
    bright = clk.cycle() >= 2 && i < arrays_.size() ? arrays_[i] : std::uint16_t{0};
  }

  vp::Clock clk;
  vp::Signal<std::uint16_t> bright{"bright"};
  Stage stimuli{"stimuli", clk, [this] { play(); }};

 private:
  std::vector<std::uint16_t> arrays_;
};

struct ContiguityBench : BrightBench {
  // Eight in a row, the nine of the text, nine with a gap.
  ContiguityBench(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
      : BrightBench(name, scheduler, {0x00FF, 33023, 0x80FB}) {
    component.reads(bright);
    component.writes(contiguous);
  }
  vp::Signal<bool> contiguous{"contiguous"};
  Stage component{"component", clk, [this] { contiguous = pl::fast::contiguous(bright); }};
};

struct DirectionBench : BrightBench {
  // North, south, the east of the text, west.
  DirectionBench(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
      : BrightBench(name, scheduler, {0xF00F, 0x0FF0, 33023, 0xFF80}) {
    component.reads(bright);
    component.writes(dir);
  }
  vp::Signal<std::uint8_t> dir{"dir", 2};
  Stage component{"component", clk,
                  [this] { dir = static_cast<std::uint8_t>(pl::fast::direction(bright)); }};
};

struct StrengthBench : sc_core::sc_module {
  StrengthBench(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
      : sc_module(name), clk("clk", scheduler, clock_hz) {
    difference.written_by(stimuli);
    difference.read_by(component);
    component.writes(strength);
  }
  void play() {
    pl::fast::Thresholded values;
    if (clk.cycle() == 2)
      values = pl::fast::threshold(worked_circle(), point_level, corner_threshold);
    for (unsigned n = 0; n < 16; ++n) difference[n] = values.difference[n];
  }
  void evaluate() {
    std::array<std::uint8_t, 16> values;
    for (unsigned n = 0; n < 16; ++n) values[n] = difference[n];
    strength = static_cast<std::uint16_t>(pl::fast::strength(values));
  }

  vp::Clock clk;
  SignalArray<std::uint8_t> difference{"difference", 16};
  vp::Signal<std::uint16_t> strength{"strength", 12};
  Stage stimuli{"stimuli", clk, [this] { play(); }};
  Stage component{"component", clk, [this] { evaluate(); }};
};

}  // namespace

void trace_threshold_component(const std::filesystem::path& file) {
  trace<ThresholdBench>("threshold_component", file, 0, last_edge);
}
void trace_contiguity(const std::filesystem::path& file) {
  trace<ContiguityBench>("contiguity", file, 0, last_edge);
}
void trace_direction(const std::filesystem::path& file) {
  trace<DirectionBench>("direction", file, 0, last_edge);
}
void trace_strength(const std::filesystem::path& file) {
  trace<StrengthBench>("strength", file, 0, last_edge);
}

}  // namespace appendix_c
