#pragma once

#include <cstdint>

#include <validation/measured.h>

namespace platform::validation {

/// Run-to-run deviation of the thesis' measurements (5.2), us: of all PS functions of a frame
/// together, and of the PL.
///
/// The thesis names no function; one deviation of 20 us for each is not possible, as its 15 means
/// of the pose estimation deviate by 0.21 us. So a frame has one (assumed), and each PS stage the
/// part of it that it has of the PS time.
inline constexpr double ps_jitter_us = 20;
inline constexpr double pl_jitter_us = 1;

/// The run with every time the mean of so many measurements with jitter; the platform itself takes
/// the same time in each. Equal for equal arguments on any host. The time in which an image is
/// captured has none: the thesis adds a constant.
Run repeated(const Run& run, std::uint32_t repetitions);

}  // namespace platform::validation
