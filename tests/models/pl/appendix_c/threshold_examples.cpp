// C.6 and C.7: the global threshold module with its histogram.
#include "threshold_examples.h"

#include <pl/global_threshold/global_threshold.h>

#include "bench.h"

namespace appendix_c {

namespace {

/// The module, and the pixels of a short frame that begins on the fourth edge.
struct ThresholdModuleBench : sc_core::sc_module {
  ThresholdModuleBench(sc_core::sc_module_name name, vp::ClockScheduler& scheduler,
                       std::vector<std::uint8_t> frame, std::uint8_t level)
      : sc_module(name), clk("clk", scheduler, clock_hz), frame_(std::move(frame)), level_(level) {
    for (vp::Signal<bool>* wire : {&por, &rst, &frame_ena, &wr_thresh}) stimuli.writes(*wire);
    stimuli.writes(threshold);
    stimuli.writes(pixel);
    stimuli.writes(x);
    global_threshold.por(por);
    global_threshold.rst(rst);
    global_threshold.frame_ena(frame_ena);
    global_threshold.wr_thresh(wr_thresh);
    global_threshold.threshold(threshold);
    global_threshold.pixel(pixel);
    global_threshold.x(x);
    global_threshold.y(y);
  }
  void play() {
    const std::uint64_t i = clk.cycle() - 4;
    wr_thresh = level_ != 0 && clk.cycle() == 2;
    threshold = wr_thresh.written() ? level_ : std::uint8_t{0};
    frame_ena = clk.cycle() >= 4 && i < frame_.size();
    if (!frame_ena.written()) return;
    pixel = frame_[i];
    x = static_cast<std::uint16_t>(i);
  }

  vp::Clock clk;
  vp::Signal<bool> por{"por"}, rst{"rst"}, frame_ena{"frame_ena"}, wr_thresh{"wr_thresh"};
  vp::Signal<std::uint8_t> threshold{"threshold"};
  vp::Signal<std::uint8_t> pixel{"pixel"};
  vp::Signal<std::uint16_t> x{"x", 10}, y{"y", 9};
  Stage stimuli{"stimuli", clk, [this] { play(); }};
  pl::GlobalThresholdClocked global_threshold{"global_threshold", {clk, {}}};

 private:
  std::vector<std::uint8_t> frame_;
  std::uint8_t level_;
};

struct PixelThresholdBench : ThresholdModuleBench {
  // Threshold 100; fifteen pixels of 80 and one of 150 came before the one that is looked at.
  PixelThresholdBench(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
      : ThresholdModuleBench(name, scheduler, frame(), 100) {}
  static std::vector<std::uint8_t> frame() {
    return {80, 80, 80, 80, 80, 80, 80, 80, 80, 80, 80, 80, 80, 80, 80, 150, 80, 150, 100, 101};
  }
  vp::Probe<std::uint32_t> histogram_80{
      "histogram_80", [this] { return global_threshold.core().histogram(80); }, 19};
};

struct NextThresholdBench : ThresholdModuleBench {
  NextThresholdBench(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
      : ThresholdModuleBench(name, scheduler,
                             {60, 60, 200, 79, 178, 79, 178, 200, 79, 178, 178, 79, 230}, 0) {}
  vp::Probe<std::uint8_t> black_peak{"black_peak",
                                     [this] { return global_threshold.core().dark_peak(); }};
  vp::Probe<std::uint8_t> white_peak{"white_peak",
                                     [this] { return global_threshold.core().bright_peak(); }};
  vp::Probe<std::uint8_t> next_threshold{"next_threshold", [this] {
                                           const unsigned sum =
                                               global_threshold.core().dark_peak() +
                                               global_threshold.core().bright_peak();
                                           return static_cast<std::uint8_t>(sum / 2);
                                         }};
};

}  // namespace

void trace_pixel_threshold(const std::filesystem::path& file) {
  trace<PixelThresholdBench>("pixel_threshold", file, 0, 28);
}
void trace_next_threshold(const std::filesystem::path& file) {
  trace<NextThresholdBench>("next_threshold", file, 0, 22);
}

}  // namespace appendix_c
