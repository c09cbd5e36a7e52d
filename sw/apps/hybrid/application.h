#pragma once

#include <cstdint>

#include <apps/common/search.h>
#include <apps/hybrid/pl_link.h>
#include <hal/hal.h>
#include <marker/result.h>
#include <marker_logic.h>

/// X(name, unit, default, minimum, maximum, documentation). The order is that of
/// hal_program.options.
#define HYBRID_OPTIONS(X)                                                                     \
  SEARCH_OPTIONS(X)                                                                           \
  X(upload, "", 1, 0, 1,                                                                      \
    "1: the image goes to the image store through DMA 0; 0: it is there already, as from a "  \
    "camera on the PL (decision)")                                                            \
  X(burst_words, "", marker_logic::usual_burst_words, marker_logic::min_burst_words,          \
    marker_logic::max_burst_words,                                                            \
    "words of a DMA transfer; on the platform those of the logic's packets (pl.burst_words)") \
  X(timeout, "ms", 1000, 0.1, 1000000,                                                        \
    "longest time for an upload, and from ena to the end word (decision)")                    \
  X(binary_timeout, "ms", 10, 0.001, 1000000,                                                 \
    "longest wait for the binary image after the end word (decision)")

namespace hybrid {

/// The options as values in the units above.
struct Options : apps::SearchOptions {
  bool upload;
  std::uint32_t burst_words;
  double timeout;
  double binary_timeout;
};

/// For hal_program.options.
extern const hal_option_info option_table[];
extern const std::uint32_t option_count;

/// What the run asks for.
Options read_options();

/// The PS side of the thesis' marker detection system (figure 4.22).
class Application {
 public:
  /// Works on all frames of the run. 0: every frame went well; 1: some did not, the console says
  /// which and why.
  int run();

 private:
  bool initialise();
  void process(const hal_frame& frame);
  marker::Status receive(const hal_frame& frame);
  marker::Status admit(const hal_frame& frame);
  void reserve(std::uint32_t bytes);
  void find_marker(const hal_frame& frame);
  void report(marker::Status status) const;
  std::uint64_t counts(double milliseconds) const;

  PlLink link_;
  Options options_;
  hal_dma_buffer binary_;
  bool recovery_due_;
  marker::WordStore words_;
  marker::FrameResult result_;
};

}  // namespace hybrid
