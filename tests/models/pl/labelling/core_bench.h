#pragma once

#include <pl/blob_labelling/run_labeller.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "random_pictures.h"

namespace labelling {

/// A core that is fed, as many pixels a clock as the geometry says, and what came out of it.
class CoreBench {
 public:
  CoreBench(const pl::Geometry& g, std::unique_ptr<pl::RunLabeller> made)
      : geometry(g), made_(std::move(made)), core(*made_) {}
  virtual ~CoreBench() = default;

  void clock(bool ena, std::uint32_t dark = 0, std::uint32_t index = 0) {
    core.clock(ena, dark, index % geometry.width, index / geometry.width);
    ++clocks;
    if (core.shows()) {
      shown.push_back(core.shown());
      shown_at.push_back(clocks);
    }
  }
  /// Pixels of a frame, up to `count` of them.
  void feed(const Binary& picture, std::uint32_t count) {
    const std::uint32_t pixels = geometry.pixels_per_clock;
    kept = picture;
    for (std::uint32_t i = 0; i < count; i += pixels) {
      clock(true, group_at(picture, i, pixels), i);
      note_losses(i);
    }
  }
  void drain() {
    do clock(false);
    while (!core.idle());
  }
  /// A frame, and what is shown of it, sorted.
  std::vector<pl::Extremes> run(const Binary& picture) {
    shown.clear();
    shown_at.clear();
    clocks = 0;
    feed(picture, picture.count());
    for (std::uint32_t i = picture.count(); !core.ready() || !core.idle();
         i += geometry.pixels_per_clock) {
      clock(false);
      note_losses(i);
    }
    std::vector<pl::Extremes> sorted = shown;
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  }
  /// Whether every picture of this size gives what a flood fill gives.
  void check_all_pictures() {
    Binary picture{geometry.width, geometry.height, std::vector<std::uint8_t>(geometry.pixels())};
    std::uint32_t wrong = 0;
    for (std::uint32_t pattern = 0; pattern < 1u << picture.count(); ++pattern) {
      for (std::uint32_t i = 0; i < picture.count(); ++i) picture.pixels[i] = pattern >> i & 1;
      wrong += run(picture) != flood_fill(picture);
    }
    BOOST_TEST(wrong == 0u);
  }

  const pl::Geometry geometry;

 private:
  const std::unique_ptr<pl::RunLabeller> made_;

 public:
  pl::RunLabeller& core;
  std::vector<pl::Extremes> shown;
  std::vector<std::uint64_t> shown_at;
  std::uint64_t clocks = 0;
  Binary kept;  ///< the last picture without what was lost
  std::uint32_t overflow = 0;

 private:
  /// Runs that got lost in the clock that took the pixels from raster index `now` on, or would
  /// have, are bright in `kept`.
  virtual void note_losses(std::uint32_t now) = 0;
};

inline bool equal(const std::vector<pl::Extremes>& found,
                  const std::vector<pl::Extremes>& expected) {
  return found == expected;
}

}  // namespace labelling
