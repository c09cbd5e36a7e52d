// The whole system with its PS software: the loop of `markervp run` without input files, pictures
// and result file.
//   --mode=upload   software uploads each image by DMA, as the thesis' system does (the usual one)
//   --mode=preload  the test bench puts it into the image memory
// Options such as --set=fidelity=clocked choose the platform.
#include <sys/resource.h>

#include <run/simulation.h>
#include <vp/configuration.h>
#include <stdexcept>

#include "frame_benchmark.h"
#include "images.h"

namespace {

using platform::Simulation;
using platform::input::InputFrame;
using platform::report::FrameReport;

vp::Configuration configuration_of(const bench::Arguments& arguments) {
  vp::Configuration configuration;
  for (const std::string& setting : arguments.settings) configuration.set(setting);
  if (arguments.mode == "preload") {
    configuration.set("sw.upload", "0");
  } else if (!arguments.mode.empty() && arguments.mode != "upload") {
    throw std::invalid_argument("no mode '" + arguments.mode + "'");
  }
  return configuration;
}

/// Frames for the simulation, and the timer: it runs from the first frame after the warm-up to the
/// one that is no longer given.
class Frames {
 public:
  Frames(benchmark::State& state, const std::string& image, platform::input::ImageSize size)
      : state_(state) {
    frame_.name = image;
    frame_.image = {size.width, size.height, bench::make_image(image)};
    frame_.camera = platform::Camera::for_resolution(size.width, size.height);
  }

  const InputFrame* next() {
    if (given_++ < bench::warm_up_frames) return &frame_;
    return state_.KeepRunning() ? &frame_ : nullptr;
  }

  bool take(FrameReport&& report) {
    if (taken_++ + 1 == bench::warm_up_frames) warm_ps_ = report.end_ps;
    last_ = std::move(report);
    return true;
  }

  void describe_last() const {
    const auto timed = static_cast<double>(taken_ - bench::warm_up_frames);
    state_.counters["simulated_ms"] = static_cast<double>(last_.end_ps - warm_ps_) / 1e9 / timed;
    state_.counters["feature_words"] = static_cast<double>(last_.counts["feature_words"]);
    state_.counters["marker"] = last_.markers.empty() ? -1.0 : last_.markers.front().id;
  }

 private:
  benchmark::State& state_;
  InputFrame frame_;
  int given_ = 0, taken_ = 0;
  std::uint64_t warm_ps_ = 0;  ///< simulated end of the warm-up
  FrameReport last_;
};

double peak_memory_mb() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
}

void measure(benchmark::State& state, const bench::Arguments& arguments) {
  vp::Configuration configuration = configuration_of(arguments);
  const vp::Configuration::Scope scope(configuration);
  Simulation simulation({BENCH_PROGRAM});
  configuration.check_unused();
  Frames frames(state, arguments.image, simulation.image_size());
  simulation.run([&] { return frames.next(); },
                 [&](FrameReport&& report) { return frames.take(std::move(report)); });
  frames.describe_last();
  state.counters["memory_mb"] = peak_memory_mb();
  state.SetLabel(simulation.facts().fidelity);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run_frames(argc, argv, "system", measure);
}
