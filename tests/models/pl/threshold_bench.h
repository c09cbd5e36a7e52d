#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include <pl/global_threshold/global_threshold.h>
#include <simulation.h>
#include <vp/clock_scheduler.h>

#include "pipeline.h"

namespace harness {

/// What the ports of a threshold see.
struct Script {
  std::map<std::uint64_t, Image> frames;  ///< by the edge on which the first pixel leaves
  std::map<std::uint64_t, int> loads;     ///< wr_thresh from this edge on; -1: no more
  std::map<std::uint64_t, bool> rst, por;
  std::uint64_t end = 0;
};

class Source final : public vp::Clocked {
 public:
  Source(sc_core::sc_module_name name, vp::Clock& clk, const Script& script,
         const pl::Geometry& geometry)
      : Clocked(name, clk),
        more_pixels("pixel", geometry.pixels_per_clock),
        script_(script),
        geometry_(geometry) {}

  vp::Signal<bool> rst{"rst"}, por{"por"}, frame_ena{"frame_ena"}, wr_thresh{"wr_thresh"};
  vp::Signal<std::uint8_t> threshold{"threshold"}, pixel{"pixel"};
  pl::Lanes<vp::Signal<std::uint8_t>> more_pixels;
  vp::Signal<std::uint16_t> x{"x"}, y{"y"};
  pl::GreyFrames frames{"frames", clock()};

 private:
  void edge() override {
    const std::uint64_t cycle = clock().cycle();
    if (const auto at = script_.frames.find(cycle); at != script_.frames.end()) {
      image_ = at->second;
      next_ = 0;
      running_ = true;
      frames.announce();
      frames.begin(image_.data(), geometry_.pixels(), cycle, geometry_.pixels_per_clock);
    }
    if (const auto at = script_.loads.find(cycle); at != script_.loads.end()) {
      wr_thresh = at->second >= 0;
      if (at->second >= 0) threshold = static_cast<std::uint8_t>(at->second);
    }
    set(rst, script_.rst);
    set(por, script_.por);
    frame_ena = running_;
    if (!running_) return;
    pixel = image_[next_];
    for (std::size_t lane = 0; lane < more_pixels.size(); ++lane)
      more_pixels[lane] = image_[next_ + 1 + lane];
    x = static_cast<std::uint16_t>(next_ % geometry_.width);
    y = static_cast<std::uint16_t>(next_ / geometry_.width);
    next_ += geometry_.pixels_per_clock;
    running_ = next_ < geometry_.pixels();
  }
  void set(vp::Signal<bool>& signal, const std::map<std::uint64_t, bool>& changes) {
    const auto at = changes.find(clock().cycle());
    if (at == changes.end()) return;
    signal = at->second;
    if (!at->second) return;
    running_ = false;
    frames.cut();
  }

  const Script& script_;
  const pl::Geometry geometry_;
  Image image_;
  std::uint32_t next_ = 0;
  bool running_ = false;
};

/// A threshold of any rule on the ports of Global Threshold, 125 MHz.
struct ThresholdBench : kit::Simulation {
  ThresholdBench(const pl::Models<pl::GlobalThreshold>& models, const std::string& model,
                 const pl::Geometry& geometry, const Script& script,
                 const std::vector<std::string>& assignments = {})
      : settings(assignments), script(script), source("source", clk, script, geometry) {
    for (const auto& candidate : models.list()) {
      if (candidate.name == model) ip = candidate.make(models.ip().c_str(), {clk, geometry});
    }
    ip->por(source.por);
    ip->rst(source.rst);
    ip->frame_ena(source.frame_ena);
    ip->wr_thresh(source.wr_thresh);
    ip->threshold(source.threshold);
    ip->pixel(source.pixel);
    ip->more_pixels(source.more_pixels);
    ip->x(source.x);
    ip->y(source.y);
    if (model == "tlm") ip->frames(source.frames);
  }
  void run() { sc_core::sc_start(vp::from_ps(clk.time_of(script.end) + 1)); }

  Settings settings;
  const Script& script;
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clk{"clk", scheduler, 125'000'000};
  Source source;
  std::unique_ptr<pl::GlobalThreshold> ip;
};

}  // namespace harness
