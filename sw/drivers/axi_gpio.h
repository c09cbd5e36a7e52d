#pragma once

#include <hal/hal.h>

#include <cstdint>

namespace drivers {

struct AxiGpioConfig {
  std::uint32_t base;    ///< bus address
  std::uint32_t inputs;  ///< a 1 for each bit that is an input
};

/// Channel 1 of an AXI GPIO (PG144).
class AxiGpio {
 public:
  void initialise(const AxiGpioConfig& config);

  void write(std::uint32_t value) const;
  std::uint32_t read() const;

  /// Reads until the word differs from `previous` or `limit` reads were made; `cycles` CPU cycles a
  /// round.
  hal_poll_result poll_until_changed(std::uint32_t previous, std::uint32_t cycles,
                                     std::uint32_t limit) const;

 private:
  std::uint32_t base_;
};

}  // namespace drivers
