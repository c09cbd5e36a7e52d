#pragma once

#include <hal/hal.h>

#include <cstdint>

/// What the design of brightness_design.cpp and its program agree on.
namespace brightness {

inline constexpr std::uint32_t kind = HAL_KIND('B', 'R', 'T', '1');

struct Result {
  std::uint32_t frame, bright, lost;
};

}  // namespace brightness
