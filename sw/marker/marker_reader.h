#pragma once

#include <marker/camera.h>
#include <marker/code_book.h>
#include <marker/images.h>
#include <marker/quad_fit.h>

#include <cstdint>

namespace marker {

/// What the cells of a candidate show.
struct CellReading {
  std::uint32_t white_border;  ///< cells of the border that are not black
  std::uint64_t word;          ///< of the code, as in a Dictionary
};

/// Reads a marker of `cells` × `cells` and its border from grey values: a cell is black if the mean
/// of nine places around its middle is nearer to the dark level of the fit than to the bright one.
/// What lies outside of the picture is white.
CellReading read_cells(const GreyImage& image, const Lens& lens, const QuadFit& fit,
                       std::uint32_t cells);

struct DetectionOptions {
  QuadFitOptions fit;              ///< but for `cells`, which the dictionary says
  std::uint32_t white_border = 0;  ///< so many cells of the border may be white
};

struct DetectedMarker {
  std::uint16_t id;
  std::uint8_t corrected;  ///< cells that were wrong
  QuadFit fit;             ///< clockwise from the marker's own top left corner
};

/// From the guess of a blob's corners, as largest_quad gives it, to a marker.
Refusal read_marker(const GreyImage& image, const Lens& lens, const Quad& guess,
                    const CodeBook& book, const DetectionOptions& options, DetectedMarker& marker);

/// From a blob to a marker. What is no quadrilateral with straight edges, dark inside and bright
/// outside, is refused before a cell is read.
Refusal detect_marker(const GreyImage& image, const Lens& lens, const Extremes& blob,
                      const CodeBook& book, const DetectionOptions& options,
                      DetectedMarker& marker);

}  // namespace marker
