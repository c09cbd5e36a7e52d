// The whole system with its PS software: the loop of `markervp run` without input files, pictures
// and result file.
//   --mode=upload   software uploads each image by DMA, as the thesis' system does (the usual one)
//   --mode=preload  the test bench puts it into the image memory; it is the camera of a design that
//   has one
//   --mode=alone    the RTL that --set=pl.fidelity.<ip>=FILE names, without platform, with the
//   values that its pins had in a frame of `preload`
// Options such as --set=fidelity=clocked choose the platform.
#include <dlfcn.h>
#include <stdlib.h>
#include <sys/resource.h>

#include <chip/run/simulation.h>
#include <vp/configuration.h>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "frame_benchmark.h"
#include "images.h"
#include "rtl/recorder.h"

namespace {

using platform::Simulation;
using platform::facts::UnitReport;
using platform::input::InputFrame;
using platform::input::SharedFrame;

vp::Configuration configuration_of(const bench::Arguments& arguments) {
  vp::Configuration configuration;
  for (const std::string& setting : arguments.settings) configuration.set(setting);
  if (arguments.mode == "preload") {
    if (!configuration.find("design")) configuration.set("sw.upload", "0");
  } else if (!arguments.mode.empty() && arguments.mode != "upload") {
    throw std::invalid_argument("no mode '" + arguments.mode + "'");
  }
  return configuration;
}

SharedFrame frame_of(const std::string& image, platform::input::ImageSize size) {
  InputFrame frame;
  frame.name = image;
  frame.image = {size.width, size.height, bench::make_image(image)};
  frame.camera = platform::Camera::for_resolution(size.width, size.height);
  return std::make_shared<InputFrame>(std::move(frame));
}

/// Frames for the simulation, and the timer: it runs from the first frame after the warm-up to the
/// one that is no longer given.
class Frames {
 public:
  Frames(benchmark::State& state, const std::string& image, platform::input::ImageSize size)
      : state_(state), frame_(frame_of(image, size)) {}

  SharedFrame next() {
    if (given_++ < bench::warm_up_frames) return frame_;
    return state_.KeepRunning() ? frame_ : nullptr;
  }

  bool take(UnitReport&& report) {
    if (taken_++ + 1 == bench::warm_up_frames) warm_ps_ = report.end_ps;
    last_ = std::move(report);
    return true;
  }

  void describe_last() const {
    const auto timed = static_cast<double>(taken_ - bench::warm_up_frames);
    state_.counters["simulated_ms"] = static_cast<double>(last_.end_ps - warm_ps_) / 1e9 / timed;
    state_.counters["feature_words"] = static_cast<double>(last_.counts["feature_words"]);
    const auto& markers = platform::marker_frame(last_).markers;
    state_.counters["marker"] = markers.empty() ? -1.0 : markers.front().id;
  }

 private:
  benchmark::State& state_;
  const SharedFrame frame_;
  int given_ = 0, taken_ = 0;
  std::uint64_t warm_ps_ = 0;  ///< simulated end of the warm-up
  UnitReport last_;
};

double peak_memory_mb() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
}

/// The settings with the recorder in the place of the RTL that it is to watch.
bench::Arguments with_recorder(bench::Arguments arguments) {
  arguments.mode = "preload";
  for (std::string& setting : arguments.settings) {
    const std::size_t equals = setting.find('=');
    if (setting.rfind("pl.fidelity.", 0) != 0 || setting.find(".so", equals) == std::string::npos)
      continue;
    ::setenv("BENCH_RTL", setting.c_str() + equals + 1, 1);
    setting.replace(equals + 1, std::string::npos, BENCH_RECORDER);
    return arguments;
  }
  throw std::invalid_argument("--mode=alone: --set=pl.fidelity.<ip>=FILE.so says which RTL");
}

bench::Recording& recording() {
  void* library = ::dlopen(BENCH_RECORDER, RTLD_NOW | RTLD_LOCAL);
  void* symbol = library ? ::dlsym(library, "bench_recording") : nullptr;
  if (!symbol) throw std::runtime_error(::dlerror());
  return *reinterpret_cast<bench::Recording* (*)()>(symbol)();
}

/// Plays recorded evaluations to RTL of its own: what any driver of Verilated RTL does.
class Replay {
 public:
  explicit Replay(const bench::Recording& recording)
      : recording_(recording), model_(recording.rtl->create("alone", 0), recording.rtl->destroy) {
    for (const bench::Recording::Input& input : recording.inputs) {
      pins_.push_back({recording.rtl->pin(model_.get(), input.port), input.bytes});
      bytes_ += input.bytes;
    }
  }

  void play(std::size_t begin, std::size_t end) {
    const unsigned char* from = recording_.stimulus.data() + begin * bytes_;
    for (std::size_t i = begin; i < end; ++i) {
      for (const Pin& pin : pins_) {
        copy(pin, from);
        from += pin.bytes;
      }
      recording_.rtl->eval(model_.get());
    }
  }

 private:
  struct Pin {
    void* place;
    std::size_t bytes;
  };
  static void copy(const Pin& pin, const unsigned char* from) {
    switch (pin.bytes) {
      case 1:
        std::memcpy(pin.place, from, 1);
        break;
      case 2:
        std::memcpy(pin.place, from, 2);
        break;
      case 4:
        std::memcpy(pin.place, from, 4);
        break;
      default:
        std::memcpy(pin.place, from, 8);
    }
  }

  const bench::Recording& recording_;
  const std::unique_ptr<void, void (*)(void*)> model_;
  std::vector<Pin> pins_;
  std::size_t bytes_ = 0;
};

void measure_alone(benchmark::State& state, const bench::Arguments& arguments) {
  vp::Configuration configuration = configuration_of(with_recorder(arguments));
  const vp::Configuration::Scope scope(configuration);
  Simulation simulation(platform::SimulationOptions{});
  configuration.check_unused();
  const SharedFrame frame =
      frame_of(arguments.image, platform::input::image_size(simulation.input()));
  bench::Recording& noted = recording();
  int given = 0;
  std::size_t begin = 0, end = 0;
  const auto next = [&]() -> SharedFrame {
    begin = std::exchange(end, noted.evaluations);  // from one image to the next
    return given++ <= bench::warm_up_frames ? frame : nullptr;
  };
  simulation.run(next, [](UnitReport&&) { return true; });
  Replay replay(noted);
  replay.play(0, begin);
  for (auto _ : state) replay.play(begin, end);
  state.counters["evaluations"] = static_cast<double>(end - begin);
}

void measure(benchmark::State& state, const bench::Arguments& arguments) {
  if (arguments.mode == "alone") return measure_alone(state, arguments);
  vp::Configuration configuration = configuration_of(arguments);
  const vp::Configuration::Scope scope(configuration);
  Simulation simulation(platform::SimulationOptions{});
  configuration.check_unused();
  Frames frames(state, arguments.image, platform::input::image_size(simulation.input()));
  simulation.run([&] { return frames.next(); },
                 [&](UnitReport&& report) { return frames.take(std::move(report)); });
  frames.describe_last();
  state.counters["memory_mb"] = peak_memory_mb();
  state.SetLabel(simulation.facts().fidelity);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run_frames(argc, argv, "system", measure);
}
