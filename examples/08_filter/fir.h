#pragma once

#include <hal/hal.h>

#include <cstdint>

/// What the FIR filter and its PS program agree on.
namespace fir {

constexpr std::uint32_t block_words = 64;
constexpr std::uint32_t dma_in = 0x4040'0000, dma_out = 0x4041'0000;

/// The filter: y[n] = gain · (x[n] + 3 x[n-1] + 3 x[n-2] + x[n-3]), modulo 2³².
class Filter {
 public:
  std::uint32_t next(std::uint32_t sample, std::uint32_t gain) {
    const std::uint32_t sum = sample + 3 * past_[0] + 3 * past_[1] + past_[2];
    past_[2] = past_[1];
    past_[1] = past_[0];
    past_[0] = sample;
    return gain * sum;
  }

 private:
  std::uint32_t past_[3] = {0, 0, 0};
};

constexpr std::uint32_t result_kind = HAL_KIND('F', 'I', 'R', '1');

/// What the program publishes of a block.
struct Result {
  std::uint32_t index;   ///< hal_frame::index
  std::uint32_t words;   ///< that came back
  std::uint32_t wrong;   ///< of them
  std::uint32_t peak;    ///< the largest
  std::uint64_t cycles;  ///< of the program on the block, pairs of CPU cycles
};

}  // namespace fir
