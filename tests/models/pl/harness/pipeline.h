#pragma once

#include <pl/feature_extraction/feature_extraction.h>
#include <simulation.h>
#include <vp/clock_scheduler.h>
#include <vp/configuration.h>

#include <cstdint>
#include <string>
#include <vector>

#include "driver.h"
#include "frames.h"
#include "stream.h"
#include "word.h"
#include "word_monitor.h"

namespace harness {

struct Clocks {
  std::uint64_t system_hz = 100'000'000;
  std::uint64_t pixel_hz = 50'000'000;
};

/// A configuration as `--set` gives it, in force while it lives.
class Settings {
 public:
  /// Assignments such as "pl.width=64 px".
  Settings(const std::vector<std::string>& assignments);

  vp::Configuration configuration;

 private:
  vp::Configuration::Scope scope_{configuration};
};

/// The fidelity under test: MARKERVP_TEST_FIDELITY in the environment, "clocked" or "tlm" (clocked
/// if it is not set). The test programs run once with each.
pl::Fidelity fidelity_under_test();

/// The feature extraction alone, with a driver in the place of the PS.
class Pipeline : public kit::Simulation {
 public:
  explicit Pipeline(Clocks clocks = {}, const std::vector<std::string>& settings = {});

  /// Puts an image into the BRAM.
  void load(const Image& image);
  /// A whole frame, until its end word was read. Returns the words that left the detectors, in the
  /// order of their clocks.
  std::vector<Word> run_frame();

  // Step by step, without the driver's process:
  /// Everything up to and including the time `ps`.
  void run_to(std::uint64_t ps);
  /// Everything up to and including pixel clock `n` of the frame.
  void run_to_clock(std::uint64_t n) { run_to(monitor.time_of(n)); }
  /// Everything for so long from now on.
  void run_for(std::uint64_t ps) { run_to(kit::now_ps() + ps); }
  /// Pulses rst, with `held` besides it and on.
  void reset(std::uint32_t held = 0);
  /// Raises ena now: the next pixel-clock edge is clock 1.
  void raise_ena();
  /// The frame's words so far, in the order of their clocks.
  std::vector<Word> words() const;
  /// Number of pixel clocks until the one in which `busy` falls after a frame, and some.
  std::uint64_t clocks_of_a_frame() const { return pl.geometry().pixels() + 200; }

 private:
  Settings settings_;

 public:
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock fclk_clk0;
  vp::Clock fclk_clk1;
  pl::FeatureExtraction pl{"pl", fclk_clk0, fclk_clk1, fidelity_under_test()};
  vp::AxiStream image_link{"image_link"};
  vp::AxiStream binary_link{"binary_link"};
  StreamSource source{"source", fclk_clk0};
  StreamSink sink{"sink", fclk_clk0};
  WordMonitor monitor{"monitor", fclk_clk1, pl};
  Driver driver{"driver", scheduler, monitor, pl.feature()};
};

/// "pl.width=W px" and "pl.height=H px".
std::vector<std::string> frame_size(int width, int height);

}  // namespace harness
