#pragma once

#include <marker/camera.h>
#include <marker/optics.h>
#include <marker/quad_fit.h>

#include <cstdint>

namespace marker {

/// How far from a guess an edge is looked for.
enum class FirstReach : std::uint32_t {
  wide,    ///< as find_quad() does
  narrow,  ///< so that a neighbour two pixels away is not seen
};

// As guess_quad(), find_quad() and refine_quad() of quad_fit.h, for frames with optics: through any
// lens, and the last one in light.

/// `smallest_cell`: px; with smaller ones the guess is refused (`shape`).
QuadFit guess_through_optics(const CameraFrame& frame, const Quad& corners,
                             const QuadFitOptions& options, double smallest_cell = least_cell);
void find_through_optics(const CameraFrame& frame, const QuadFitOptions& options, FirstReach reach,
                         QuadFit& fit);

/// The light on both sides of a marker's edges, mean of the four, 0 to white_light.
struct LightLevels {
  double dark, bright;
};

/// Whether a fit's corners are where grey levels have them, or light.
enum class FoundIn : std::uint32_t { levels, light };

/// The covariance has what all sides share: `Optics::common_shift`. `dark` and `bright` of the fit
/// stay what was found before.
LightLevels refine_through_optics(const CameraFrame& frame, const QuadFitOptions& options,
                                  FoundIn place, QuadFit& fit);

}  // namespace marker
