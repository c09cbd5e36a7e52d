#pragma once

#include <marker/camera.h>
#include <marker/quad_fit.h>

#include <array>
#include <cstdint>

namespace marker {

/// The work of a fit, counted in one call.
struct FitEffort {
  std::uint64_t passes = 0, sides = 0, strips = 0, crossings = 0, level_pixels = 0;
  std::uint64_t transitions = 0, refitted = 0, level_reads = 0, corners = 0;
  std::uint32_t lens_steps = 0;

  void tell(bool in_dma_memory) const;
};

/// Between two corners of a quadrilateral, in ideal px.
struct Side {
  Point from, to, middle, along, outward;
  double length;
  double height;             ///< of the quadrilateral over this side, at its lower end
  bool by_rows;              ///< strips are rows: the side is nearer to upright; or columns
  bool dark_first;           ///< along them the dark side comes first
  double steepness;          ///< px across the edge for one px along a strip
  Point from_seen, to_seen;  ///< in the picture

  /// Of a corner, px from the middle.
  double place_of(Point corner) const;
};

/// Corners clockwise, in ideal px and in the picture. Side i leads from corner i to the next.
std::array<Side, 4> sides_of(const Quad& ideal, const Quad& seen);

/// A line near a side: outward = offset + slope · along.
struct EdgeLine {
  double offset, slope;
  double offset_variance, covariance, slope_variance;
  double scatter;     ///< px
  double transition;  ///< variance of the way from dark to bright, px²
  double dark, bright;
};

/// How a pass measures the sides.
struct FitPass {
  double reach, depth;         ///< px across the edge
  std::uint32_t crossings;     ///< of a side, at most
  std::uint32_t level_pixels;  ///< whose mean is a grey level, at most
  bool is_last;                ///< the transition is no longer needed
};

/// An edge is measured so many standard deviations of its transition to both sides, but not less
/// than the half pixel that every edge takes. Wider costs accuracy (each pixel adds its noise),
/// narrower makes the blur show.
inline constexpr double reach_in_deviations = 2.5;

/// A side with fewer crossings is not measured.
inline constexpr std::uint32_t least_crossings = 6;
/// Room for the crossings of a side.
inline constexpr std::uint32_t most_crossings = 256;

/// A straight line through the edge near side `which`.
///
/// The sum of the grey values of a strip across an edge says where the edge crosses it: exactly,
/// whatever the blur, as long as that is symmetric, since each pixel is a mean over its square. So
/// neither a model of the edge nor interpolation is needed. What it needs are the two grey levels,
/// which are read where a strip stays dark (bright) all the way. Crossings are freed from the lens,
/// the line is a least-squares fit, and its scatter says how well the line is known.
Refusal fit_side(const CameraFrame& frame, const std::array<Side, 4>& sides, unsigned which,
                 const FitPass& pass, const QuadFitOptions& options, FitEffort& effort,
                 EdgeLine& line);

}  // namespace marker
