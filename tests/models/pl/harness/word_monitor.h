#pragma once

#include <pl/feature_extraction/feature_extraction.h>
#include <vp/clock.h>

#include <cstdint>
#include <vector>

#include "word.h"

namespace harness {

/// Notes the words that leave the detectors. It sees a register on the edge after the one at which
/// it changed.
class WordMonitor : public vp::Clocked {
 public:
  WordMonitor(sc_core::sc_module_name name, vp::Clock& pixel_clk, pl::FeatureExtraction& pl);

  /// The next pixel-clock edge is clock 1. Forgets the words so far.
  void start();
  /// Pixel clocks since start().
  std::uint64_t clock_number() const { return clock().cycle() - base_; }
  /// Time of clock `n` in ps, if the frequency stays.
  std::uint64_t time_of(std::uint64_t n) const { return clock().time_of(base_ + n); }

  std::vector<Word> words;

 private:
  void edge() override;

  vp::In<bool> corner_out_{"corner_out", this}, blob_out_{"blob_out", this},
      thresh_out_{"thresh_out", this};
  vp::In<std::uint32_t> corner_{"corner", this}, start_{"start", this}, end_{"end", this},
      thresh_{"thresh", this};
  std::uint64_t base_ = 0;
};

}  // namespace harness
