#pragma once

#include <marker/camera.h>
#include <marker/geometry.h>
#include <marker/images.h>

#include <array>
#include <cstdint>

namespace marker {

/// The outermost pixel centres of a blob, px (pixel index + 0.5), clockwise: least y, greatest
/// x − y, greatest x, greatest x + y, greatest y, least x − y, least x, least x + y.
using Extremes = std::array<Point, 8>;

/// The four extremes that span the largest area, clockwise. A corner of up to 135° is the outermost
/// point in at least one of the eight directions, however the marker is rolled, and any other
/// choice cuts area off. False if no four make a convex quadrilateral.
bool largest_quad(const Extremes& extremes, Quad& quad);

/// Grey values that stand in a row or a column across a side: a view into a frame in memory, or the
/// pixels around an edge that the PL gathered as they streamed by.
struct Strip {
  const std::uint8_t* pixels;  ///< of column (row) `first` on
  std::uint32_t stride;        ///< from one to the next
  std::uint32_t first, size;   ///< px
  std::uint32_t line;          ///< the row (column) in which they stand
};

/// The strips of one side.
struct SideSupport {
  const Strip* strips;
  std::uint32_t count;
  bool
      rows;  ///< they stand in rows, as they should where the side is nearer to upright; or columns
};

struct QuadFitOptions {
  std::uint32_t cells = 6;          ///< of the marker's side; the outermost are black
  double minimum_contrast = 20;     ///< grey levels between the sides of an edge
  double maximum_raggedness = 0.4;  ///< px: deviation of a side's edge points from its line
  double minimum_coverage = 0.5;    ///< share of a side on which the edge must be seen
  bool in_dma_memory = false;       ///< a DMA engine wrote the picture: reads stall
  std::uint32_t crossings = 256;    ///< of a side that are measured, 16 to 256: time for accuracy
};

/// Why a candidate is no marker, or `none`.
enum class Refusal : std::uint32_t {
  none = 0,
  shape,     ///< not convex, or a side too short to be measured
  hidden,    ///< too little of a side is seen: cut by the border of the picture, or no edge there
  contrast,  ///< not dark inside and bright outside
  ragged,    ///< a side is not straight
  border,    ///< white cells in the black border
  unknown,   ///< its cells are no word of the dictionary
};

inline constexpr std::uint32_t refusal_count = 7;

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
    case Refusal::unknown:
      return "unknown";
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
  double dark, bright;  ///< grey levels on both sides of the edges, mean of the four
  double raggedness;    ///< px: that of the worst side
  double reach;         ///< px: half the width of an edge
};

/// A corner moves 6 px at most, an edge is 7 px wide, and grey levels are read 15 px beyond.
inline constexpr std::uint32_t fit_margin = 32;

/// Corners between grey pixels: a line through each side, and where they meet.
///
/// The sum of the grey values of a strip across an edge says where the edge crosses it: exactly,
/// whatever the blur, as long as that is symmetric, since each pixel is a mean over its square. So
/// neither a model of the edge nor interpolation is needed. What it needs are the two grey levels,
/// which are read where a strip stays dark (bright) all the way. Crossings are freed from the lens,
/// the line is a least-squares fit, and its scatter says how well the line is known.
///
/// `guess`: clockwise, image px, within 3 px of the corners. Pixels farther than `fit_margin` from
/// the box around a blob whose corners it holds are not read.
QuadFit fit_quad(const GreyImage& image, const Lens& lens, const Quad& guess,
                 const QuadFitOptions& options);

/// The first part of it: corners from a few strips of each side, well enough for a look at the
/// cells. Has no covariance.
QuadFit find_quad(const GreyImage& image, const Lens& lens, const Quad& guess,
                  const QuadFitOptions& options);

/// The second part, with the options of the first: from all strips. A refused fit stays as it is.
void refine_quad(const GreyImage& image, const Lens& lens, const QuadFitOptions& options,
                 QuadFit& fit);

/// Both from gathered strips; side i leads from corner i of the guess to the next.
QuadFit fit_quad(const std::array<SideSupport, 4>& sides, const Lens& lens, const Quad& guess,
                 const QuadFitOptions& options);

/// The same corners counted from corner `first` on.
QuadFit counted_from(const QuadFit& fit, unsigned first);

}  // namespace marker
