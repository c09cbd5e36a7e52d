#pragma once

#include <marker/camera.h>
#include <marker/code_book.h>
#include <marker/images.h>
#include <marker/inner_edges.h>
#include <marker/quad_fit.h>

#include <array>
#include <cstdint>

namespace marker {

/// The cells of a candidate, its border included, row by row: the sums of the grey values at nine
/// places around their middles. What lies outside of the picture is white.
struct CellLook {
  std::uint32_t cells;  ///< of the code's side
  std::array<std::uint32_t, (max_code_cells + 2) * (max_code_cells + 2)> sums;
};

/// `corners`: clockwise, ideal px.
CellLook look_at_cells(const CameraFrame& frame, const Quad& corners, std::uint32_t cells);

/// True if a blob is as dark all over as only one without a code can be: its cells differ by less
/// than half of `minimum_contrast`. A guess of the corners will do.
bool is_plain(const CellLook& look, double minimum_contrast);

/// What the cells of a marker show.
struct CellReading {
  std::uint32_t white_border;  ///< cells of the border that are not black
  std::uint64_t word;          ///< of the code, as in a Dictionary
  double margin;  ///< of the least clear cell: 1 if it is as dark as `dark`, or as `bright`
};

/// A cell is black if it is nearer to the grey level `dark` than to `bright`.
CellReading read_cells(const CellLook& look, double dark, double bright);

struct DetectionOptions {
  QuadFitOptions fit;              ///< but for `cells`, which the dictionary says
  std::uint32_t white_border = 0;  ///< so many cells of the border may be white
  bool exact = false;              ///< no wrong cell of the code is corrected
};

struct DetectedMarker {
  std::uint16_t id;
  std::uint8_t corrected;  ///< cells that were wrong
  QuadFit fit;             ///< clockwise from the marker's own top left corner
  Box part;                ///< of the picture, in which it was looked for
  InnerShift inner;        ///< without edges unless Optics::seeks_response
};

/// From the guess of a blob's corners, as largest_quad gives it, to a marker.
Refusal read_marker(const CameraFrame& frame, const Quad& guess, const CodeBook& book,
                    const DetectionOptions& options, DetectedMarker& marker);

/// A marker so far away, or seen so much from the side, that its cells are too narrow for
/// read_marker(): what is around an edge is blurred by the code behind it. `corners`: where the
/// outline has them, and where they stay, known to a third of a pixel. Only an exact word counts,
/// and only of a dictionary whose words random cells hardly ever are. For frames with optics.
Refusal read_narrow_marker(const CameraFrame& frame, const Quad& corners, const CodeBook& book,
                           const DetectionOptions& options, DetectedMarker& marker);

/// Measures a marker that read_marker() found once more, as the frame's optics are now. False: it
/// stays as it was.
bool measure_again(const CameraFrame& frame, const Dictionary& dictionary,
                   const DetectionOptions& options, DetectedMarker& marker);

/// From a blob to a marker. What has no code, or is no quadrilateral with straight edges, dark
/// inside and bright outside, is refused before its word is looked up.
Refusal detect_marker(const CameraFrame& frame, const Extremes& blob, const CodeBook& book,
                      const DetectionOptions& options, DetectedMarker& marker);

}  // namespace marker
