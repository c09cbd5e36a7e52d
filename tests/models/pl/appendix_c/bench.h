#pragma once

#include <simulation.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/probe.h>
#include <vp/signal.h>
#include <vp/trace.h>

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace appendix_c {

/// The pixel clock.
constexpr std::uint64_t clock_hz = 50'000'000;
constexpr std::uint64_t period_ps = 20'000;

/// A register stage: a function that runs on each edge, reads signals and writes signals.
class Stage : public vp::Clocked {
 public:
  Stage(sc_core::sc_module_name name, vp::Clock& clk, std::function<void()> work)
      : Clocked(name, clk), work_(std::move(work)) {}

  /// Tells the scheduler that the function reads this signal, so that it sees what stood before.
  template <class T>
  void reads(vp::Signal<T>& signal) {
    auto port = std::make_shared<vp::In<T>>(signal.basename(), this);
    port->bind(signal);
    ports_.push_back(port);
  }
  template <class T>
  void writes(vp::Signal<T>& signal) {
    signal.set_writer(*this);
  }

 private:
  void edge() override { work_(); }

  std::function<void()> work_;
  std::vector<std::shared_ptr<void>> ports_;
};

/// Signals NAME_0, NAME_1 …
template <class T>
class SignalArray {
 public:
  SignalArray(const std::string& name, std::size_t count, unsigned width = vp::default_width<T>()) {
    for (std::size_t i = 0; i < count; ++i) {
      signals_.push_back(
          std::make_unique<vp::Signal<T>>((name + "_" + std::to_string(i)).c_str(), width));
    }
  }
  vp::Signal<T>& operator[](std::size_t i) { return *signals_[i]; }
  std::size_t size() const { return signals_.size(); }
  void read_by(Stage& stage) {
    for (auto& signal : signals_) stage.reads(*signal);
  }
  void written_by(Stage& stage) {
    for (auto& signal : signals_) stage.writes(*signal);
  }

 private:
  std::vector<std::unique_ptr<vp::Signal<T>>> signals_;
};

/// Plays an image into a detector, one pixel a clock as the sensor input does: pixel i is there
/// from edge i + 1 on.
template <class Pixel>
class RasterSource : public vp::Clocked {
 public:
  RasterSource(sc_core::sc_module_name name, vp::Clock& clk, std::vector<Pixel> image,
               std::uint16_t width)
      : Clocked(name, clk), image_(std::move(image)), width_(width) {}

  vp::Signal<bool> ena{"ena"};
  vp::Signal<Pixel> pixel{"pixel"};
  vp::Signal<std::uint16_t> x{"x", 10};
  vp::Signal<std::uint16_t> y{"y", 9};

 private:
  void edge() override {
    ena = next_ < image_.size();
    if (next_ == image_.size()) {
      sleep();
      return;
    }
    pixel = image_[next_];
    x = static_cast<std::uint16_t>(next_ % width_);
    y = static_cast<std::uint16_t>(next_ / width_);
    ++next_;
  }

  std::vector<Pixel> image_;
  std::uint16_t width_;
  std::size_t next_ = 0;
};

/// Runs a bench called `name` and traces everything in it from edge `from` to edge `to`.
template <class Bench>
void trace(const std::string& name, const std::filesystem::path& file, std::uint64_t from,
           std::uint64_t to) {
  kit::Simulation simulation;
  vp::ClockScheduler scheduler{"scheduler"};
  Bench bench(name.c_str(), scheduler);
  vp::TraceOptions options;
  options.file = file;
  options.level = vp::TraceLevel::registers;
  options.clocks = true;
  options.from_ps = from * period_ps;
  options.to_ps = to * period_ps;
  vp::Tracer tracer{"tracer", scheduler, options};
  sc_core::sc_start(vp::from_ps(options.to_ps + period_ps));
  tracer.close();
}

}  // namespace appendix_c
