#pragma once

#include <marker/camera.h>
#include <marker/geometry.h>

#include <array>
#include <cstdint>

namespace marker {

struct PositOptions {
  double side = 0.30;         ///< the marker's side, m (thesis chapter 5)
  double stop = 2.0;          ///< px: done when the mean reprojection error is below (thesis 4.5.6)
  std::uint32_t limit = 100;  ///< iterations at most, the first step included (thesis 4.5.6)
};

/// Where the marker is: X = R·U + T (equation A.6), marker frame with its origin at the marker's
/// top left corner, u right, v down, w away from the viewer.
struct Pose {
  bool valid;                         ///< false: the corners admit no pose, everything else is zero
  std::array<double, 9> rotation;     ///< R, row by row
  std::array<double, 3> translation;  ///< T, m
  double reprojection_px;             ///< mean distance of the corners from their projections
  double reprojection_mm;             ///< the same measured at each corner's depth
  std::uint32_t iterations;           ///< steps of POSIT, the first included
};

/// Coplanar POSIT (Oberkampf, DeMenthon, Davis 1996; thesis 4.5.6, A.4) on the four corners of a
/// square marker, clockwise from the marker's own top left, in px (pixel index + 0.5).
///
/// The first iteration is POS itself; if its error is not good enough, both its solutions are
/// refined, step by step, until one is. The better pose found on the way is kept. A solution whose
/// error does not fall any more is not followed further (decision): corners that are 1.5 px off, as
/// of a marker rolled by 30°, start at 2.1 px, converge at 2.8 px and never come below 2 px, while
/// the thesis saw 1 to 2 iterations in all its tests.
Pose estimate_pose(const Quad& corners, const Camera& camera, const PositOptions& options);

}  // namespace marker
