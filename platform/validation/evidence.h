#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <scene/grey_image.h>
#include <validation/measured.h>

/// What the frames say about the published values that cannot be met.

namespace platform::validation {

/// The increased-feature test with its squares added in another order: the same stage times, but
/// other squares examined before the marker.
struct OrderStudy {
  std::size_t orders = 0;          ///< that differ in when squares come before the marker
  std::size_t identification = 0;  ///< of them meet the published mean identification time
  std::size_t speedup = 0;         ///< meet the published mean speed-up
  std::size_t both = 0;
  double least_ms = 0, most_ms = 0;            ///< mean identification time, hybrid
  double least_speedup = 0, most_speedup = 0;  ///< mean speed-up
};

/// None without the increased-feature test. `band`: %.
std::optional<OrderStudy> study_orders(const Measured& measured, double published_ms,
                                       double published_speedup, double band);

/// The turned pictures: what the published speed-up asks of the PS-only corner detection.
struct TurnStudy {
  double asked_ms = 0;      ///< mean PS-only frame time for the published speed-up
  double lacking_ms = 0;    ///< above the modelled one
  double excess_ms = 0;     ///< mean time of turned pictures above upright ones, corner detection
  double factor = 0;        ///< by which that excess had to grow
  double growth = 0;        ///< what corner.growth.ps would then be
  double deviation_ms = 0;  ///< and the deviation of the corner detection over 15 images
};

std::optional<TurnStudy> study_turns(const Measured& measured, double published_speedup);

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

/// What an image asks of software, counted in the image itself (figures 5.39 and 5.43).
struct ImageWork {
  std::uint64_t dark = 0;       ///< pixels at or below the frame's threshold
  std::uint64_t evaluated = 0;  ///< pixels that pass the pre-test of FAST
};

std::uint64_t count_dark(const GreyImage& image, std::uint32_t threshold);

/// Pixels with two adjacent of their four compass pixels at distance 3 brighter by more than
/// `threshold`.
std::uint64_t count_evaluated(const GreyImage& image, int threshold);

/// Of these frames, rendered anew.
std::vector<ImageWork> image_work(const std::vector<const Frame*>& frames, int corner_threshold);

}  // namespace platform::validation
