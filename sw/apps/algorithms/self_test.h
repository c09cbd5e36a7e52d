#pragma once

#include <apps/algorithms/golden_words.h>
#include <marker/result.h>

#include <cstdint>

namespace algorithms {

/// Runs everything of sw/marker on one golden frame and prints all that it computed: counts and
/// indices decimal, doubles as the 16 hexadecimal digits of their bits. Two machines compute the
/// same if they print the same.
class SelfTest {
 public:
  /// False, and said so on the console, if there is no memory or the text is no golden frame.
  bool run(const GoldenText& text);

 private:
  bool prepare();
  void print_features() const;
  void print_candidate(std::uint32_t index) const;
  void print_marker() const;

  hal_dma_buffer binary_{};
  marker::WordStore words_;
  marker::FeatureSet features_;
  marker::CandidateList candidates_;
};

}  // namespace algorithms
