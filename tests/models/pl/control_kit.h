#pragma once

#include <pl/control_block/control_block.h>

#include <vector>

#include "change_log.h"
#include "pipeline.h"

/// What tests of the control packet share: a pipeline that is ready for a frame of noise.
namespace control_kit {

using harness::Change;
using harness::Image;
using harness::Pipeline;
using harness::Word;
using Changes = std::vector<Change>;

namespace control_packet = pl::control_packet;

constexpr int width = 128, height = 64;
constexpr std::uint64_t pixels = width * height;

inline Image frame_image() {
  return harness::noise(width, height, 21);
}

inline std::vector<Word> fresh_words() {
  Pipeline pipeline({}, harness::frame_size(width, height));
  pipeline.load(frame_image());
  return pipeline.run_frame();
}

/// Everything ready for a frame; clock 1 is the next pixel-clock edge after raise_ena().
struct Ready : Pipeline {
  Ready() : Pipeline({}, harness::frame_size(width, height)) {
    load(frame_image());
    reset();
  }
  void control(std::uint32_t bits) { driver.control(bits); }
  void set_threshold(std::uint8_t level, std::uint32_t with = control_packet::wr_thresh) {
    control(with | std::uint32_t{level} << control_packet::threshold_shift);
  }
  unsigned threshold() const { return pl.global_threshold.active_threshold; }
  void finish() { run_to_clock(clocks_of_a_frame()); }

  harness::ChangeLog frame_ena{pl.sensor_input.frame_ena, scheduler};
};

}  // namespace control_kit
