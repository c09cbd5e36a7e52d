#pragma once

#include <cstdint>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <simulation.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/report.h>
#include <vp/signal.h>
#include <xilinx/v_tc/v_tc.h>

/// What tests of video share.
namespace video_bench {

/// Six pixels and three lines; the syncs take two clocks and two lines.
inline xilinx::VideoTiming small_timing() {
  xilinx::VideoTiming t;
  t.hactive = 6;
  t.htotal = 10;
  t.hsync_start = 7;
  t.hsync_end = 9;
  t.vactive = 3;
  t.vtotal = 6;
  t.vsync_start = 3;
  t.vsync_end = 4;
  t.vblank_hstart = t.vblank_hend = 6;
  t.vsync_hstart = t.vsync_hend = 7;
  return t;
}

/// A generator of it without registers.
inline xilinx::VTcBuild fixed_generator() {
  xilinx::VTcBuild build;
  build.has_axi4_lite = build.detect = false;
  build.timing = small_timing();
  return build;
}

/// Clocks of pixels and of a stream.
struct Bench : kit::Simulation {
  Bench() { reports.redirect(text); }
  bool said(const std::string& words) const { return text.str().find(words) != std::string::npos; }
  /// `clocks` of the pixel clock pass.
  void run(unsigned clocks) {
    sc_core::sc_start(sc_core::sc_time(20 * clocks, sc_core::SC_NS));
    scheduler.synchronise();
  }

  std::ostringstream text;
  vp::ReportRouter reports;
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock pixel_clk{"pixel_clk", scheduler, 50'000'000};
  vp::Clock aclk{"aclk", scheduler, 75'000'000};
};

/// Writes down a wire on each clock: '1' or '0'.
class Scope : public vp::Clocked {
 public:
  Scope(sc_core::sc_module_name name, vp::Clock& clock) : Clocked(name, clock) {}
  void look_at(vp::Signal<bool>& signal) {
    pins_.push_back(std::make_unique<vp::In<bool>>("pin", this));
    (*pins_.back())(signal);
    seen.emplace_back();
  }
  std::vector<std::string> seen;

 private:
  void edge() override {
    for (std::size_t i = 0; i < pins_.size(); ++i) seen[i] += pins_[i]->read() ? '1' : '0';
  }
  std::vector<std::unique_ptr<vp::In<bool>>> pins_;
};

inline std::string times(unsigned count, const std::string& text) {
  std::string all;
  for (unsigned i = 0; i < count; ++i) all += text;
  return all;
}

constexpr const char *line_active = "1111110000", *line_blank = "0000000000";

}  // namespace video_bench
