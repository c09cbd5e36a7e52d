#pragma once

#include <cstddef>
#include <optional>

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

}  // namespace platform::validation
