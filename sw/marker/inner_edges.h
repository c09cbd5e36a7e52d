#pragma once

#include <marker/camera.h>
#include <marker/optics_fit.h>
#include <marker/quad_fit.h>

#include <cstdint>

namespace marker {

/// What the edges between a marker's cells say of a shift towards the dark that all of its edges
/// have in common, as a camera's response curve makes it.
///
/// Such a shift makes a marker smaller, and its black cells, too, but its white cells larger: an
/// edge inside is not where the outline has it, and edges with the dark on either side differ. So
/// do edges into which cells around are blurred; the word says which, and by how much.
struct InnerShift {
  std::uint32_t edges;  ///< measured; 0: too few were seen, or they are far too blurred
  bool is_vague;        ///< cells are so narrow that the outline is off, too
  double shift;         ///< px
  double variance;      ///< of it, px²
  double deviation;     ///< of the transition between dark and bright, px
};

/// `fit` and `levels`: of refine_through_optics(), counted from the marker's own top left; `word`:
/// the one of its ID.
InnerShift measure_inner_edges(const CameraFrame& frame, const QuadFit& fit,
                               const LightLevels& levels, std::uint64_t word, std::uint32_t cells);

}  // namespace marker
