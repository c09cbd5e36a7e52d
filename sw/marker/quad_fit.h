#pragma once

#include <marker/camera.h>
#include <marker/geometry.h>
#include <marker/images.h>

#include <array>
#include <cstdint>

namespace marker {

/// A pixel by its indices, less than 8192.
struct Pixel {
  std::int32_t x, y;
};

/// The outermost pixels of a blob, clockwise: least y, greatest x − y, greatest x, greatest x + y,
/// greatest y, least x − y, least x, least x + y.
using Extremes = std::array<Pixel, 8>;

/// The four extremes that span the largest area, clockwise, where their pixels end. A corner of up
/// to 135° is the outermost point in at least one of the eight directions, however the marker is
/// rolled, and any other choice cuts area off. False if no four make a convex quadrilateral.
bool largest_quad(const Extremes& extremes, Quad& quad);

/// The edges of a marker with smaller cells cannot be measured, px.
inline constexpr double least_cell = 1.5;

struct QuadFitOptions {
  std::uint32_t cells = 6;          ///< of the marker's side; the outermost are black
  double minimum_contrast = 20;     ///< grey levels between the sides of an edge
  double maximum_raggedness = 0.4;  ///< px: deviation of a side's edge points from its line
  double minimum_coverage = 0.5;    ///< share of a side on which the edge must be seen
  std::uint32_t crossings = 256;    ///< of a side that are measured, 16 to 256: time for accuracy
  double noisy = 0.06;              ///< px: sides that deviate by more are measured once more
};

/// Why a candidate is no marker, or `none`.
enum class Refusal : std::uint32_t {
  none = 0,
  shape,     ///< not convex, or a side too short to be measured
  hidden,    ///< too little of a side is seen: cut by the border of the picture, or no edge there
  contrast,  ///< not dark inside and bright outside
  ragged,    ///< a side is not straight
  border,    ///< white cells in the black border
  plain,     ///< all of it is dark: it has no code
  unknown,   ///< its cells are no word of the dictionary
  twice,     ///< a marker that another blob shows, too
};

inline constexpr std::uint32_t refusal_count = 9;

constexpr const char* refusal_name(Refusal refusal) {
  switch (refusal) {
    case Refusal::none:
      return "none";
    case Refusal::shape:
      return "shape";
    case Refusal::hidden:
      return "hidden";
    case Refusal::contrast:
      return "contrast";
    case Refusal::ragged:
      return "ragged";
    case Refusal::border:
      return "border";
    case Refusal::plain:
      return "plain";
    case Refusal::unknown:
      return "unknown";
    case Refusal::twice:
      return "twice";
  }
  return "?";
}

/// Corners, if the candidate was not refused.
struct QuadFit {
  Refusal refusal;
  Quad ideal;  ///< corners in ideal px, in the order of the guess
  Quad image;  ///< the same in the picture
  /// Covariance of `ideal`, px², row by row, in the order x0 y0 x1 … y3. Neighbours share a side.
  std::array<double, 64> covariance;
  /// Of `covariance`, what all markers of the picture share: a deviation of all corners together,
  /// px. All 0 where levels are light.
  std::array<double, 8> common;
  double dark, bright;  ///< grey levels on both sides of the edges, mean of the four
  double raggedness;    ///< px: that of the worst side
  double reach;         ///< px: half the width of an edge
};

/// A place to begin at: corners, clockwise, in image px. Refused (`shape`) where the lens has no
/// such point, and where a side is too short to be measured.
QuadFit guess_quad(const Lens& lens, const Quad& corners, const QuadFitOptions& options);

/// Corners between grey pixels: a line through each side (side_fit.h), and where they meet. From a
/// few strips of each side, well enough for a look at the cells; there is no covariance yet. `fit`:
/// a guess within 3 px of the corners. A refused one stays as it is.
void find_quad(const CameraFrame& frame, const QuadFitOptions& options, QuadFit& fit);

/// The same from all strips, around corners that find_quad found, with covariance.
void refine_quad(const CameraFrame& frame, const QuadFitOptions& options, QuadFit& fit);

/// All three.
QuadFit fit_quad(const CameraFrame& frame, const Quad& guess, const QuadFitOptions& options);

/// The same corners counted from corner `first` on.
QuadFit counted_from(const QuadFit& fit, unsigned first);

}  // namespace marker
